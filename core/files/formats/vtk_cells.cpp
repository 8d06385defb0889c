#include "files/formats/vtk_cells.h"

#include <algorithm>
#include <string>
#include <utility>

#include "mesh/error.h"

namespace chainmail {
namespace {

[[noreturn]] void fail(const std::string& problem, const std::string& remedy) { throw Error("", problem, remedy); }

// VTK lists middles of edges by layers, Gmsh by their ends.
constexpr std::array tetrahedron10_order{0, 1, 2, 3, 4, 5, 6, 7, 9, 8};
constexpr std::array pyramid13_order{0, 1, 2, 3, 4, 5, 8, 9, 6, 10, 7, 11, 12};
constexpr std::array prism18_order{0, 1, 2, 3, 4, 5, 6, 8, 12, 7, 13, 14, 9, 11, 10, 15, 17, 16};
constexpr std::array hexahedron27_order{0,  1,  2,  3,  4,  5,  6,  7,  8,  11, 16, 9,  17, 10,
                                        18, 19, 12, 15, 13, 14, 24, 22, 20, 21, 23, 25, 26};

}  // namespace

ElementId VtkCells::id(std::uint64_t point) const {
  if (point >= parts_.rest.size()) {
    fail("a cell names point " + std::to_string(point) + ", which does not exist", "export it again");
  }
  return static_cast<ElementId>(point);
}

void VtkCells::add_chain(Corners corners) {
  for (std::size_t i = 1; i < corners.size(); ++i) {
    parts_.links.push_back({id(corners[i - 1]), id(corners[i])});
  }
}

void VtkCells::add_face(Corners corners) {
  if (corners.size() < 3) {
    fail("a face has fewer than 3 corners", "export it again");
  }
  if (corners.size() == 3) {
    parts_.triangles.push_back({id(corners[0]), id(corners[1]), id(corners[2])});
    return;
  }
  parts_.polygons.push_back(static_cast<ElementId>(corners.size()));
  for (const std::uint64_t corner : corners) {
    parts_.polygons.push_back(id(corner));
  }
}

template <std::size_t Size>
void VtkCells::add_group(std::vector<std::array<ElementId, Size>>& groups, Corners corners,
                         const std::array<int, Size>& order) {
  if (corners.size() != Size) {
    fail("a cell has " + std::to_string(corners.size()) + " corners, but its type has " + std::to_string(Size),
         "export it again");
  }
  std::array<ElementId, Size> group{};
  std::transform(order.begin(), order.end(), group.begin(), [&](int place) { return id(corners[place]); });
  groups.push_back(group);
}

void VtkCells::add_divided_cell(DividedKind kind, Corners corners, std::span<const int> order) {
  if (corners.size() != corner_count(kind)) {
    fail("a cell has " + std::to_string(corners.size()) + " corners, but its type has " +
             std::to_string(corner_count(kind)),
         "export it again");
  }
  std::vector<ElementId> ids;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    ids.push_back(id(corners[order.empty() ? i : std::size_t(order[i])]));
  }
  add_divided(mesh_, kind, ids);
}

void VtkCells::add(Corners corners, int type) {
  switch (type) {
    case vertex:
    case vertices:
      return;
    case line:
    case lines:
      return add_chain(corners);
    case strip:
      for (std::size_t i = 2; i < corners.size(); ++i) {  // every second triangle is listed in the opposite order
        add_face(std::array{corners[i - 2], corners[i - 1 + i % 2], corners[i - i % 2]});
      }
      return;
    case triangle:
    case polygon:
    case quad:
      return add_face(corners);
    case pixel:
      if (corners.size() == 4) {
        return add_face(std::array{corners[0], corners[1], corners[3], corners[2]});
      }
      return add_face(corners);
    case tetrahedron:
      return add_group(parts_.tetrahedra, corners, {0, 1, 2, 3});
    case voxel:
      return add_group(parts_.hexahedra, corners, {0, 1, 3, 2, 4, 5, 7, 6});
    case hexahedron:
      return add_group(parts_.hexahedra, corners, {0, 1, 2, 3, 4, 5, 6, 7});
    case wedge:
      return add_divided_cell(DividedKind::prism, corners);
    case pyramid:
      return add_divided_cell(DividedKind::pyramid, corners);
    case line3:
      return add_divided_cell(DividedKind::line3, corners);
    case triangle6:
      return add_divided_cell(DividedKind::triangle6, corners);
    case quadrangle8:
      return add_divided_cell(DividedKind::quadrangle8, corners);
    case quadrangle9:
      return add_divided_cell(DividedKind::quadrangle9, corners);
    case tetrahedron10:
      return add_divided_cell(DividedKind::tetrahedron10, corners, tetrahedron10_order);
    case pyramid13:
      return add_divided_cell(DividedKind::pyramid13, corners, pyramid13_order);
    case prism15:
      return add_divided_cell(DividedKind::prism15, corners, prism18_order);
    case prism18:
      return add_divided_cell(DividedKind::prism18, corners, prism18_order);
    case hexahedron20:
      return add_divided_cell(DividedKind::hexahedron20, corners, hexahedron27_order);
    case hexahedron27:
      return add_divided_cell(DividedKind::hexahedron27, corners, hexahedron27_order);
    default:
      fail("it contains cells of VTK's type " + std::to_string(type), "save them as cells of first or second order");
  }
}

}  // namespace chainmail
