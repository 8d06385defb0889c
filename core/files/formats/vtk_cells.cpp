#include "files/formats/vtk_cells.h"

#include <algorithm>
#include <iterator>
#include <string>

#include "mesh/error.h"

namespace chainmail {
namespace {

[[noreturn]] void fail(const std::string& problem, const std::string& remedy) { throw Error("", problem, remedy); }

void check_size(VtkCells::Corners corners, std::size_t expected) {
  if (corners.size() != expected) {
    fail("a cell has " + std::to_string(corners.size()) + " corners, but its type has " + std::to_string(expected),
         "export it again");
  }
}

// VTK lists middles of edges by layers, Gmsh by their ends.
constexpr std::array tetrahedron10_order{0, 1, 2, 3, 4, 5, 6, 7, 9, 8};
constexpr std::array pyramid13_order{0, 1, 2, 3, 4, 5, 8, 9, 6, 10, 7, 11, 12};
constexpr std::array prism18_order{0, 1, 2, 3, 4, 5, 6, 8, 12, 7, 13, 14, 9, 11, 10, 15, 17, 16};
constexpr std::array hexahedron27_order{0,  1,  2,  3,  4,  5,  6,  7,  8,  11, 16, 9,  17, 10,
                                        18, 19, 12, 15, 13, 14, 24, 22, 20, 21, 23, 25, 26};

/// A type of VTK that has no counterpart here.
struct DividedType {
  int number;
  DividedKind kind;
  std::span<const int> order = {};  // the corner of VTK for each of Gmsh's, where they differ
};
constexpr std::array divided_types{DividedType{13, DividedKind::prism},
                                   DividedType{14, DividedKind::pyramid},
                                   DividedType{15, DividedKind::pentagonal_prism},
                                   DividedType{16, DividedKind::hexagonal_prism},
                                   DividedType{21, DividedKind::line3},
                                   DividedType{22, DividedKind::triangle6},
                                   DividedType{23, DividedKind::quadrangle8},
                                   DividedType{24, DividedKind::tetrahedron10, tetrahedron10_order},
                                   DividedType{25, DividedKind::hexahedron20, hexahedron27_order},
                                   DividedType{26, DividedKind::prism15, prism18_order},
                                   DividedType{27, DividedKind::pyramid13, pyramid13_order},
                                   DividedType{28, DividedKind::quadrangle9},
                                   DividedType{29, DividedKind::hexahedron27, hexahedron27_order},
                                   DividedType{30, DividedKind::quadrangle6},
                                   DividedType{31, DividedKind::prism12},
                                   DividedType{32, DividedKind::prism18, prism18_order},
                                   DividedType{33, DividedKind::hexahedron24},
                                   DividedType{34, DividedKind::triangle7},
                                   DividedType{37, DividedKind::pyramid19}};

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
  check_size(corners, Size);
  std::array<ElementId, Size> group{};
  std::transform(order.begin(), order.end(), group.begin(), [&](int place) { return id(corners[place]); });
  groups.push_back(group);
}

void VtkCells::add_divided_cell(Corners corners, int type) {
  const auto* const found = std::find_if(divided_types.begin(), divided_types.end(),
                                         [type](const DividedType& one) { return one.number == type; });
  if (found == divided_types.end()) {
    fail("it contains cells of VTK's type " + std::to_string(type) + (type == 42 ? ", polyhedra" : ""),
         "divide them into tetrahedra first, for example with the filter Tetrahedralize of ParaView");
  }
  check_size(corners, corner_count(found->kind));
  std::vector<ElementId> ids;
  std::ranges::transform(corners, std::back_inserter(ids), [this](std::uint64_t corner) { return id(corner); });
  add_divided(mesh_, found->kind, in_order(ids, found->order));
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
    default:
      return add_divided_cell(corners, type);
  }
}

}  // namespace chainmail
