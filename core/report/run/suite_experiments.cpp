#include "report/run/suite_experiments.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <limits>
#include <numbers>
#include <random>

#include "measure/converging_reference.h"
#include "mesh/error.h"
#include "mesh/generate.h"
#include "mesh/layers.h"
#include "mesh/refine.h"
#include "report/run/beam.h"
#include "report/run/drag_times.h"
#include "report/run/physics_cases.h"
#include "report/run/preparing.h"
#include "report/run/random.h"

namespace chainmail::report {
namespace {

constexpr int moves_of_rigid_drag = 24, moves_refined = 2;

/// Returns a drag of a handle of many elements by a distance, and about an axis through their middle.
RecordedMoves rigid_drag(const std::string& name, const std::string& description, std::vector<ElementId> handle,
                         const Point& way, const Rotation& rotation = {}, int moves = moves_of_rigid_drag) {
  RecordedMoves drag{name, description, {commands::Grab{std::move(handle)}}};
  for (int move = 1; move <= moves; ++move) {
    const double share = double(move) / moves;
    drag.commands.emplace_back(commands::Drag{share * way, {rotation.axis, share * rotation.degrees}, true});
  }
  return drag;
}

std::vector<ElementId> layer_of(const Mesh& mesh, const char* side) { return layer(mesh, *find_side(side)); }

/// Returns an object that is pinned at a side.
Case pinned(const char* name, const MeshPointer& mesh, const char* side) {
  Case object;
  object.name = name;
  object.mesh = mesh;
  object.pins = layer_of(*mesh, side);
  return object;
}

Case bar_of(const char* name, std::uint32_t length, std::uint32_t width) {
  return pinned(name, generate({MeshKind::tetra, {length, width, width}}), "left");
}

Beam beam_of(const Case& object) {
  const auto [low, high] = bounds(*object.mesh);
  Beam beam{high.x() - low.x(), high.y() - low.y(), (low + high) / 2, object.elastic.material.poisson};
  beam.middle.x() = low.x();
  return beam;
}

std::vector<Case> cantilever(const SampleOrgans& /*organs*/) {
  Case object = bar_of("cantilever", 33, 5);
  const Beam beam = beam_of(object);
  const double deflection = 0.02 * beam.length;
  RecordedMoves drag = rigid_drag("deflect", "the end section moves across by 2 % of the length and does not turn",
                                  layer_of(*object.mesh, "right"), {0, 0, deflection});
  drag.closed_form = [beam, deflection](const Point& rest) { return timoshenko(beam, deflection, rest); };
  object.drags = {std::move(drag)};
  return {std::move(object)};
}

/// Returns a strip of triangles, four times as long as high, whose inner elements are moved a little: on a regular
/// mesh, linear FEM would be exact at the elements.
MeshPointer irregular_strip() {
  constexpr double most = 0.2;  // spacings
  const MeshPointer regular = generate({MeshKind::cloth, {17, 5, 1}});
  const auto [low, high] = bounds(*regular);
  std::mt19937_64 random(7);
  MeshParts parts;
  for (ElementId e = 0; e < regular->element_count(); ++e) {
    Point at = regular->rest_position(e);
    const bool is_inner = (at.array() > low.array()).head<2>().all() && (at.array() < high.array()).head<2>().all();
    for (int k = 0; k < 2 && is_inner; ++k) {
      at[k] += uniform(random, -most, most);
    }
    parts.rest.push_back(at);
  }
  parts.triangles = regular->triangles;
  parts.links = regular->links;
  parts.space_dimension = 2;
  return build_mesh(std::move(parts));
}

std::vector<Case> refinement(const SampleOrgans& /*organs*/) {
  constexpr int sizes = 4;
  constexpr double angle = 1e-5;  // radians: theory neglects its square
  std::vector<Case> cases;
  MeshPointer mesh = irregular_strip();
  for (int i = 0; i < sizes; ++i, mesh = refine(*mesh).mesh) {
    Case object = pinned("strip", mesh, "left");
    object.elastic.material.poisson = 0;
    const Beam sheet = beam_of(object);
    RecordedMoves drag =
        rigid_drag("bend", "the end section turns", layer_of(*mesh, "right"), {0, angle * sheet.length / 2, 0},
                   {Point::UnitZ(), angle * 180 / std::numbers::pi}, moves_refined);
    drag.closed_form = [sheet](const Point& rest) { return pure_bending(sheet, angle, rest); };
    object.drags = {std::move(drag)};
    cases.push_back(std::move(object));
  }
  return cases;
}

Case short_bar() { return bar_of("bar", 13, 5); }

std::vector<Case> extension(const SampleOrgans& /*organs*/) {
  Case object = short_bar();
  object.drags = {rigid_drag("extend", "the end section moves away by 20 % of the length",
                             layer_of(*object.mesh, "right"), {2.4, 0, 0})};
  return {std::move(object)};
}

std::vector<Case> compression(const SampleOrgans& /*organs*/) {
  Case object = short_bar();
  object.drags = {rigid_drag("compress", "the end section moves in by 20 % of the length",
                             layer_of(*object.mesh, "right"), {-2.4, 0, 0})};
  return {std::move(object)};
}

std::vector<Case> torsion(const SampleOrgans& /*organs*/) {
  Case object = short_bar();
  object.drags = {rigid_drag("twist", "the end section turns by 60° about the axis of the bar",
                             layer_of(*object.mesh, "right"), Point::Zero(), {Point::UnitX(), 60})};
  return {std::move(object)};
}

/// The nominal strains of the Truth Cube (Kerdok et al. 2003), under its plate, and under a stamp half as wide.
std::vector<Case> indentation(const SampleOrgans& /*organs*/) {
  Case object = pinned("cube", generate({MeshKind::tetra, {5, 5, 5}}), "bottom");
  object.elastic.material.poisson = 0.45;
  const Mesh& mesh = *object.mesh;
  const auto [low, high] = bounds(mesh);
  const double height = high.y() - low.y();
  const std::vector<ElementId> plate = layer_of(mesh, "top");
  std::vector<ElementId> stamp;
  std::ranges::copy_if(plate, std::back_inserter(stamp), [&, middle = Point((low + high) / 2)](ElementId element) {
    const Point from_middle = mesh.rest_position(element) - middle;
    return std::max(std::abs(from_middle.x()), std::abs(from_middle.z())) <= height / 4;
  });
  for (const auto& [tool, handle] : {std::pair{"stamp", stamp}, std::pair{"plate", plate}}) {
    for (const auto& [strain, share] :
         {std::pair{"5 %", 0.05}, std::pair{"12.5 %", 0.125}, std::pair{"18.25 %", 0.1825}}) {
      object.drags.push_back(
          rigid_drag(std::string(tool) + " " + strain,
                     std::string("the ") + tool + " on the top goes down by " + strain + " of the height", handle,
                     {0, -share * height, 0}));
    }
  }
  return {std::move(object)};
}

/// Gives an object the drags of the comparison with physics, with patches as handles.
std::vector<Case> with_patches(Case object, std::size_t handles, double radius_share = patch_share) {
  object.drags = physics_drags(object, true, radius_share);
  std::vector<ElementId> kept = handles_of(object);
  kept.resize(std::min(handles, kept.size()));
  std::erase_if(object.drags,
                [&](const RecordedMoves& drag) { return std::ranges::count(kept, handle_of(drag)) == 0; });
  return {std::move(object)};
}

constexpr std::uint64_t suite_elements = 256;
constexpr std::size_t all_handles = 3;
constexpr double coarse_patch_share = 0.25;  // no cell of the coarse organ is in a patch of the usual radius

Case plain_bar() { return pinned_bar(suite_elements, {}, {}, false); }
Case plain_sheet() { return pinned_sheet(suite_elements, {}, {}, false); }

Case made_of(Case object, StrainLaw::Kind law) {
  object.law.kind = law;
  return object;
}

Case organ_of(const MeshPointer& organ) {
  if (organ == nullptr) {
    throw Error("organ", "its file was not found", "install the folder meshes with the program");
  }
  return pinned("organ", organ, "bottom");
}

const RecordedMoves& bend_of(const Case& object) {
  return *std::ranges::find(object.drags, "bend", &RecordedMoves::name);
}

/// Returns one move from rest to the end of a drag.
RecordedMoves in_one_move(const RecordedMoves& drag) {
  RecordedMoves fresh = drag;
  fresh.name = "fresh grab";
  fresh.commands = {drag.commands.front(), drag.commands.back()};
  return fresh;
}

/// Keeps the bend of the first handle, and adds one move to its end from rest.
std::vector<Case> bend_and_one_move(Case object) {
  object.drags = physics_drags(object, false, patch_share);
  const RecordedMoves bend = bend_of(object);
  object.drags = {bend, in_one_move(bend)};
  return {std::move(object)};
}

/// Returns a bar, three times as long as high, that is pinned at its left layer. Each of its cubes is six tetrahedra.
/// Keeps a bend of the first handle in fewer moves and in one, and the cut.
template <std::uint32_t Cubes>
std::vector<Case> bar_for_fronts(const SampleOrgans& /*organs*/) {
  constexpr std::size_t moves_kept = 6;
  Case object = with_patches(bar_of("bar", 3 * Cubes + 1, Cubes + 1), 1).front();
  RecordedMoves bend = bend_of(object);
  RecordedMoves with_cut =
      *std::ranges::find_if(object.drags, [](const RecordedMoves& drag) { return !cuts_of(drag).empty(); });
  keep_moves(bend.commands, moves_kept);
  keep_moves(with_cut.commands, moves_kept);
  object.drags = {bend, in_one_move(bend), std::move(with_cut)};
  return {std::move(object)};
}

constexpr std::array experiments{
    SuiteExperiment{"cantilever", "a bar of tetrahedra, eight times as long as high, against Timoshenko's beam",
                    SuiteKind::drags, cantilever},
    SuiteExperiment{"extension", "a bar of tetrahedra, three times as long as high", SuiteKind::drags, extension},
    SuiteExperiment{"compression", "a bar of tetrahedra, three times as long as high", SuiteKind::drags, compression},
    SuiteExperiment{"torsion", "a bar of tetrahedra, three times as long as high", SuiteKind::drags, torsion},
    SuiteExperiment{
        "indentation",
        "a cube of tetrahedra, Poisson's ratio 0.45, under a stamp and a plate, at the strains of the Truth Cube",
        SuiteKind::drags, indentation},
    SuiteExperiment{"bar", "a bar of tetrahedra at three handles, and one cut while dragging", SuiteKind::drags,
                    [](const SampleOrgans&) { return with_patches(plain_bar(), all_handles); }},
    SuiteExperiment{"bar-gent", "the bar at one handle, of a material that stiffens (Gent 1996)", SuiteKind::drags,
                    [](const SampleOrgans&) { return with_patches(made_of(plain_bar(), StrainLaw::Kind::gent), 1); }},
    SuiteExperiment{"bar-fung", "the bar at one handle, of a material that stiffens (Demiray 1972)", SuiteKind::drags,
                    [](const SampleOrgans&) { return with_patches(made_of(plain_bar(), StrainLaw::Kind::fung), 1); }},
    SuiteExperiment{"sheet", "a sheet of triangles in a plane at three handles, and one cut while dragging",
                    SuiteKind::drags, [](const SampleOrgans&) { return with_patches(plain_sheet(), all_handles); }},
    SuiteExperiment{"sheet-gent", "the sheet at one handle, of a material that stiffens (Gent 1996)", SuiteKind::drags,
                    [](const SampleOrgans&) { return with_patches(made_of(plain_sheet(), StrainLaw::Kind::gent), 1); }},
    SuiteExperiment{"sheet-fung", "the sheet at one handle, of a material that stiffens (Demiray 1972)",
                    SuiteKind::drags,
                    [](const SampleOrgans&) { return with_patches(made_of(plain_sheet(), StrainLaw::Kind::fung), 1); }},
    SuiteExperiment{"organ", "the organ of the samples at one handle, and one cut while dragging", SuiteKind::drags,
                    [](const SampleOrgans& organs) { return with_patches(organ_of(organs.fine), 1); }},
    SuiteExperiment{
        "organ-coarse", "the coarse organ of the samples at one handle, and one cut while dragging", SuiteKind::drags,
        [](const SampleOrgans& organs) { return with_patches(organ_of(organs.coarse), 1, coarse_patch_share); }, 3},
    SuiteExperiment{"refinement", "a strip in a plane that is bent, against the closed form, on finer and finer meshes",
                    SuiteKind::refinement, refinement},
    SuiteExperiment{"time-bar", "error over time in a bend of the bar", SuiteKind::time_to_error,
                    [](const SampleOrgans&) { return bend_and_one_move(plain_bar()); }},
    SuiteExperiment{"time-sheet", "error over time in a bend of the sheet", SuiteKind::time_to_error,
                    [](const SampleOrgans&) { return bend_and_one_move(plain_sheet()); }},
    SuiteExperiment{"time-organ", "error over time in a bend of the organ", SuiteKind::time_to_error,
                    [](const SampleOrgans& organs) { return bend_and_one_move(organ_of(organs.fine)); }},
    SuiteExperiment{"fronts-2k", "a bar of 2,250 tetrahedra: a bend in six moves and in one, and one cut",
                    SuiteKind::time_to_error, bar_for_fronts<5>, 2, true},
    SuiteExperiment{"fronts-10k", "a bar of 9,216 tetrahedra: a bend in six moves and in one, and one cut",
                    SuiteKind::time_to_error, bar_for_fronts<8>, 2, true},
    SuiteExperiment{"fronts-50k", "a bar of 49,392 tetrahedra: a bend in six moves and in one, and one cut",
                    SuiteKind::time_to_error, bar_for_fronts<14>, 1, true},
};

}  // namespace

std::span<const SuiteExperiment> suite_experiments() { return experiments; }

ConvergingOptions suite_reference() {
  ConvergingOptions options;
  options.seconds = 20;  // per drag
  return options;
}

ConvergingOptions reference_of(const SuiteExperiment& experiment) {
  ConvergingOptions options = suite_reference();
  if (experiment.reference_levels > 0) {
    options.max_levels = experiment.reference_levels;
    options.every_level = true;
    options.seconds = std::numeric_limits<double>::infinity();
    options.max_elements.back() = 20'000;
  }
  return options;
}

}  // namespace chainmail::report
