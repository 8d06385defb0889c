#include "body/region_axes.h"
#include "elastic/material.h"
#include "files/schema/schemas.h"
#include "files/session/lesson.h"
#include "files/session/moves.h"
#include "files/session/session.h"
#include "files/session/softness_presets.h"
#include "files/text/limits.h"
#include "simulate/command.h"

namespace chainmail::schema {
namespace {

constexpr std::string_view rotation_vector = "axis times the angle (radians)";

/// The members of a softness that may be left out.
Members optional_softness() {
  const Member rotation{"rotation", point(rotation_vector)};
  const Json turned = object({{"kind", one_of(axes_kinds)}, rotation});
  const Json found = object({{"kind", one_of({axes_kinds[0], axes_kinds[1]})}});  // without those that are given
  const Json axes = any_of({turned, found}, "axes along which valid regions lie");
  return joined({described<LinkSoftness>(is_optional), {{"energy", energy()}, {"frame", axes}}});
}

Json preset() {
  const Json name = with(non_empty_text("one line", limits::preset_name_bytes), "pattern", "^[^ ](.*[^ ])?$");
  const Json one = object(joined({{{"name", name}}, region()}), described<LinkSoftness>(is_optional));
  return object({{"version", one_of(Json::array({presets_version}))}, {"presets", array_of(one)}});
}

Json command(std::string_view name, std::string_view help, const Members& required = {}, const Members& optional = {}) {
  return object(joined({{{"do", {{"const", name}}}}, required}), optional, help);
}

/// Commands of the handle. Those with the same name have members that go together.
Json handle_commands() {
  const Member target{"target", point("target of the handle's pivot (mesh units)")};
  const Member by{"by", point("displacement of the pivot since it was grabbed (mesh units)")};
  const Member turn = rotate("rotation since it was grabbed");
  return any_of(
      {command(commands::Grab::name, "grabs one element", {{"element", id()}}),
       command(commands::Grab::name, "grabs several elements as a rigid body", {{"elements", array_of(id(), {}, 1)}}),
       command(commands::Drag::name, "moves the handle in one pass", {target}, {turn}),
       command(commands::Drag::name, "moves the handle in one pass", {by}, {turn}),
       command(commands::Drag::name, "rotates the handle in one pass", {turn}),
       command(commands::Release::name, "releases the handle")});
}

Json relaxation_commands() {
  const Member step{"step", schema_of(parameters::relax_step)};
  const Members sweeps = described<commands::Relax>();
  const Members to_equilibrium{{"scheme", {{"const", info(RelaxationScheme::equilibrium).name}}},
                               {"until", schema_of(parameters::relax_until)}};
  const Members panels{
      {"panels", array_of(text(), "algorithm of each panel", 1, limits::session_panels)},
      {"slices", array_of(id(), "iterations, or sweeps of up to 20,000 elements", 1, limits::session_panels)}};
  return any_of({command(commands::Relax::name, "relaxes the object", sweeps, {step, {"scheme", scheme()}}),
                 command(commands::Relax::name, "relaxes the object to the equilibrium",
                         joined({sweeps, to_equilibrium}), {step}),
                 command(commands::Relaxed::name, "what relaxation did in idle time",
                         joined({described<commands::Relaxed>(), panels}))});
}

Json object_commands() {
  const Members links{{"links", array_of(array_of(id(), "both ends", 2, 2))}}, elements{{"elements", ids()}};
  const Json short_row = numbers(2 + region_numbers, "both ends, " + softness_names(", ", 0, region_numbers));
  const Json long_row = numbers(2 + softness_numbers.size(), "both ends, " + softness_names(", "));
  const Member own{"links", any_of({array_of(short_row), array_of(long_row)}, "softness of single links")};
  const Json place = array_of({id(), id(), id(), number(), number()},
                              "a, b, c, s, t: the element is at a + s (b - a) + t (c - a) at rest", 5, 5);
  const Members split{{"removed", ids("indices of the triangles that go")},
                      {"triangles", array_of(array_of(id(), {}, 3, 3), "corners of the new triangles")},
                      {"removed_polygons", ids("indices of the polygons that go")},
                      {"polygons", ids("the new polygons: a count, then as many ids, for each")}};
  return any_of(
      {command(commands::Cut::name, "cuts links", links),
       command(commands::Uncut::name, "joins cut links again", links), command(commands::Pin::name, {}, elements),
       command(commands::Unpin::name, {}, elements),
       command(commands::SetSoftness::name, "replaces that of all links", region(),
               joined({optional_softness(), {own}})),
       command(commands::Reset::name, "returns to rest"),
       command(commands::Split::name, "divides faces, and appends elements", {{"elements", array_of(place)}}, split)});
}

Json moves() {
  const Json version = whole(1, newest_moves_version, "2 if moves split the object, 3 if relaxation ran between them");
  const Json command = any_of({handle_commands(), object_commands(), relaxation_commands()});
  return object({{"version", version}, {"commands", array_of(command)}}, {}, "recorded moves, from rest");
}

/// The mesh before all splits.
Json mesh_with(const Members& links) {
  const Json size = array_of(from_one(), "along each axis", 3, 3);
  const Json texture = object({{"size", size},
                               {"channels", one_of({1, 4})},
                               {"box", numbers(6, "lowest x, y, z, then highest x, y, z (mesh units)")},
                               {"texels", with(text("bytes in base 64"), "contentEncoding", "base64")}});
  const Json lattice = object({{"size", size}, {"spacing", schema_of(parameters::spacing)}}, {}, "grid of elements");
  const Members parts{{"elements", from_one("number of elements")},
                      {"space", whole(1, newest_moves_version, "number of coordinates")},
                      {"rest", array_of(number(), "x, y, z of each element at rest (mesh units)")},
                      {"triangles", ids("three ids of each triangle")},
                      {"polygons", ids("a count, then as many ids, of each polygon")},
                      {"tetrahedra", ids("four ids of each tetrahedron")}};
  return object(joined({parts, links}),
                {{"hexahedra", ids("eight ids of each hexahedron")}, {"lattice", lattice}, {"texture", texture}});
}

Json mesh() {
  const Json name = with(text("name of a mesh or a picture in the same folder"), "pattern", R"(^[^./\\][^/\\]*$)");
  const Member across{"across", from_one("number of elements along the width of a picture")};
  return any_of({object({{"file", name}}, {across}, "a mesh in another file"),
                 mesh_with({{"links", ids("both ends of each link")}}),
                 mesh_with({{"counts", ids("number of neighbours of each element")},
                            {"neighbours", ids("neighbours of each element, in the file's order")}})});
}

Json panel() {
  return object({{"algorithm", algorithm()},
                 {"precision", one_of(precision_names, "of the coordinates")},
                 {"from_rest", boolean("true if the coordinates are displacements from rest")},
                 {"runs", ids("first and end of each run of elements that are given")},
                 {"held", array_of(number(), "coordinates of these elements (mesh units)")}},
                {{"frame", point(rotation_vector)}});
}

Json lesson() {
  const auto name = [](std::string_view help = {}) { return non_empty_text(help, limits::name_bytes); };
  const Json step = object({{"title", name()},
                            {"text", non_empty_text({}, limits::caption_bytes)},
                            {"until", count("number of recorded moves that are carried out at the end of the step")}},
                           {{"algorithms", array_of(algorithm(), "of panels", lesson_panels_least, lesson_panels_most)},
                            {"candidate", id("number of candidates of the last pass that are shown")},
                            {"colour", name("colours of the elements")},
                            {"show", name("what the panels show")},
                            {"dock", name("dock that opens")},
                            {"tool", name("tool that is chosen")}});
  return object({{"title", name()}, {"steps", array_of(step, {}, 1, limits::lesson_steps)}});
}

Json session() {
  const Member own{"own", array_of(number(), "both ends and the numbers of each link with its own softness")};
  const Json all = object(
      {{"format", {{"const", "chainmail session"}}},
       {"version", {{"const", session_version}}},
       {"name", text("name of the object")},
       {"mesh", mesh()},
       {"cuts", ids("both ends of each cut link")},
       {"pins", ids("ids of the pinned elements")},
       {"softness", object(joined({region(), {own}}), optional_softness())},
       {"relaxation", object(described<commands::SetRelaxation>(), described<commands::SetRelaxation>(is_optional))},
       {"panels", array_of(panel(), {}, 1, limits::session_panels)},
       {"ui", about("state of the window: only the workbench reads it", {{"type", "object"}})}},
      {{"elastic", object(described<ElasticOptions>(), described<ElasticOptions>(is_optional))},
       {"moves", moves()},
       {"moves_done", count("number of moves that are done; the others can be redone")},
       {"lesson", lesson()}});
  return with(all, "dependencies", {{"moves", Json::array({"moves_done"})}});
}

}  // namespace

Members schemas_of_files() {
  return {document("preset", "Presets of softness", preset()), document("moves", "Recorded moves", moves()),
          document("session", "Session of the workbench", session())};
}

}  // namespace chainmail::schema
