#include "mesh/refine.h"

#include <algorithm>
#include <unordered_map>

#include "mesh/cells.h"
#include "mesh/error.h"

namespace chainmail {
namespace {

/// Adds an element in the middle of each edge, once.
class Middles {
 public:
  Middles(MeshParts& parts, std::vector<std::array<ElementId, 2>>& parents) : parts_(parts), parents_(parents) {}

  ElementId between(ElementId a, ElementId b) {
    const std::array<ElementId, 2> ends{std::min(a, b), std::max(a, b)};
    const auto [found, is_new] =
        ids_.try_emplace(std::uint64_t{ends[0]} << 32 | ends[1], static_cast<ElementId>(parts_.rest.size()));
    if (is_new) {
      const Point middle = (parts_.rest[a] + parts_.rest[b]) / 2;
      parts_.rest.push_back(middle);
      parents_.push_back(ends);
    }
    return found->second;
  }

 private:
  MeshParts& parts_;
  std::vector<std::array<ElementId, 2>>& parents_;
  std::unordered_map<std::uint64_t, ElementId> ids_;
};

/// Bey's order of the corners decides which diagonal of the inner octahedron the next refinement takes. He lists the
/// sixth and the eighth with their first and third corners exchanged. That inverts them and does not change the
/// diagonal.
void add_parts(const std::array<ElementId, 4>& cell, Middles& middles, std::vector<std::array<ElementId, 4>>& cells) {
  const auto [a, b, c, d] = cell;
  const ElementId ab = middles.between(a, b), ac = middles.between(a, c), ad = middles.between(a, d),
                  bc = middles.between(b, c), bd = middles.between(b, d), cd = middles.between(c, d);
  cells.insert(cells.end(), {{a, ab, ac, ad},
                             {ab, b, bc, bd},
                             {ac, bc, c, cd},
                             {ad, bd, cd, d},
                             {ab, ac, ad, bd},
                             {bc, ac, ab, bd},
                             {ac, ad, bd, cd},
                             {bd, bc, ac, cd}});
}

void add_parts(const std::array<ElementId, 3>& face, Middles& middles, std::vector<std::array<ElementId, 3>>& faces) {
  const auto [a, b, c] = face;
  const ElementId ab = middles.between(a, b), bc = middles.between(b, c), ca = middles.between(c, a);
  faces.insert(faces.end(), {{a, ab, ca}, {ab, b, bc}, {ca, bc, c}, {ab, bc, ca}});
}

void add_parts(const std::array<ElementId, 2>& link, Middles& middles, std::vector<std::array<ElementId, 2>>& links) {
  const ElementId middle = middles.between(link[0], link[1]);
  links.insert(links.end(), {{link[0], middle}, {middle, link[1]}});
}

template <class Whole>
std::vector<Whole> all_parts(const std::vector<Whole>& wholes, Middles& middles, const Progress& progress) {
  std::vector<Whole> parts;
  for (std::size_t i = 0; i < wholes.size(); ++i) {
    progress.report(i, wholes.size());
    add_parts(wholes[i], middles, parts);
  }
  return parts;
}

}  // namespace

Refinement refine(const Mesh& mesh, const Progress& progress) {
  if (!mesh.hexahedra.empty() || !mesh.polygons.empty()) {
    throw Error("refinement", "the object has hexahedra or polygons", "use tetrahedra or triangles");
  }
  Refinement result;
  MeshParts parts;
  for (ElementId e = 0; e < mesh.element_count(); ++e) {
    parts.rest.push_back(mesh.rest_position(e));
  }
  Middles middles(parts, result.parents);
  if (!mesh.tetrahedra.empty()) {
    parts.tetrahedra = all_parts(mesh.tetrahedra, middles, progress.part(0, 0.5));
  } else if (!mesh.triangles.empty()) {
    parts.triangles = all_parts(mesh.triangles, middles, progress.part(0, 0.5));
  } else {
    parts.links = all_parts(mesh.links, middles, progress.part(0, 0.5));
  }
  if (parts.links.empty()) {
    add_links_along_edges(parts);
  }
  parts.space_dimension = mesh.space_dimension;
  result.mesh = build_mesh(std::move(parts), progress.part(0.5, 1));
  return result;
}

std::vector<double> interpolated(const Refinement& finer, const std::vector<double>& values, int dimension) {
  const auto n = static_cast<std::size_t>(dimension);
  std::vector<double> all = values;
  all.reserve(values.size() + n * finer.parents.size());
  for (const auto& [a, b] : finer.parents) {
    for (std::size_t k = 0; k < n; ++k) {
      all.push_back((all[a * n + k] + all[b * n + k]) / 2);
    }
  }
  return all;
}

}  // namespace chainmail
