#include "mesh/layers.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "mesh/cells.h"
#include "mesh/error.h"

namespace chainmail {
namespace {

/// Collects sides by their corners in ascending order, and keeps those that occur only once.
template <std::size_t Corners>
class OneSided {
 public:
  void add(std::array<ElementId, Corners> corners) {
    std::ranges::sort(corners);
    all_.push_back(corners);
  }

  void append(std::vector<ElementId>& elements) {
    std::ranges::sort(all_);
    for (auto first = all_.begin(); first != all_.end();) {
      const auto end = std::find_if(first, all_.end(), [&](const auto& one) { return one != *first; });
      if (end - first == 1) {
        elements.insert(elements.end(), first->begin(), first->end());
      }
      first = end;
    }
  }

 private:
  std::vector<std::array<ElementId, Corners>> all_;
};

void append_outer_surface(const Mesh& mesh, std::vector<ElementId>& elements) {
  OneSided<3> triangles;
  for (const auto& cell : mesh.tetrahedra) {
    for (const auto& side : tetrahedron_sides) {
      triangles.add({cell[side[0]], cell[side[1]], cell[side[2]]});
    }
  }
  triangles.append(elements);
  OneSided<4> squares;
  for (const auto& cell : mesh.hexahedra) {
    for (const auto& side : hexahedron_sides) {
      squares.add({cell[side[0]], cell[side[1]], cell[side[2]], cell[side[3]]});
    }
  }
  squares.append(elements);
}

void append_open_edges(const Mesh& mesh, std::vector<ElementId>& elements) {
  OneSided<2> edges;
  for (const auto& triangle : mesh.triangles) {
    for (int i = 0; i < 3; ++i) {
      edges.add({triangle[i], triangle[(i + 1) % 3]});
    }
  }
  edges.append(elements);
}

/// Appends the rim of an object without faces: the elements with fewer neighbours than those inside.
void append_rim(const Mesh& mesh, std::vector<ElementId>& elements) {
  std::size_t most = 0;
  for (ElementId e = 0; e < mesh.element_count(); ++e) {
    most = std::max(most, mesh.neighbours_of(e).size());
  }
  for (ElementId e = 0; e < mesh.element_count(); ++e) {
    if (mesh.neighbours_of(e).size() < most) {
      elements.push_back(e);
    }
  }
}

}  // namespace

const ObjectSide* find_side(std::string_view name) {
  const auto found = std::ranges::find(object_sides, name, &ObjectSide::name);
  return found == object_sides.end() ? nullptr : &*found;
}

std::vector<ElementId> layer(const Mesh& mesh, const ObjectSide& side) {
  const int active_axis_count = mesh.space_dimension;
  if (std::find(mesh.axes.begin(), mesh.axes.begin() + active_axis_count, side.axis) ==
      mesh.axes.begin() + active_axis_count) {
    return {};
  }
  const double outermost = bounds(mesh)[side.high ? 1 : 0][side.axis];
  std::vector<ElementId> elements;
  for (ElementId e = 0; e < mesh.element_count(); ++e) {
    if (std::abs(mesh.rest_position(e)[side.axis] - outermost) <= mesh.mean_link_length / 2) {
      elements.push_back(e);
    }
  }
  return elements;
}

std::vector<ElementId> boundary(const Mesh& mesh) {
  std::vector<ElementId> elements;
  if (mesh.has_cells()) {
    append_outer_surface(mesh, elements);
  } else if (!mesh.triangles.empty()) {
    append_open_edges(mesh, elements);
  } else {
    append_rim(mesh, elements);
  }
  std::ranges::sort(elements);
  elements.erase(std::unique(elements.begin(), elements.end()), elements.end());
  return elements;
}

bool is_side(std::string_view name) { return name == "boundary" || find_side(name) != nullptr; }

std::vector<ElementId> elements_at(const Mesh& mesh, std::string_view name) {
  if (!is_side(name)) {
    throw Error("side '" + std::string(name.substr(0, 60)) + "'", "there is no such side",
                "use left, right, bottom, top, back, front or boundary");
  }
  const ObjectSide* side = find_side(name);
  std::vector<ElementId> elements = side == nullptr ? boundary(mesh) : layer(mesh, *side);
  if (elements.empty()) {
    throw Error(
        "side '" + std::string(name) + "'",
        side == nullptr ? "the object is closed and has no boundary" : "the object does not extend along that axis",
        "use another side, or elements by id");
  }
  return elements;
}

}  // namespace chainmail
