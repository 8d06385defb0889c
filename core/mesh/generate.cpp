#include "mesh/generate.h"

#include <algorithm>
#include <string>

#include "mesh/error.h"

namespace chainmail {
namespace {

constexpr std::array kinds{
    MeshKindInfo{MeshKind::line, "line", 1, "a chain of elements along x"},
    MeshKindInfo{MeshKind::grid, "grid", 2, "links along x and y"},
    MeshKindInfo{MeshKind::cloth, "cloth", 2, "a grid whose squares are split into triangles"},
    MeshKindInfo{MeshKind::block, "block", 3, "links along x, y and z"},
    MeshKindInfo{MeshKind::tetra, "tetra", 3, "a block whose cubes are split into tetrahedra"},
};

/// The six paths along the edges of a cube from its first corner to its last, as orders of the axes. The corners of
/// each path form one tetrahedron (Freudenthal 1942).
constexpr std::array<std::array<int, 3>, 6> axis_orders{
    {{0, 1, 2}, {0, 2, 1}, {1, 0, 2}, {1, 2, 0}, {2, 0, 1}, {2, 1, 0}}};

void check(const MeshRecipe& recipe, const Lattice& lattice) {
  if (*std::min_element(lattice.size.begin(), lattice.size.end()) == 0) {
    throw Error("size", "a size of 0 leaves no elements", "use 1 or more along each axis");
  }
  const double count = double(lattice.size[0]) * lattice.size[1] * lattice.size[2];
  if (count > double(element_limit)) {
    throw Error("size", "the mesh would have more than " + std::to_string(element_limit) + " elements",
                "use smaller sizes");
  }
  chainmail::check(parameters::spacing, recipe.spacing);
  if (recipe.spacing * *std::max_element(lattice.size.begin(), lattice.size.end()) > coordinate_limit) {
    throw Error("spacing", "a coordinate would exceed 1e100", "use a smaller spacing");
  }
}

/// Calls visit(element, {x, y, z}) for every element. Each flag is true if the lattice continues along that axis.
template <class Visit>
void for_each_element(const Lattice& lattice, Visit visit) {
  ElementId element = 0;
  for (std::uint32_t z = 0; z < lattice.size[2]; ++z) {
    for (std::uint32_t y = 0; y < lattice.size[1]; ++y) {
      for (std::uint32_t x = 0; x < lattice.size[0]; ++x, ++element) {
        visit(element, std::array<bool, 3>{x + 1 < lattice.size[0], y + 1 < lattice.size[1], z + 1 < lattice.size[2]});
      }
    }
  }
}

/// Sets of axes along which a link leads to the next element: bit k is axis k.
constexpr std::array<unsigned, 3> straight{1, 2, 4};
constexpr std::array<unsigned, 7> straight_and_diagonal{1, 2, 3, 4, 5, 6, 7};

struct Builder {
  MeshParts& parts;
  std::array<ElementId, 3> stride;
  std::span<const unsigned> ways;

  /// Adds the links to the next elements.
  void add_links(ElementId element, const std::array<bool, 3>& more) {
    const unsigned open = unsigned{more[0]} | unsigned{more[1]} << 1 | unsigned{more[2]} << 2;
    for (const unsigned axes : ways) {
      if ((axes & open) == axes) {
        const ElementId step = (axes & 1) * stride[0] + (axes >> 1 & 1) * stride[1] + (axes >> 2) * stride[2];
        parts.links.push_back({element, element + step});
      }
    }
  }

  void add_square(ElementId a) {
    const ElementId b = a + stride[0], c = a + stride[1], d = b + stride[1];
    parts.triangles.push_back({a, b, d});
    parts.triangles.push_back({a, d, c});
  }

  void add_cube(ElementId first) {
    for (const auto& [i, j, k] : axis_orders) {
      std::array<ElementId, 4> corner{first, first + stride[i], first + stride[i] + stride[j], 0};
      corner[3] = corner[2] + stride[k];
      // An odd order of axes gives a left-handed tetrahedron.
      if ((i + 1) % 3 != j) {
        std::swap(corner[2], corner[3]);
      }
      parts.tetrahedra.push_back(corner);
    }
  }
};

}  // namespace

std::span<const MeshKindInfo> mesh_kinds() { return kinds; }

MeshPointer generate(const MeshRecipe& recipe, const Progress& progress) {
  Lattice lattice{recipe.size, recipe.spacing};
  const int sizes =
      std::find_if(kinds.begin(), kinds.end(), [&](auto& info) { return info.kind == recipe.kind; })->sizes;
  std::fill(lattice.size.begin() + sizes, lattice.size.end(), 1);
  check(recipe, lattice);

  MeshParts parts;
  parts.lattice = lattice;
  parts.space_dimension = recipe.space_dimension;
  parts.rest.reserve(lattice.element_count());
  const bool diagonals = recipe.kind == MeshKind::cloth || recipe.kind == MeshKind::tetra;
  const auto ways = diagonals ? std::span(straight_and_diagonal).first((std::size_t{1} << sizes) - 1)
                              : std::span(straight).first(std::size_t(sizes));
  parts.links.reserve(lattice.element_count() * ways.size());
  Builder builder{parts, {1, lattice.size[0], lattice.size[0] * lattice.size[1]}, ways};
  for_each_element(lattice, [&](ElementId element, const std::array<bool, 3>& more) {
    progress.part(0, 0.4).report(element, lattice.element_count());
    parts.rest.push_back(lattice.position(element));
    builder.add_links(element, more);
    if (recipe.kind == MeshKind::cloth && more[0] && more[1]) {
      builder.add_square(element);
    }
    if (recipe.kind == MeshKind::tetra && more[0] && more[1] && more[2]) {
      builder.add_cube(element);
    }
  });
  return build_mesh(std::move(parts), progress.part(0.4, 1));
}

}  // namespace chainmail
