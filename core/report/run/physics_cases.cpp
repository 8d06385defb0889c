#include "report/run/physics_cases.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>

#include "measure/converging_reference.h"
#include "mesh/error.h"
#include "mesh/generate.h"
#include "mesh/layers.h"
#include "report/run/preparing.h"
#include "solver/algorithms.h"

namespace chainmail::report {
namespace {

constexpr double nudge_share = 0.05, pull_share = 0.2, far_share = 0.5;  // shares of the object's largest extent
constexpr std::uint64_t usual_elements = 256;

Case made(const char* name, const std::string& description, const MeshPointer& mesh, const char* side,
          const Softness& softness, const ElasticOptions& elastic, bool with_cut) {
  Case object{name, description, mesh, {}, layer(*mesh, *find_side(side)), softness, {}, elastic};
  object.drags = physics_drags(object, with_cut);
  return object;
}

/// Lowers each squared distance to that between the element and `point`, if that is less.
void come_near(std::vector<double>& distances, const Mesh& mesh, const std::vector<ElementId>& elements,
               const Point& point) {
  for (std::size_t i = 0; i < elements.size(); ++i) {
    distances[i] = std::min(distances[i], (mesh.rest_position(elements[i]) - point).squaredNorm());
  }
}

/// Returns the direction from the middle of the pins to the element; the first axis if the element is there.
Point outward_of(const Case& object, ElementId element) {
  const Mesh& mesh = *object.mesh;
  Point middle = Point::Zero();
  for (const ElementId pin : object.pins) {
    middle += mesh.rest_position(pin) / double(object.pins.size());
  }
  const Point way = mesh.rest_position(element) - middle;
  return way.norm() > mesh.mean_link_length / 2 ? Point(way.normalized()) : Point(Point::Unit(mesh.axes[0]));
}

/// Returns a direction at a right angle to `outward`, close to the last axis of the scene; on a line, the opposite of
/// `outward`.
Point across_of(const Mesh& mesh, const Point& outward) {
  for (int k = mesh.space_dimension - 1; k >= 0; --k) {
    const Point axis = Point::Unit(mesh.axes[k]);
    const Point across = axis - axis.dot(outward) * outward;
    if (across.norm() > 0.5) {
      return across.normalized();
    }
  }
  return -outward;
}

/// A cut in a plane across the line from the handle to the nearest pin.
struct CutPlace {
  double along = 0.5;  // position of the plane on that line, as a share from the handle
  double from = 0;     // the cut ends at this share of the object's extent in the plane, counted from the line
};
// Cuts to try, in this order: through the middle first, then less deep, then nearer to the handle, then nearer to the
// pins. The first one that leaves a unique solution is used.
constexpr CutPlace cut_places[]{{0.5, 0},    {0.5, 0.3}, {0.5, 0.6},  {0.35, 0},  {0.35, 0.3},
                                {0.35, 0.6}, {0.65, 0},  {0.65, 0.3}, {0.65, 0.6}};

/// Returns the links that a cut crosses.
std::vector<LinkId> links_through(const Case& object, ElementId handle, const CutPlace& place) {
  const Mesh& mesh = *object.mesh;
  const Point from = mesh.rest_position(handle);
  const auto distance = [&](ElementId pin) { return (mesh.rest_position(pin) - from).squaredNorm(); };
  const Point to = mesh.rest_position(*std::ranges::min_element(object.pins, {}, distance));
  const Point middle = from + place.along * (to - from), normal = (from - to).normalized();
  const Point across = across_of(mesh, normal);
  std::vector<std::pair<LinkId, double>> crossings;
  double farthest = 0;
  for (LinkId link = 0; link < mesh.link_count(); ++link) {
    const Point a = mesh.rest_position(mesh.links[link][0]), b = mesh.rest_position(mesh.links[link][1]);
    const double before = (a - middle).dot(normal), behind = (b - middle).dot(normal);
    if ((before < 0) != (behind < 0)) {
      crossings.emplace_back(link, (a + before / (before - behind) * (b - a) - middle).dot(across));
      farthest = std::max(farthest, crossings.back().second);
    }
  }
  std::vector<LinkId> links;
  for (const auto& [link, at] : crossings) {
    if (at > place.from * farthest) {
      links.push_back(link);
    }
  }
  return links;
}

/// Returns true if linear elasticity has a unique solution after these links are cut: no part is loose or turns about a
/// hinge.
bool stays_held(const Case& object, const std::vector<LinkId>& links) {
  try {
    make_elastic(Algorithm::linear_fem, elastic_problem(object, links));
    return true;
  } catch (const Error&) {
    return false;
  }
}

/// Returns the links of the first cut that leaves a unique solution; empty if there is none.
std::vector<LinkId> links_to_cut(const Case& object, ElementId handle) {
  for (const CutPlace& place : cut_places) {
    std::vector<LinkId> links = links_through(object, handle, place);
    if (!links.empty() && stays_held(object, links)) {
      return links;
    }
  }
  return {};
}

/// What all drags of an object have in common.
struct DragMaker {
  const Case& object;
  double radius;  // of the patch about an element, without pins; 0: the handle is the element
  int moves;

  RecordedMoves drag(ElementId element, const Point& way, const std::string& name,
                     const std::string& description) const {
    const Point from = radius == 0 ? object.mesh->rest_position(element) : Point(Point::Zero());
    RecordedMoves drag{name, "element " + std::to_string(element) + ", " + description, {grab(element)}};
    for (int move = 1; move <= moves; ++move) {
      drag.commands.emplace_back(commands::Drag{from + way * move / moves, {}, radius > 0});
    }
    if (radius > 0) {
      drag.centre = element;
      drag.radius = radius;
    }
    return drag;
  }

