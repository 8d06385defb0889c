#include "drawn_indices.h"

#include <algorithm>
#include <iterator>

namespace chainmail {
namespace {

bool isCut(const Mesh& mesh, const Cuts& cuts, ElementId a, ElementId b) {
  const auto link = find_link(mesh, a, b);
  return link && cuts.is_cut(*link);
}

bool isWhole(const Mesh& mesh, const Cuts& cuts, const std::array<ElementId, 3>& triangle) {
  const auto& [a, b, c] = triangle;
  // Most corners touch no cut: that is seen without looking for links.
  return !(cuts.touches(a) || cuts.touches(b) || cuts.touches(c)) ||
         !(isCut(mesh, cuts, a, b) || isCut(mesh, cuts, b, c) || isCut(mesh, cuts, c, a));
}

/// Whether `steps` links in a row, `stride` apart, are there and uncut.
bool isJoined(const Mesh& mesh, const Cuts& cuts, ElementId from, ElementId stride, ElementId steps) {
  for (ElementId i = 0; i < steps; ++i) {
    const auto link = find_link(mesh, from + i * stride, from + (i + 1) * stride);
    if (!link || cuts.is_cut(*link)) {
      return false;
    }
  }
  return true;
}

/// A multiplicative hash (Knuth 1973): neighbouring ids go far apart.
ElementId scatter(ElementId e) { return e * 2654435761U >> 16; }

/// 0, step, 2 step, …, and the last.
std::vector<ElementId> everyStepth(ElementId size, unsigned step) {
  std::vector<ElementId> rows;
  for (ElementId i = 0; i + 1 < size; i += step) {
    rows.push_back(i);
  }
  rows.push_back(size - 1);
  return rows;
}

}  // namespace

std::vector<ElementId> uncutLinks(const Mesh& mesh, const Cuts& cuts) {
  std::vector<ElementId> indices;
  indices.reserve(2 * mesh.links.size());
  for (LinkId link = 0; link < mesh.link_count(); ++link) {
    if (!cuts.is_cut(link)) {
      indices.insert(indices.end(), mesh.links[link].begin(), mesh.links[link].end());
    }
  }
  return indices;
}

std::vector<ElementId> uncutFaces(const Mesh& mesh, const Cuts& cuts) {
  std::vector<ElementId> indices;
  indices.reserve(3 * mesh.triangles.size());
  for (const auto& triangle : mesh.triangles) {
    if (isWhole(mesh, cuts, triangle)) {
      indices.insert(indices.end(), triangle.begin(), triangle.end());
    }
  }
  return indices;
}

std::vector<ElementId> coarseLinks(const Mesh& mesh, const Cuts& cuts, unsigned step) {
  const auto& size = mesh.lattice->size;
  const std::array<ElementId, 3> stride{1, size[0], size[0] * size[1]};
  std::vector<ElementId> indices;
  for (const ElementId z : everyStepth(size[2], step)) {
    for (const ElementId y : everyStepth(size[1], step)) {
      for (const ElementId x : everyStepth(size[0], step)) {
        const std::array<ElementId, 3> at{x, y, z};
        const ElementId from = x + y * stride[1] + z * stride[2];
        for (int k = 0; k < 3; ++k) {
          const ElementId steps = std::min<ElementId>(step, size[k] - 1 - at[k]);
          if (steps > 0 && isJoined(mesh, cuts, from, stride[k], steps)) {
            indices.insert(indices.end(), {from, from + steps * stride[k]});
          }
        }
      }
    }
  }
  return indices;
}

std::vector<ElementId> scattered(const Mesh& mesh, unsigned step) {
  std::vector<ElementId> indices;
  for (ElementId e = 0; e < mesh.element_count(); ++e) {
    if (scatter(e) % (step * step) == 0) {
      indices.push_back(e);
    }
  }
  return indices;
}

std::vector<ElementId> thinned(const std::vector<ElementId>& elements, std::size_t atMost) {
  const std::size_t share = (elements.size() + atMost - 1) / atMost;
  if (share <= 1) {
    return elements;
  }
  std::vector<ElementId> indices;
  std::copy_if(elements.begin(), elements.end(), std::back_inserter(indices),
               [share](ElementId e) { return scatter(e) % share == 0; });
  return indices;
}

}  // namespace chainmail
