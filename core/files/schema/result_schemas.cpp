#include "elastic/material.h"
#include "files/results/json_kind.h"
#include "files/results/peer_json.h"
#include "files/schema/schemas.h"
#include "report/run/ramp.h"
#include "report/table/results.h"

namespace chainmail::schema {
namespace {

using namespace report;

const Members named = each(text(), {"name", "description"});

Member of_kind(const JsonKind& kind, std::string_view title, const Members& required, const Members& optional = {}) {
  const Members head{{"kind", {{"const", kind.kind()}}}, {"schema_version", {{"const", kind.schema_version}}}};
  return document(kind.name, title, object(joined({head, required}), optional));
}

Json defects() {
  return object({{"duplicate_vertices", count("elements at exactly the same position as another")},
                 {"loose_points", count("elements without links")},
                 {"holes", count()},
                 {"hole_edges", count("edges around all holes")},
                 {"non_manifold_edges", count("edges of more than two faces")},
                 {"inverted_cells", count("cells inside out, while others are not")}});
}

/// The figures of cells that `info` and `deform` have, for an object with cells.
const Members cell_figures{
    {"cells", count("number of cells that have no cut link")},
    {"parts", count("of the object: parts without an uncut link between them")},
    {"volume", object({{"rest", from_zero()}, {"now", number()}}, {}, "of these cells (mesh units to the power 3)")},
    {"worst_quality", or_null(from_zero("of these at rest: 1 regular, 0 flat; null without cells"))}};

Member info() {
  const Members left_out{{"unused", count("points that nothing uses")},
                         {"collapsed", count("faces or cells with a repeated corner, and faces with fewer than 3")},
                         {"doubled", count("faces or cells given twice")},
                         {"lines", count("lines of kinds that the format does not have")}};
  const Members flaws{{"flat", count("faces without area, and cells without volume")},
                      {"inverted", count("cells turned inside out")},
                      {"coincident", count("elements at the position of another element")}};
  const Members others{{"triangles", count("as drawn, including those of polygons")},
                       {"object_dimension", whole(1, 3, "1 chain, 2 surface, 3 volume")},
                       {"space_dimension", whole(1, 3, "number of coordinates")},
                       {"components", count("number of parts without a link between them")},
                       {"bounds", array_of(point(), "lowest and highest corner", 2, 2)},
                       {"mean_link_length", from_zero("mesh units")},
                       {"left_out", object(left_out, {}, "parts of the file that were left out")},
                       {"joined", count("points that became one with another beside them")},
                       {"flaws", object(flaws)},
                       {"defects", defects()}};
  return of_kind(json_kinds::info, "Output of chainmail info --json",
                 joined({each(count(), {"elements", "links", "tetrahedra", "hexahedra"}), others}), cell_figures);
}

Member repair() {
  const Json counts = object(joined({each(count(), {"elements", "links", "triangles"}), {{"defects", defects()}}}));
  return of_kind(json_kinds::repair, "Output of chainmail repair --json", {{"before", counts}, {"after", counts}});
}

Json pass_with(const Member& handle) {
  return object({handle,
                 {"target", point("target of the handle's pivot (mesh units)")},
                 {"checked", count("number of candidates that were processed")},
                 {"moved", count("number of elements that moved, without the handle")},
                 {"milliseconds", from_zero("time of the pass without relaxation (ms)")}},
                {rotate("rotation of the handle since it was grabbed"),
                 {"stopped_at", point("position of the pivot, if pins stopped it before its target (mesh units)")},
                 {"remark", non_empty_text("reason why the pass did not end as requested")}});
}

Member deform() {
  const Json pass = any_of({pass_with({"element", count("id of the handle, if it is one element")}),
                            pass_with({"elements", array_of(count(), "ids of a handle of several, ascending", 2)})});
  const Members spread = each(from_zero(), {"max", "rms"});
  const Members shape{{"volume_change", or_null(number("relative to rest; in a plane, of the area"))},
                      {"inverted_cells", or_null(count("cells turned inside out"))},
                      {"largest_stretch", or_null(from_zero("the largest principal stretch of a cell"))}};
  const Members equilibrium{{"violation", from_zero("the largest violation of a link (its rest lengths)")},
                            {"residual", from_zero("estimated distance from the equilibrium (relative)")},
                            {"energy_gap", or_null(number("estimated energy above the least (relative)"))},
                            {"regions_bind", boolean("true if valid regions change the equilibrium")},
                            {"iterations", count()}};
  const Members relaxation{
      {"milliseconds", array_of(from_zero(), "of the relaxation after each pass (ms)")},
      {"nodes", count("number of unknown positions after the last pass")},
      {"estimate", from_zero("estimated distance from the equilibrium then, root mean square (relative)")}};
  return of_kind(
      json_kinds::deform, "Output of chainmail deform --json",
      {{"algorithm", algorithm()},
       {"elements", count()},
       {"links", count("number of links, including cut ones")},
       {"passes", array_of(pass)},
       {"violation", object(joined({spread, {{"fraction", with(from_zero("share of links"), "maximum", 1)}}}))},
       {"energy", from_zero("elastic energy")},
       {"displacement", object(spread, {}, "of elements from rest (mesh units)")}},
      joined({cell_figures,
              {{"shape", object(shape, {}, "of an object with cells or faces; null: no such figure")},
               {"equilibrium", object(equilibrium, {}, "certificate, after relaxation to the equilibrium")},
               {"relaxation", object(relaxation, {}, "after relaxation that is fine only where needed")}}}));
}

Json points(std::string_view help) { return array_of(point(), help, 1); }

Json different_ids(std::string_view help, std::uint64_t least, std::uint64_t most = no_most) {
  return with(array_of(count(), help, least, most), "uniqueItems", true);
}

Member peer_case() {
  return of_kind(
      json_kinds::peer_case, "A case of chainmail compare --cases, for other solvers",
      joined({named,
              {{"material", object(described<ElasticOptions>(is_in_cases))},
               {"pins", different_ids("elements that stay at rest", 0)},
               {"handle", different_ids("elements that the moves place", 1)},
               {"positions", points("rest position of each element (mesh units); z is constant in a plane")},
               {"cells", array_of(different_ids({}, 3, 4), "corners of each cell: three in a plane, four in space", 1)},
               {"moves", array_of(points("of the handle's elements, in their order"), "for each move", 1)},
               {"reference", points("position of each element after the last move (mesh units)")}}}),
      {{"reference_change", from_zero("change of the reference by its last refinement (ratio)")}});
}

Member peer_answer() {
  return of_kind(json_kinds::peer_answer, "An answer of another solver, for chainmail compare --judge",
                 {{"solver", text("name in the table")},
                  {"case", text("name of the case")},
                  {"positions", points("position of each element after the last move (mesh units)")}},
                 {{"factorize_ms", from_zero("time to prepare the object with its pins (ms)")},
                  {"grab_ms", from_zero("time to prepare the handle (ms)")},
                  {"moves_ms", array_of(from_zero(), "time of each move (ms)")}});
}

/// A member of `definitions`, with a description, which would be ignored beside `$ref`.
Json defined(const std::string& name, std::string_view help = {}) {
  return about(help, {{"allOf", Json::array({{{"$ref", "#/definitions/" + name}}})}});
}

Json any_figure() {
  const Members times = each(from_zero(), {"median", "lower_quartile", "upper_quartile", "min", "max"});
  return any_of({number(), object(joined({times, {{"repetitions", from_one()}}}))}, "ms, with repetitions");
}

Json contestant() {
  Members optional{{"open_regions", boolean("true with the energy of the material, and regions that do not bind")},
                   {"limit", from_one("most iterations per move")},
                   {"calibrated", object(softness(), {}, "softness that was found on this object")},
                   {"refusal", non_empty_text("reason why there are no figures")}};
  for (const Figure* figure : every_figure()) {
    const std::string help = figure->definition.empty() ? std::string(figure->heading) : definition_of(*figure);
    optional.emplace_back(figure->key, defined("figure", help + in_brackets(*figure)));
  }
  return object({{"algorithm", text("as on the command line; nothing: only the handle moves; or another solver")},
                 {"label", text("name for readers")},
                 {"sweeps", count("sweeps of relaxation after each move")},
                 {"equilibrium", boolean("true if each move is relaxed to the equilibrium")}},
                optional);
}

/// The options of all kinds of reports.
Json options() {
  const Parameter& lattice = parameters::lattice;
  const std::string axis = "[" + std::to_string(int(lattice.lowest)) + "-" + std::to_string(int(lattice.highest)) + "]";
  const Members others{
      {"relaxation", scheme()},
      {"relax_step", schema_of(parameters::relax_step)},
      {"precision", one_of(precision_names, "of the contestants")},
      {"young", schema_of(parameters::young)},
      {"poisson", schema_of(parameters::poisson)},
      {"lattice", with(text(lattice.help), "pattern", "^" + axis + "x" + axis + "x" + axis + "$")},
      {"iterations", with(schema_of(parameters::iterations), "type", "integer")},
      {"growth_seconds", from_zero("time for each contestant on growing objects (s); 0: no object grows")},
      {"energy", energy()},
      {"evaluations", count("number of evaluations of a calibration")},
      {"seed", count("random seed of the drags")},
      {"seconds", from_zero("duration (s)")}};
  return object({}, joined({region(), others, described<RampOptions>()}), "those of this kind of report");
}

Json drag() {
  const Json level = object({{"elements", count()}}, {{"change", from_zero("from the level before (relative)")}});
  const Json reference = object({{"levels", array_of(level)}, {"converged", boolean()}, {"end", text("its reason")}},
                                {{"order", number("observed order")}}, "levels of a reference on refined cells");
  return object(joined({named,
                        {{"handle", count("id of an element of the handle")},
                         {"moves", count("number of moves")},
                         {"has_cut", boolean("true if a cut precedes the last move")},
                         {"handle_displacement", from_zero("mesh units; 0: not known")},
                         {"contestants", array_of(defined("contestant"))}}}),
                {{"no_reference", non_empty_text("reason why there are no errors")}, {"reference", reference}});
}

Json object_of_report() {
  return object(joined({named,
                        {{"elements", count()},
                         {"links", count("number of links that are not cut")},
                         {"pins", count("number of pinned elements")},
                         {"seconds", from_zero("duration of its experiment (s); 0: not known")},
                         {"notes", array_of(text())},
                         {"drags", array_of(drag())}}}),
                {{"series", non_empty_text("name that objects which grow or are refined have in common")},
                 {"reference", non_empty_text("what errors are measured against")},
                 {"contestants", array_of(defined("contestant"), "figures of the object as a whole")}});
}

Members members_of_ramps() {
  using namespace figures;
  const Json size =
      object(joined({{{"width", from_one("elements along each side of the grid")}, {"algorithm", algorithm()}},
                     each(schema::count(), {"elements", "links", passes.key}),
                     each(boolean(), {figures::repeated.key, real_time.key})}),
             each(from_zero(), {median_ms.key, p99_ms.key, mean_moved.key}));
  const Members fit{{"exponent", number()}, {"from", from_zero()}, {"to", from_zero()}, {"sizes", count()}};
  const Json verdict =
      object({{"algorithm", algorithm()},
              {"largest_width", or_null(from_one("width of the largest grid in real time"))},
              {"lost", boolean("true if the next size was too slow")},
              {"growth", or_null(object(fit, {}, "of the median time, over the number of elements in a range"))}});
  return {{"sizes", array_of(size, "of a ramp: its rows")},
          {"algorithms", array_of(verdict, "of a ramp: what became of each algorithm")}};
}

Members members_of_calibrations() {
  const Member residual{"residual", object(each(from_zero(), {"relative", "rms", "max"}), {}, "errors (relative)")};
  const Json drag = object({{"element", count("id of the handle")}, residual});
  return joined({softness(),
                 {{"sweeps", count("of a calibration: sweeps of relaxation after each move")},
                  residual,
                  {"drags", array_of(drag, "of a calibration: the drags of its search")}}});
}

Member report() {
  const Members machine = joined(
      {each(text(), {"date", "version", "command_line", "processor", "compiler", "build"}), each(count(), {"cores"})});
  const Members part{{"shard", text("part of the whole, such as 1/4")}, {"experiments", array_of(text())}};
  const Members runs{{"origin", object(machine)}, {"runs", array_of(object(joined({machine, part})), "of a suite")}};
  Member all =
      of_kind(json_kinds::report, "report.json of compare, and output of ramp --json and calibrate --json",
              {{"report", one_of(names_of(report_kinds()), "what the report is about")},
               {"options", options()},
               {"stopped", boolean("true if it was cancelled, and contains only what was finished")},
               {"figures", array_of(object(each(text(), {"key", "heading", "unit", "definition"})), "of contestants")},
               {"objects", array_of(object_of_report())}},
              joined({runs, members_of_ramps(), members_of_calibrations()}));
  all.second["definitions"] = {{"figure", any_figure()}, {"contestant", contestant()}};
  return all;
}

}  // namespace

Members schemas_of_results() { return {info(), repair(), deform(), peer_case(), peer_answer(), report()}; }

}  // namespace chainmail::schema
