#include "report/physics_cases.h"

#include <algorithm>
#include <cmath>

#include "mesh/error.h"
#include "mesh/generate.h"
#include "mesh/layers.h"

namespace chainmail::report {
namespace {

constexpr int moves = 24;
constexpr double nudge = 0.05, far = 0.2;  // of the object's largest extent
constexpr std::uint64_t usual_elements = 256;

Case made(const char* name, const std::string& description, const MeshPointer& mesh, const char* side,
          const Softness& softness, const ElasticOptions& elastic) {
  Case object{name, description, mesh, {}, layer(*mesh, *find_side(side)), softness, {}, elastic};
  object.drags = physics_drags(object);
  return object;
}

double to_nearest_pin(const Case& object, const Point& at) {
  double least = std::numeric_limits<double>::infinity();
  for (const ElementId pin : object.pins) {
    least = std::min(least, (object.mesh->rest_position(pin) - at).squaredNorm());
  }
  return least;
}

/// Farthest from the pins; of several, nearest to where those lie in the middle, the lowest id.
ElementId farthest(const Case& object) {
  const Mesh& mesh = *object.mesh;
  const bool is_solid = !mesh.tetrahedra.empty() || !mesh.hexahedra.empty();
  std::vector<ElementId> reachable = is_solid ? boundary(mesh) : std::vector<ElementId>();
  for (ElementId e = 0; !is_solid && e < mesh.element_count(); ++e) {
    reachable.push_back(e);
  }
  ElementId best = no_element;
  double most = 0;
  for (const ElementId e : reachable) {
    const double distance = to_nearest_pin(object, mesh.rest_position(e));
    if (distance > most) {
      most = distance;
      best = e;
    }
  }
  return best;
}

/// Away from the pins' middle; along the first axis where the element stands there.
Point outward_of(const Case& object, ElementId element) {
  const Mesh& mesh = *object.mesh;
  Point middle = Point::Zero();
  for (const ElementId pin : object.pins) {
    middle += mesh.rest_position(pin) / double(object.pins.size());
  }
  const Point way = mesh.rest_position(element) - middle;
  return way.norm() > mesh.mean_link_length / 2 ? Point(way.normalized()) : Point(Point::Unit(mesh.axes[0]));
}

/// At a right angle to it, as near as may be to the last axis that the scene carries; on a line, back.
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

RecordedMoves drag(const Mesh& mesh, ElementId element, const Point& way, const std::string& name,
                   const std::string& description) {
  RecordedMoves drag{name, "element " + std::to_string(element) + ", " + description, {commands::Grab{element}}};
  for (int move = 1; move <= moves; ++move) {
    drag.commands.emplace_back(commands::Drag{mesh.rest_position(element) + way * move / moves});
  }
  return drag;
}

}  // namespace

Case pinned_bar(std::uint64_t elements, const Softness& softness, const ElasticOptions& elastic) {
  const auto width = static_cast<std::uint32_t>(std::max(2.0, std::round(std::cbrt(double(elements) / 3))));
  const auto mesh = generate({MeshKind::tetra, {3 * width, width, width}});
  return made("bar", "tetrahedra, pinned at the left layer", mesh, "left", softness, elastic);
}

Case pinned_sheet(std::uint64_t elements, const Softness& softness, const ElasticOptions& elastic) {
  const auto width = static_cast<std::uint32_t>(std::max(2.0, std::round(std::sqrt(double(elements)))));
  const auto mesh = generate({MeshKind::cloth, {width, width, 1}});
  return made("sheet", "triangles in a plane, pinned at the top layer", mesh, "top", softness, elastic);
}

std::vector<Case> physics_cases(const Softness& softness, const ElasticOptions& elastic) {
  return {pinned_bar(usual_elements, softness, elastic), pinned_sheet(usual_elements, softness, elastic)};
}

std::vector<RecordedMoves> physics_drags(const Case& object) {
  const Mesh& mesh = *object.mesh;
  const ElementId element = object.pins.empty() ? no_element : farthest(object);
  if (element == no_element) {
    throw Error(object.name, object.pins.empty() ? "nothing pins it" : "every element that a hand could take is pinned",
                "pin a side of it");
  }
  const auto [low, high] = bounds(mesh);
  const double size = (high - low).maxCoeff();
  const Point outward = outward_of(object, element), across = across_of(mesh, outward);
  return {drag(mesh, element, nudge * size * (outward + across).normalized(), "nudge", "5 % of the object’s size"),
          drag(mesh, element, far * size * outward, "pull", "20 % of the object’s size away from the pins"),
          drag(mesh, element, far * size * across, "bend", "20 % of the object’s size across")};
}

}  // namespace chainmail::report
