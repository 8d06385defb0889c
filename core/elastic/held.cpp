// Checks whether pins leave a part of an object free to move as a rigid body.

#include "elastic/held.h"

#include <Eigen/Dense>
#include <algorithm>
#include <map>
#include <string>

#include "elastic/simplices.h"
#include "mesh/error.h"
#include "mesh/layers.h"

namespace chainmail {
namespace {

// Pins that are closer to one line or point than this share of the object's size do not hold it.
constexpr double apart_from = 1e-6;

/// The elements joined by cells, as a forest: the root of each element names its part.
class AnchorForest {
 public:
  explicit AnchorForest(const Simplices& simplices, ElementId count) : parent_(count), in_cell_(count, false) {
    for (ElementId e = 0; e < count; ++e) {
      parent_[e] = e;
    }
    for (std::size_t s = 0; s < simplices.count(); ++s) {
      const auto corners = simplices.corners_of(s);
      for (const ElementId corner : corners) {
        in_cell_[corner] = true;
        join(corners[0], corner);
      }
    }
  }

  ElementId root(ElementId element) {
    while (parent_[element] != element) {
      element = parent_[element] = parent_[parent_[element]];
    }
    return element;
  }
  bool in_cell(ElementId element) const { return in_cell_[element]; }

 private:
  /// Joins two parts. The lower id becomes the root, so a part is named after its first element.
  void join(ElementId a, ElementId b) {
    const auto [low, high] = std::minmax({root(a), root(b)});
    parent_[high] = low;
  }

  std::vector<ElementId> parent_;
  std::vector<bool> in_cell_;
};

/// Subtracts from the points their component along the line through the origin with direction `unit`. Returns the
/// longest remainder.
Point furthest(const std::vector<Point>& from_first, const Point& unit) {
  Point best = Point::Zero();
  for (const Point& point : from_first) {
    const Point across = point - point.dot(unit) * unit;
    if (across.squaredNorm() > best.squaredNorm()) {
      best = across;
    }
  }
  return best;
}

bool holds(const Mesh& mesh, const std::vector<ElementId>& pins) {
  if (pins.empty() || mesh.space_dimension == 1) {
    return !pins.empty();
  }
  const double size = (mesh.box[1] - mesh.box[0]).norm();
  std::vector<Point> from_first;
  from_first.reserve(pins.size());
  for (const ElementId pin : pins) {
    from_first.push_back(mesh.rest_position(pin) - mesh.rest_position(pins.front()));
  }
  const Point along = furthest(from_first, Point::Zero());
  if (along.norm() <= apart_from * size) {
    return false;
  }
  return mesh.space_dimension == 2 || furthest(from_first, along.normalized()).norm() > apart_from * size;
}

std::string too_few(int dimension) {
  return dimension == 1   ? "no pin holds it"
         : dimension == 2 ? "fewer than two pins at different positions hold it"
                          : "fewer than three pins that do not lie on one line hold it";
}

/// Returns what a user can pin. A closed surface has no boundary.
const char* remedy(const Mesh& mesh) {
  return boundary(mesh).empty() ? "pin its bottom layer, or single elements"
                                : "pin its bottom layer, its boundary, or single elements";
}

}  // namespace

void check_pinned(const Mesh& mesh, std::span<const ElementId> pins) {
  if (pins.empty()) {
    throw Error("object", "nothing pins it, so there is no solution", remedy(mesh));
  }
}

void check_part_held(const Mesh& mesh, ElementId part, const std::vector<ElementId>& pins) {
  if (!holds(mesh, pins)) {
    throw Error("the part of element " + std::to_string(part),
                too_few(mesh.space_dimension) + ", so it has no solution", remedy(mesh));
  }
}

void check_held(const Simplices& simplices, const Mesh& mesh, std::span<const ElementId> pins) {
  check_pinned(mesh, pins);
  AnchorForest anchors(simplices, mesh.element_count());
  std::map<ElementId, std::vector<ElementId>> pins_of;
  for (const ElementId pin : pins) {
    pins_of[anchors.root(pin)].push_back(pin);
  }
  for (ElementId e = 0; e < mesh.element_count(); ++e) {
    if (anchors.in_cell(e) && anchors.root(e) == e) {
      check_part_held(mesh, e, pins_of[e]);
    }
  }
}

}  // namespace chainmail
