#include "files/repair/defects.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <numeric>
#include <optional>
#include <unordered_map>

#include "files/mesh/flaws.h"
#include "files/text/text.h"

namespace chainmail {
namespace {

// A border is a hole if its length squared is below this number times the area of its faces.
constexpr double widest_hole = 6;

using Triangles = std::vector<std::array<ElementId, 3>>;

/// An edge of a triangle; the lower id first.
struct FaceEdge {
  std::array<ElementId, 2> ends;
  std::uint32_t triangle;
};

/// Returns the edges of all triangles, those between the same elements one after another.
std::vector<FaceEdge> edges_of(const Triangles& triangles, const Progress& progress) {
  std::vector<FaceEdge> edges;
  edges.reserve(3 * triangles.size());
  for (std::uint32_t t = 0; t < triangles.size(); ++t) {
    progress.report(t, 2 * triangles.size());
    for (std::size_t i = 0; i < 3; ++i) {
      const ElementId a = triangles[t][i], b = triangles[t][(i + 1) % 3];
      edges.push_back({{std::min(a, b), std::max(a, b)}, t});
    }
  }
  std::sort(edges.begin(), edges.end(), [](const FaceEdge& a, const FaceEdge& b) { return a.ends < b.ends; });
  progress.report(1);
  return edges;
}

/// Calls visit(first, last) for the edges between the same two elements.
template <class Visit>
void for_each_edge(const std::vector<FaceEdge>& edges, Visit visit) {
  for (auto first = edges.begin(); first != edges.end();) {
    const auto last = std::find_if(first, edges.end(), [&](const FaceEdge& one) { return one.ends != first->ends; });
    visit(first, last);
    first = last;
  }
}

std::vector<std::array<ElementId, 2>> crowded(const std::vector<FaceEdge>& edges) {
  std::vector<std::array<ElementId, 2>> found;
  for_each_edge(edges, [&](auto first, auto last) {
    if (last - first > 2) {
      found.push_back(first->ends);
    }
  });
  return found;
}

/// The connected pieces of a surface and their areas.
class Pieces {
 public:
  Pieces(const Mesh& mesh, const Triangles& triangles, const std::vector<FaceEdge>& edges) : leader_(triangles.size()) {
    std::iota(leader_.begin(), leader_.end(), 0U);
    for_each_edge(edges, [&](auto first, auto last) {
      for (auto other = first + 1; other != last; ++other) {
        leader_[find(other->triangle)] = find(first->triangle);
      }
    });
    area_.resize(triangles.size());
    for (std::uint32_t t = 0; t < triangles.size(); ++t) {
      const Point from = mesh.rest_position(triangles[t][0]);
      const Point u = mesh.rest_position(triangles[t][1]) - from, v = mesh.rest_position(triangles[t][2]) - from;
      area_[find(t)] += u.cross(v).norm() / 2;
    }
  }

  /// Returns the area of the piece that a triangle belongs to.
  double area(std::uint32_t triangle) { return area_[find(triangle)]; }

 private:
  std::uint32_t find(std::uint32_t t) {
    while (leader_[t] != t) {
      t = leader_[t] = leader_[leader_[t]];
    }
    return t;
  }

  std::vector<std::uint32_t> leader_;
  std::vector<double> area_;
};

struct Loop {
  std::vector<ElementId> elements;
  std::uint32_t triangle = 0;  // at its border
};

/// Finds the closed loops of border edges. A loop does not visit an element twice; edges that do not close are left.
class Borders {
 public:
  explicit Borders(std::vector<FaceEdge> border) : border_(std::move(border)), used_(border_.size(), false) {
    for (std::uint32_t i = 0; i < border_.size(); ++i) {
      for (const ElementId end : border_[i].ends) {
        at_[end].push_back(i);
      }
    }
  }

  std::vector<Loop> loops() {
    std::vector<Loop> found;
    for (std::uint32_t i = 0; i < border_.size(); ++i) {
      if (!used_[i]) {
        walk(border_[i].ends[0], found);
      }
    }
    return found;
  }

 private:
  /// Walks along unused edges, and takes each loop out of the path.
  void walk(ElementId from, std::vector<Loop>& found) {
    std::vector<ElementId> path{from};
    std::vector<std::uint32_t> taken;                          // the edge behind each element of the path
    std::unordered_map<ElementId, std::size_t> on{{from, 0}};  // index of each element of the path
    while (!path.empty()) {
      const auto edge = unused_at(path.back());
      if (!edge) {  // a dead end, like a fin whose edge ends at the border: goes back
        on.erase(path.back());
        path.pop_back();
        taken.resize(path.empty() ? 0 : path.size() - 1);
        continue;
      }
      used_[*edge] = true;
      const auto [a, b] = border_[*edge].ends;
      const ElementId next = a == path.back() ? b : a;
      taken.push_back(*edge);
      const auto known = on.find(next);
      if (known == on.end()) {
        on[next] = path.size();
        path.push_back(next);
        continue;
      }
      const std::size_t begin = known->second;
      found.push_back({{path.begin() + std::ptrdiff_t(begin), path.end()}, border_[taken[begin]].triangle});
      for (std::size_t i = begin + 1; i < path.size(); ++i) {
        on.erase(path[i]);
      }
      path.resize(begin + 1);
      taken.resize(begin);
    }
  }

