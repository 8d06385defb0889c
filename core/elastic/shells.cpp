#include "elastic/shells.h"

#include <algorithm>
#include <optional>
#include <span>
#include <string>

#include "mesh/cells.h"
#include "mesh/error.h"

namespace chainmail {
namespace {

using Triangle = std::array<ElementId, 3>;

std::string name(ElementId element) { return std::to_string(element); }

/// An edge of a triangle, in the direction in which the triangle runs.
struct Edge {
  std::array<ElementId, 2> ends;  // ascending
  std::uint32_t triangle;
  int side;        // index of the corner where the edge begins
  bool ascending;  // true if the edge begins at its lower end
};

std::vector<Edge> list_edges(std::span<const Triangle> triangles) {
  std::vector<Edge> edges;
  edges.reserve(3 * triangles.size());
  for (std::uint32_t t = 0; t < triangles.size(); ++t) {
    for (int i = 0; i < 3; ++i) {
      const ElementId a = triangles[t][std::size_t(i)], b = triangles[t][std::size_t((i + 1) % 3)];
      edges.push_back({{std::min(a, b), std::max(a, b)}, t, i, a < b});
    }
  }
  std::ranges::stable_sort(edges, {}, &Edge::ends);
  return edges;
}

[[noreturn]] void refuse_edge(const std::array<ElementId, 2>& ends, std::ptrdiff_t triangles, bool cut) {
  const std::string where = "the edge between the elements " + name(ends[0]) + " and " + name(ends[1]);
  if (cut) {
    throw Error("BEM", "a cut along " + where + " opens the surface, and BEM needs a closed one", "undo the cut");
  }
  if (triangles == 1) {
    throw Error("BEM", "the surface is open along " + where + ", and BEM needs a closed one",
                "close its holes by repair, or choose another method");
  }
  throw Error("BEM",
              std::to_string(triangles) + " triangles meet at " + where + ", so the surface has no inside and outside",
              "separate them in the file, or choose another method");
}

/// The triangle across a side of another one. `agrees` is true if both have the same orientation, so that they run
/// along the side in opposite directions.
struct Across {
  std::uint32_t triangle = 0;
  bool agrees = false;
};

/// `cuts` may be null.
std::vector<std::array<Across, 3>> pair_triangles(const Mesh& mesh, const Cuts* cuts,
                                                  std::span<const Triangle> triangles) {
  std::vector<std::array<Across, 3>> across(triangles.size());
  const auto edges = list_edges(triangles);
  for (auto first = edges.begin(); first != edges.end();) {
    const auto end = std::find_if(first, edges.end(), [&](const Edge& edge) { return edge.ends != first->ends; });
    const Edge &one = *first, &other = *(end - 1);
    const bool cut = cuts != nullptr && is_cut_between(mesh, *cuts, one.ends[0], one.ends[1]);
    if (end - first != 2 || cut) {
      refuse_edge(one.ends, end - first, cut);
    }
    const bool agrees = one.ascending != other.ascending;
    across[one.triangle][std::size_t(one.side)] = {other.triangle, agrees};
    across[other.triangle][std::size_t(other.side)] = {one.triangle, agrees};
    first = end;
  }
  return across;
}

/// Gives the triangles of a shell the orientation of its first one.
std::vector<std::uint32_t> turn_alike(std::vector<Triangle>& triangles,
                                      const std::vector<std::array<Across, 3>>& across, std::uint32_t first,
                                      std::vector<std::optional<bool>>& turned) {
  std::vector<std::uint32_t> shell{first};
  turned[first] = false;
  for (std::size_t next = 0; next < shell.size(); ++next) {
    const std::uint32_t t = shell[next];
    for (const auto& [other, agrees] : across[t]) {
      const bool turn = *turned[t] == agrees;
      if (!turned[other]) {
        turned[other] = turn;
        shell.push_back(other);
      } else if (*turned[other] != turn) {
        throw Error("BEM",
                    "the surface around element " + name(triangles[t][0]) +
                        " has only one side, like a Klein bottle, so it has no inside",
                    "use a surface that encloses a volume");
      }
    }
  }
  for (const std::uint32_t t : shell) {
    if (*turned[t]) {
      std::swap(triangles[t][1], triangles[t][2]);
    }
  }
  return shell;
}

}  // namespace

void check_closed(const Mesh& mesh) { pair_triangles(mesh, nullptr, mesh.triangles); }

std::vector<std::vector<std::uint32_t>> part_into_shells(const Mesh& mesh, const Cuts& cuts,
                                                         std::vector<Triangle>& triangles) {
  const auto across = pair_triangles(mesh, &cuts, triangles);
  std::vector<std::optional<bool>> turned(triangles.size());
  std::vector<std::vector<std::uint32_t>> shells;
  for (std::uint32_t t = 0; t < triangles.size(); ++t) {
    if (!turned[t]) {
      shells.push_back(turn_alike(triangles, across, t, turned));
      std::ranges::sort(shells.back());
    }
  }
  return shells;
}

}  // namespace chainmail
