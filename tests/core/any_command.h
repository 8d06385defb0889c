#pragma once

#include <cstdint>
#include <random>
#include <utility>
#include <vector>

#include "core/families.h"
#include "simulate/command.h"

namespace chainmail::test {

/// Returns a split that puts an element into the first triangle of a surface.
inline SplitPointer split_of_first_triangle(const MeshPointer& mesh) {
  auto corners = mesh->triangles[0];
  const ElementId inside = mesh->element_count();
  const auto [a, b, c] = corners;
  std::ranges::sort(corners);
  return make_split(mesh, {{{corners, {0.25, 0.5}}}, {0}, {{a, b, inside}, {b, c, inside}, {c, a, inside}}, {}, {}});
}

/// Returns commands of all kinds for an object of 16 elements or more, in which element 0 has links. Some do not fit it
/// and are refused. The state 0 must be kept.
inline std::vector<Command> every_command(const MeshPointer& mesh, const MeshPointer& other,
                                          const SplitPointer& split) {
  using namespace commands;
  const Point by(mesh->has_axis(0) ? 0.4 : 0, mesh->has_axis(1) ? -0.3 : 0, 0);
  const auto slices = std::make_shared<SliceCounts>(1);
  slices->note(0, Algorithm::natural_queue, 2);
  const EntryId first = mesh->first_entry[0], end = mesh->first_entry[1];
  const std::vector<LinkId> of_first(mesh->entry_link.begin() + first, mesh->entry_link.begin() + end);
  PositionRuns some{false, {4, 6}, std::vector<double>(2 * std::size_t(mesh->space_dimension), 1.25)};
  ElasticOptions soft;
  soft.material.young *= 2;
  std::vector<Command> all{
      Grab{5},
      Grab{std::vector<ElementId>{5, 6, 9}},
      Drag{mesh->rest_position(5) + 3 * by},
      Drag{by, {}, true},
      Drag{by, {Point(0, 0, 1), 20}, true},
      Drag{by, {Point(0, 0, -1), 20}, true},
      Release{},
      SetSoftness{Softness{{0.9, 1.1, 0.05}, {{of_first[0], {1, 1, 0}}}}},
      SetSoftness{Softness{{0.7, 1.3, 0.2}, {}, link_energy, {AxesKind::given, Point(0, 0, 0.5)}}},
      SetRelaxation{true, 0.5, RelaxationScheme::link},
      Relaxed{RelaxationScheme::mean, 1, Relaxed::Start::awake, slices},
      Cut{of_first},
      Cut{{mesh->entry_link[mesh->first_entry[5]]}},
      Uncut{of_first},
      Pin{{3}},
      Pin{{5}},
      Unpin{{mesh->element_count() - 1}},
      Reset{},
      ReplaceMesh{other},
      SetPositions{std::make_shared<const Snapshot>(snapshot_of(some, *mesh, Precision::double_precision))},
      KeepState{1},
      RestoreState{0},
      RestoreState{1},
      DropState{0},
      SetElastic{soft},
      commands::Split{split}};
  for (const RelaxationSchemeInfo& scheme : relaxation_schemes) {
    all.emplace_back(Relax{3, 1, scheme.scheme});
  }
  for (const Algorithm algorithm : {Algorithm::natural_queue, Algorithm::exact, Algorithm::linear_fem}) {
    all.emplace_back(SetAlgorithm{algorithm});
  }
  return all;
}

/// Draws commands of all kinds. Some do not fit the object and are refused.
class AnyCommand {
 public:
  /// Ids of elements and links are drawn below these limits. `relaxed` is true if relaxation may be turned on.
  AnyCommand(std::uint64_t seed, bool relaxed, std::vector<MeshPointer> meshes, ElementId elements, LinkId links)
      : random_(seed), relaxed_(relaxed), meshes_(std::move(meshes)), elements_(elements), links_(links) {}

  Command draw() {
    using namespace commands;
    switch (below(27)) {
      case 0:
        return Cut{{below(links_), below(links_)}};
      case 1:
        return Uncut{{below(links_), below(links_)}};
      case 2:
        return SetSoftness{{{between(-0.05, 1), between(1, 2), between(0, 1), between(0, 1), 2, between(-1, 1)},
                            {{below(links_), {1, 1, 0}}},
                            EnergyKind(below(3))}};
      case 3:
        return SetRelaxation{relaxed_ && below(4) != 0, between(0.1, 1),
                             relaxation_schemes[below(std::uint32_t(relaxation_schemes.size()))].scheme};
      case 4:
        return SetAlgorithm{algorithms()[below(std::uint32_t(algorithms().size()))].algorithm};
      case 5:
        return below(3) == 0 ? Command(ReplaceMesh{meshes_[below(static_cast<std::uint32_t>(meshes_.size()))]})
                             : Command(Reset{});
      case 6:
        return KeepState{below(4)};
      case 7:
        return RestoreState{below(4)};
      case 8:
        return below(3) == 0 ? Command(DropState{below(4)}) : Command(Release{});
      case 14:
        return place();
      case 12:
        return Pin{{below(elements_)}};
      case 13:
        return Unpin{{below(elements_), below(elements_), below(elements_)}};
      case 9:
      case 10:
      case 11:
        return below(4) == 0 ? Grab{{below(elements_), below(elements_), below(elements_)}} : Grab{below(elements_)};
      default:
        return drag();
    }
  }
  std::uint32_t below(std::uint32_t n) { return static_cast<std::uint32_t>(random_() % n); }

 private:
  /// To a position, or along a way with a rotation in the plane, which some objects refuse.
  Command drag() {
    commands::Drag drag{Point(between(-4, 16), between(-4, 16), between(-4, 4))};
    if (below(6) == 0) {
      drag = {Point(between(-2, 2), between(-2, 2), 0), {}, true};
      drag.rotation = below(2) == 0 ? Rotation{Point(0, 0, 1), between(-90, 90)} : Rotation();
    }
    return drag;
  }
  /// Positions of a few elements of a mesh, in one to three dimensions.
  Command place() {
    const ElementId first = below(elements_), end = first + 1 + below(70);
    const MeshPointer& mesh = meshes_[below(std::uint32_t(meshes_.size()))];  // may be another one than the object's
    PositionRuns positions{
        below(2) == 0, {std::min(first, mesh->element_count() - 1), std::min(end, mesh->element_count())}, {}};
    for (std::size_t i = 0; i < (positions.runs[1] - positions.runs[0]) * std::size_t(mesh->space_dimension); ++i) {
      positions.held.push_back(between(-4, 16));
    }
    return commands::SetPositions{
        std::make_shared<const Snapshot>(snapshot_of(positions, *mesh, Precision::single_precision))};
  }
  double between(double low, double high) { return uniform(random_, low, high); }

  std::mt19937_64 random_;
  bool relaxed_;
  std::vector<MeshPointer> meshes_;
  ElementId elements_;
  LinkId links_;
};

}  // namespace chainmail::test