  std::optional<std::uint32_t> unused_at(ElementId element) {
    auto& edges = at_.at(element);
    while (!edges.empty() && used_[edges.back()]) {
      edges.pop_back();
    }
    return edges.empty() ? std::nullopt : std::optional(edges.back());
  }

  std::vector<FaceEdge> border_;
  std::vector<bool> used_;
  std::unordered_map<ElementId, std::vector<std::uint32_t>> at_;  // edges at each element
};

double length_of(const Mesh& mesh, const std::vector<ElementId>& loop) {
  double length = 0;
  for (std::size_t i = 0; i < loop.size(); ++i) {
    length += (mesh.rest_position(loop[(i + 1) % loop.size()]) - mesh.rest_position(loop[i])).norm();
  }
  return length;
}

void find_holes(const Mesh& mesh, const Triangles& triangles, const std::vector<FaceEdge>& edges, Defects& defects) {
  std::vector<FaceEdge> border;
  for_each_edge(edges, [&](auto first, auto last) {
    if (last - first == 1) {
      border.push_back(*first);
    }
  });
  if (border.empty()) {
    return;
  }
  Pieces pieces(mesh, triangles, edges);
  for (Loop& loop : Borders(std::move(border)).loops()) {
    const double length = length_of(mesh, loop.elements);
    if (length * length < widest_hole * pieces.area(loop.triangle)) {
      defects.holes.push_back(std::move(loop.elements));
    } else {
      ++defects.outlines;
    }
  }
}

}  // namespace

std::size_t Defects::hole_edges() const {
  return std::accumulate(holes.begin(), holes.end(), std::size_t{0},
                         [](std::size_t sum, const auto& hole) { return sum + hole.size(); });
}

std::vector<std::array<ElementId, 3>> joined_triangles(const Mesh& mesh, const std::vector<ElementId>& first) {
  Triangles triangles;
  triangles.reserve(mesh.triangles.size());
  for (const auto& [a, b, c] : mesh.triangles) {
    if (first[a] != first[b] && first[b] != first[c] && first[c] != first[a]) {
      triangles.push_back({first[a], first[b], first[c]});
    }
  }
  return triangles;
}

std::vector<bool> loose_elements(const Mesh& mesh) {
  std::vector<bool> loose(mesh.element_count());
  for (ElementId e = 0; e < mesh.element_count(); ++e) {
    loose[e] = mesh.link_count() > 0 && mesh.neighbours_of(e).empty();
  }
  // Files may contain faces and cells without links. The triangles include those of polygons.
  const auto keep_corners = [&loose](const auto& all) {
    for (const auto& corners : all) {
      for (const ElementId corner : corners) {
        loose[corner] = false;
      }
    }
  };
  keep_corners(mesh.triangles);
  keep_corners(mesh.tetrahedra);
  keep_corners(mesh.hexahedra);
  return loose;
}

Defects find_defects(const Mesh& mesh, const Progress& progress) {
  Defects defects;
  progress.report(0);
  const auto first = first_at_position(mesh);
  const auto loose = loose_elements(mesh);
  for (ElementId e = 0; e < mesh.element_count(); ++e) {
    if (first[e] != e) {
      defects.duplicates.push_back(e);
    }
    if (loose[e]) {
      defects.loose.push_back(e);
    }
  }
  if (mesh.has_cells()) {
    defects.inverted = cells_inside_out(mesh);
    if (defects.inverted.size() == mesh.tetrahedra.size() + mesh.hexahedra.size()) {
      defects.inverted.clear();
    }
    return defects;
  }
  const Triangles triangles = joined_triangles(mesh, first);
  const auto edges = edges_of(triangles, progress.part(0.3, 0.6));
  find_holes(mesh, triangles, edges, defects);
  defects.non_manifold =
      crowded(defects.duplicates.empty() ? edges : edges_of(mesh.triangles, progress.part(0.6, 0.9)));
  return defects;
}

std::vector<std::string> in_words(const Defects& defects) {
  std::vector<std::string> words;
  if (const auto count = defects.duplicates.size(); count > 0) {
    words.push_back(counted(count, "duplicate vertex", "duplicate vertices"));
  }
  if (const auto count = defects.loose.size(); count > 0) {
    words.push_back(counted(count, "loose point", "loose points"));
  }
  if (const auto count = defects.holes.size(); count > 0) {
    words.push_back(counted(count, "hole", "holes") + " (" + std::to_string(defects.hole_edges()) + " edges)");
  }
  if (const auto count = defects.non_manifold.size(); count > 0) {
    words.push_back(counted(count, "non-manifold edge", "non-manifold edges"));
  }
  if (const auto count = defects.inverted.size(); count > 0) {
    words.push_back(counted(count, "cell inside out", "cells inside out"));
  }
  return words;
}

}  // namespace chainmail