 private:
  commands::Grab grab(ElementId element) const {
    if (radius == 0) {
      return commands::Grab{element};
    }
    std::vector<ElementId> pins = object.pins;
    std::ranges::sort(pins);
    return commands::Grab{elements_in(*object.mesh, {object.mesh->rest_position(element), radius}, pins)};
  }
};

/// Returns half of a pull, then a cut into the object, then one more move; no commands if no cut is possible.
RecordedMoves cut_then_move(const Case& object, const RecordedMoves& pull) {
  const ElementId handle = handle_of(pull);
  const auto before_cut = std::ptrdiff_t(pull.commands.size() - 1) / 2;
  std::vector<LinkId> links = links_to_cut(object, handle);
  if (links.empty()) {
    return {};
  }
  RecordedMoves cut{"cut, then move",
                    "element " + std::to_string(handle) + ", half of the pull, a cut through the object (" +
                        std::to_string(links.size()) + " links), and one more move",
                    {pull.commands.begin(), pull.commands.begin() + 1 + before_cut},
                    pull.centre,
                    pull.radius};
  cut.commands.emplace_back(commands::Cut{std::move(links)});
  cut.commands.push_back(pull.commands[std::size_t(1 + before_cut)]);
  return cut;
}

}  // namespace

Case pinned_bar(std::uint64_t elements, const Softness& softness, const ElasticOptions& elastic, bool with_cut) {
  const auto width = static_cast<std::uint32_t>(std::max(2.0, std::round(std::cbrt(double(elements) / 3))));
  const auto mesh = generate({MeshKind::tetra, {3 * width, width, width}});
  return made("bar", "tetrahedra, pinned at the left layer", mesh, "left", softness, elastic, with_cut);
}

Case pinned_sheet(std::uint64_t elements, const Softness& softness, const ElasticOptions& elastic, bool with_cut) {
  const auto width = static_cast<std::uint32_t>(std::max(2.0, std::round(std::sqrt(double(elements)))));
  const auto mesh = generate({MeshKind::cloth, {width, width, 1}});
  return made("sheet", "triangles in a plane, pinned at the top layer", mesh, "top", softness, elastic, with_cut);
}

std::vector<Case> physics_cases(const Softness& softness, const ElasticOptions& elastic) {
  return {pinned_bar(usual_elements, softness, elastic), pinned_sheet(usual_elements, softness, elastic)};
}

std::vector<ElementId> possible_handles(const Mesh& mesh) {
  std::vector<ElementId> elements = mesh.space_dimension == 3 ? boundary(mesh) : std::vector<ElementId>();
  if (elements.empty()) {
    elements.resize(mesh.element_count());
    std::iota(elements.begin(), elements.end(), ElementId{0});
  }
  return elements;
}

std::vector<ElementId> physics_handles(const Case& object, std::size_t most) {
  const Mesh& mesh = *object.mesh;
  const std::vector<ElementId> elements = possible_handles(mesh);
  std::vector<double> distances(elements.size(), std::numeric_limits<double>::infinity());
  for (const ElementId pin : object.pins) {
    come_near(distances, mesh, elements, mesh.rest_position(pin));
  }
  std::vector<ElementId> handles;
  while (handles.size() < most && !object.pins.empty() && !elements.empty()) {
    const auto farthest = std::ranges::max_element(distances) - distances.begin();
    if (distances[static_cast<std::size_t>(farthest)] == 0) {
      break;  // pinned, or already a handle
    }
    handles.push_back(elements[static_cast<std::size_t>(farthest)]);
    come_near(distances, mesh, elements, mesh.rest_position(handles.back()));
  }
  if (handles.empty()) {
    throw Error(object.name, object.pins.empty() ? "nothing pins it" : "every element that could be a handle is pinned",
                "pin a side of the object");
  }
  return handles;
}

std::vector<RecordedMoves> physics_drags(const Case& object, bool with_cut, double radius_share, std::size_t handles,
                                         int moves) {
  const Mesh& mesh = *object.mesh;
  const auto [low, high] = bounds(mesh);
  const double size = (high - low).maxCoeff();
  const DragMaker maker{object, radius_share * size, moves};
  std::vector<RecordedMoves> drags;
  for (const ElementId handle : physics_handles(object, handles)) {
    const Point outward = outward_of(object, handle), across = across_of(mesh, outward);
    drags.push_back(
        maker.drag(handle, nudge_share * size * (outward + across).normalized(), "nudge", "5 % of the object’s size"));
    drags.push_back(
        maker.drag(handle, pull_share * size * outward, "pull", "20 % of the object’s size away from the pins"));
    drags.push_back(maker.drag(handle, pull_share * size * across, "bend", "20 % of the object’s size across"));
    drags.push_back(maker.drag(handle, far_share * size * across, "far bend", "50 % of the object’s size across"));
  }
  if (RecordedMoves cut = with_cut ? cut_then_move(object, drags[1]) : RecordedMoves(); !cut.commands.empty()) {
    drags.push_back(std::move(cut));
  }
  return drags;
}

std::vector<Case> with_laws(const std::vector<Case>& cases, const std::vector<StrainLaw>& laws) {
  std::vector<Case> all;
  for (const Case& object : cases) {
    for (const StrainLaw& law : laws) {
      all.push_back(object);
      all.back().law = law;
      if (laws.size() > 1 || law.kind != StrainLaw::Kind::neo_hookean) {
        all.back().name += ", " + label(law);
      }
    }
  }
  return all;
}

}  // namespace chainmail::report
