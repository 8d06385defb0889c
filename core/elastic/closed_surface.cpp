#include "elastic/closed_surface.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <span>
#include <string>

#include "elastic/methods.h"
#include "mesh/cells.h"
#include "mesh/error.h"
#include "mesh/surface.h"

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

namespace {

using Triangle = std::array<ElementId, 3>;

constexpr double flat = 1e-9;   // height / longest edge: below this, the normal is mostly rounding
constexpr double empty = 1e-9;  // volume / area^(3/2): a sphere has 0.09

/// The triangles on the outside of an object, and the elements of its cells, if any.
struct Outside {
  std::vector<Triangle> triangles;
  std::vector<ElementId> of_cells;
};

Outside outside_of_cells(const MeshPointer& mesh, const Cuts& cuts, const Progress& progress) {
  Outside outside;
  const Surface surface(std::make_shared<CellTable>(mesh, progress), cuts);
  const auto corners = surface.triangles();
  for (std::size_t i = 0; i < corners.size(); i += 3) {
    outside.triangles.push_back({corners[i], corners[i + 1], corners[i + 2]});
  }
  std::ranges::sort(outside.triangles);  // Surface has no fixed order of sides
  for (ElementId e = 0; e < mesh->element_count(); ++e) {
    if (std::ranges::any_of(surface.table().cells_of(e), [&](CellId cell) { return surface.is_whole(cell); })) {
      outside.of_cells.push_back(e);
    }
  }
  return outside;
}

Outside outside_of(const MeshPointer& mesh, const Cuts& cuts, const Progress& progress) {
  return mesh->has_cells() ? outside_of_cells(mesh, cuts, progress) : Outside{mesh->triangles, {}};
}

Facet facet_of(const Mesh& mesh, const Triangle& triangle) {
  return Facet({unit_position(mesh, triangle[0]), unit_position(mesh, triangle[1]), unit_position(mesh, triangle[2])});
}

void check_flat(const Mesh& mesh, const std::vector<Triangle>& triangles) {
  for (const auto& triangle : triangles) {
    const Facet facet = facet_of(mesh, triangle);
    const double longest = std::ranges::max(facet.length);
    if (!(facet.area > flat * longest * longest)) {
      throw Error("BEM",
                  "the elements " + std::to_string(triangle[0]) + ", " + std::to_string(triangle[1]) + " and " +
                      std::to_string(triangle[2]) + " of a triangle are on one line",
                  "move one of them, or leave the triangle out of the file");
    }
  }
}

/// A connected surface whose triangles face outward.
struct Shell {
  std::vector<Triangle> triangles;
  std::vector<Facet> facets;
  std::vector<std::size_t> about;  // indices of the shells that enclose this one
};

void turn_round(const Mesh& mesh, Shell& shell) {
  for (std::size_t i = 0; i < shell.triangles.size(); ++i) {
    std::swap(shell.triangles[i][1], shell.triangles[i][2]);
    shell.facets[i] = facet_of(mesh, shell.triangles[i]);
  }
}

Shell outward(const Mesh& mesh, const std::vector<Triangle>& triangles, const std::vector<std::uint32_t>& members) {
  Shell shell;
  double volume = 0, area = 0;
  for (const std::uint32_t t : members) {
    const Facet& facet = shell.facets.emplace_back(facet_of(mesh, triangles[t]));
    shell.triangles.push_back(triangles[t]);
    volume += facet.area * facet.normal.dot(facet.centroid - shell.facets.front().centroid) / 3;
    area += facet.area;
  }
  if (!(std::abs(volume) > empty * area * std::sqrt(area))) {
    throw Error("BEM", "the surface about element " + std::to_string(shell.triangles[0][0]) + " encloses no volume",
                "use a surface that encloses a volume");
  }
  if (volume < 0) {
    turn_round(mesh, shell);
  }
  return shell;
}

bool encloses(const std::vector<Facet>& facets, const Point& point) {
  double sum = 0;
  for (const Facet& facet : facets) {
    sum += solid_angle(facet, point);
  }
  // The sum is 4π inside and 0 outside. It is 2π on the surface, which does not count as inside.
  return sum > 3 * std::numbers::pi;
}

void find_what_encloses(std::vector<Shell>& shells, const Progress& progress) {
  for (std::size_t i = 0; i < shells.size(); ++i) {
    progress.report(double(i) / double(shells.size()));
    for (std::size_t j = 0; j < shells.size(); ++j) {
      if (i != j && encloses(shells[j].facets, shells[i].facets.front().centroid)) {
        shells[i].about.push_back(j);
      }
    }
  }
}

void append(const Shell& shell, Solid& solid) {
  solid.triangles.insert(solid.triangles.end(), shell.triangles.begin(), shell.triangles.end());
  solid.facets.insert(solid.facets.end(), shell.facets.begin(), shell.facets.end());
}

/// Makes solids of shells. A shell inside an even number of others bounds a solid. A shell inside an odd number is a
/// cavity of the solid of the innermost of them.
std::vector<Solid> solids_of(const Mesh& mesh, std::vector<Shell>& shells) {
  std::vector<Solid> solids;
  std::vector<std::size_t> solid_of(shells.size());
  for (std::size_t i = 0; i < shells.size(); ++i) {
    if (shells[i].about.size() % 2 == 0) {
      solid_of[i] = solids.size();
      append(shells[i], solids.emplace_back());
    }
  }
  for (Shell& shell : shells) {
    if (shell.about.size() % 2 == 1) {
      const auto innermost = std::ranges::max(shell.about, {}, [&](std::size_t j) { return shells[j].about.size(); });
      turn_round(mesh, shell);
      append(shell, solids[solid_of[innermost]]);
    }
  }
  return solids;
}

void place_inner(const Mesh& mesh, const std::vector<ElementId>& elements, std::vector<Solid>& solids,
                 const Progress& progress) {
  std::vector<bool> outer(mesh.element_count());
  for (const Solid& solid : solids) {
    for (const auto& triangle : solid.triangles) {
      for (const ElementId e : triangle) {
        outer[e] = true;
      }
    }
  }
  for (std::size_t i = 0; i < elements.size(); ++i) {
    progress.report(double(i) / double(elements.size()));
    const auto found = std::ranges::find_if(solids, [&](const Solid& solid) {
      return !outer[elements[i]] && encloses(solid.facets, unit_position(mesh, elements[i]));
    });
    if (found != solids.end()) {
      found->inner.push_back(elements[i]);
      found->inner_positions.push_back(unit_position(mesh, elements[i]));
    }
  }
}

}  // namespace

std::vector<Solid> enclosed_solids(const MeshPointer& mesh, const Cuts& cuts, const Progress& progress) {
  auto [triangles, of_cells] = outside_of(mesh, cuts, progress.part(0, 0.2));
  check_boundary_size(triangles.size(), of_cells.size());
  check_flat(*mesh, triangles);
  std::vector<Shell> shells;
  for (const auto& members : part_into_shells(*mesh, cuts, triangles)) {
    shells.push_back(outward(*mesh, triangles, members));
  }
  find_what_encloses(shells, progress.part(0.2, 0.5));
  auto solids = solids_of(*mesh, shells);
  place_inner(*mesh, of_cells, solids, progress.part(0.5, 1));
  return solids;
}

Point unit_position(const Mesh& mesh, ElementId element) {
  const auto& [low, high] = mesh.box;
  const double diagonal = (high - low).norm();
  return (mesh.rest_position(element) - low) / diagonal - (high - low) / (2 * diagonal);
}

}  // namespace chainmail
