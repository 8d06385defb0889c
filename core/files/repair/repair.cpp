#include "files/repair/repair.h"

#include <algorithm>
#include <numeric>
#include <optional>
#include <utility>

#include "files/import/handover.h"
#include "files/import/import_process.h"
#include "files/mesh/flaws.h"
#include "files/mesh/join.h"
#include "files/text/text.h"
#include "mesh/cells.h"
#include "mesh/error.h"

namespace chainmail {
namespace {

// A hole with 2,000 edges takes some seconds.
constexpr ImportLimits closing_limits{std::uint64_t{8} << 30, 600, 1800};

std::vector<Point> rest_of(const Mesh& mesh) {
  std::vector<Point> rest;
  rest.reserve(mesh.element_count());
  for (ElementId e = 0; e < mesh.element_count(); ++e) {
    rest.push_back(mesh.rest_position(e));
  }
  return rest;
}

/// Returns the parts of a mesh, except for its links.
MeshParts parts_of(const Mesh& mesh) {
  MeshParts parts;
  parts.rest = rest_of(mesh);
  parts.triangles.assign(mesh.triangles.begin(), mesh.triangles.begin() + std::ptrdiff_t(mesh.own_triangles));
  parts.polygons = mesh.polygons;
  parts.tetrahedra = mesh.tetrahedra;
  parts.hexahedra = mesh.hexahedra;
  parts.texture = mesh.texture;
  parts.space_dimension = mesh.space_dimension;
  return parts;
}

/// Gives the elements of parts their new ids, and removes those that are gone.
void rename(MeshParts& parts, const std::vector<ElementId>& ids, const std::vector<bool>& kept) {
  rename_elements(parts, ids);
  std::size_t e = 0;
  std::erase_if(parts.rest, [&](const Point& /*position*/) { return !kept[e++]; });
}

/// Leaves out corners of polygons that are now those before them. Three different corners are a triangle.
void collapse_polygons(MeshParts& parts) {
  const std::vector<ElementId> all = std::exchange(parts.polygons, {});
  for (std::size_t i = 0; i < all.size(); i += all[i] + 1) {
    std::vector<ElementId> corners(all.begin() + std::ptrdiff_t(i) + 1, all.begin() + std::ptrdiff_t(i + 1 + all[i]));
    corners.erase(std::unique(corners.begin(), corners.end()), corners.end());
    while (corners.size() > 1 && corners.front() == corners.back()) {
      corners.pop_back();
    }
    if (corners.size() >= 3) {
      add_face(parts, corners);
    }
  }
}

/// Returns the ids of the kept elements, one after another.
std::vector<ElementId> numbered(const std::vector<bool>& kept) {
  std::vector<ElementId> ids(kept.size(), Repaired::gone);
  ElementId next = 0;
  for (std::size_t e = 0; e < kept.size(); ++e) {
    ids[e] = kept[e] ? next++ : Repaired::gone;
  }
  return ids;
}

/// Returns the rows of the neighbour table in their order, without the empty ones.
void take_rows(const Mesh& mesh, const std::vector<ElementId>& ids, MeshParts& parts) {
  parts.first_entry.push_back(0);
  for (ElementId e = 0; e < mesh.element_count(); ++e) {
    const auto row = mesh.neighbours_of(e);
    if (ids[e] != Repaired::gone) {
      for (const ElementId other : row) {
        parts.neighbours.push_back(ids[other]);
      }
      parts.first_entry.push_back(EntryId(parts.neighbours.size()));
    }
  }
}

/// Returns the surface as the task `close` reads it: its triangles, and the holes as polygons.
ImportedMesh surface_with(const Mesh& mesh, const std::vector<std::vector<ElementId>>& holes) {
  ImportedMesh surface;
  surface.parts.rest = rest_of(mesh);
  surface.parts.triangles = joined_triangles(mesh, first_at_position(mesh));
  for (const auto& hole : holes) {
    surface.parts.polygons.push_back(ElementId(hole.size()));
    surface.parts.polygons.insert(surface.parts.polygons.end(), hole.begin(), hole.end());
  }
  return surface;
}

ImportedMesh patches_of(const Mesh& mesh, const std::vector<std::vector<ElementId>>& holes, const Progress& progress) {
  ImportInput input("surface");
  const auto bytes = encode_imported(surface_with(mesh, holes));
  input.write("surface", {reinterpret_cast<const char*>(bytes.data()), bytes.size()});
  return run_import_of<ImportedMesh>("close", input, {}, closing_limits, progress);
}

/// Appends the new elements and triangles of the patches, and the links along their edges.
void append(const Mesh& mesh, const MeshParts& patches, MeshParts& parts) {
  for (std::size_t e = parts.rest.size(); e < patches.rest.size(); ++e) {
    Point position = patches.rest[e];
    for (int axis = 0; axis < 3; ++axis) {
      position[axis] = mesh.has_axis(axis) ? position[axis] : mesh.origin[axis];
    }
    parts.rest.push_back(position);
  }
  MeshParts edges;
  edges.triangles = patches.triangles;
  add_links_along_edges(edges);
  parts.links.insert(parts.links.end(), edges.links.begin(), edges.links.end());
  parts.triangles.insert(parts.triangles.end(), patches.triangles.begin(), patches.triangles.end());
}

/// Returns a mesh that has all elements of the one before, with their ids.
Repaired with_all_elements(MeshPointer after, const Mesh& before) {
  Repaired repaired{std::move(after), {}};
  repaired.new_ids.resize(before.element_count());
  std::iota(repaired.new_ids.begin(), repaired.new_ids.end(), ElementId{0});
  return repaired;
}

}  // namespace

Repaired weld(const Mesh& mesh, double tolerance, const Progress& progress) {
  progress.report(0);
  const auto first = tolerance > 0 ? first_within(rest_of(mesh), tolerance) : first_at_position(mesh);
  std::vector<bool> kept(first.size());
  for (ElementId e = 0; e < first.size(); ++e) {
    kept[e] = first[e] == e;
  }
  Repaired repaired{nullptr, numbered(kept)};
  for (ElementId e = 0; e < first.size(); ++e) {
    repaired.new_ids[e] = repaired.new_ids[first[e]];
  }
  MeshParts parts = parts_of(mesh);
  parts.links = mesh.links;
  rename(parts, repaired.new_ids, kept);
  collapse_polygons(parts);
  MeshFlaws flaws;  // those of the welding
  leave_out_flawed(parts, flaws);
  repaired.mesh = build_mesh(std::move(parts), progress.part(0.2, 1));
  return repaired;
}

Repaired remove_loose(const Mesh& mesh, const Progress& progress) {
  progress.report(0);
  std::vector<bool> kept = loose_elements(mesh);
  kept.flip();
  Repaired repaired{nullptr, numbered(kept)};
  MeshParts parts = parts_of(mesh);
  rename(parts, repaired.new_ids, kept);
  take_rows(mesh, repaired.new_ids, parts);
  repaired.mesh = build_mesh(std::move(parts), progress.part(0.2, 1));
  return repaired;
}

Repaired close_holes(const Mesh& mesh, const std::vector<std::vector<ElementId>>& holes, const Progress& progress) {
  if (mesh.has_cells()) {
    throw Error("surface", "the object has cells, and only surfaces have holes", "use a surface");
  }
  const ImportedMesh patches = patches_of(mesh, holes, progress.part(0, 0.8));
  MeshParts parts = parts_of(mesh);
  parts.links = mesh.links;
  append(mesh, patches.parts, parts);
  return with_all_elements(build_mesh(std::move(parts), progress.part(0.8, 1)), mesh);
}

Repaired turn_cells(const Mesh& mesh, const std::vector<std::uint32_t>& cells, const Progress& progress) {
  MeshParts parts = parts_of(mesh);
  for (const std::uint32_t cell : cells) {
    if (cell < parts.tetrahedra.size()) {
      std::swap(parts.tetrahedra[cell][2], parts.tetrahedra[cell][3]);
    } else {
      auto& corners = parts.hexahedra[cell - parts.tetrahedra.size()];
      std::rotate(corners.begin(), corners.begin() + 4, corners.end());  // exchanges the lower and the upper side
    }
  }
  parts.first_entry = mesh.first_entry;
  parts.neighbours = mesh.neighbours;
  return with_all_elements(build_mesh(std::move(parts), progress), mesh);
}

OwnSoftness softness_after(const OwnSoftness& own, const Mesh& before, const Repaired& after) {
  OwnSoftness result;
  for (const auto& [link, softness] : own) {
    const ElementId a = after.new_ids[before.links[link][0]], b = after.new_ids[before.links[link][1]];
    if (const auto kept = a == b ? std::nullopt : find_link(*after.mesh, a, b)) {
      result.set(*kept, softness);
    }
  }
  return result;
}

RepairResult repair(const MeshPointer& mesh, const OwnSoftness& softness, const RepairOptions& options,
                    const Progress& progress) {
  const Defects before = find_defects(*mesh);
  RepairResult result{mesh, mesh, softness, before, before, {}};
  Defects& defects = result.defects;
  const auto take = [&](const Repaired& repaired) {
    result.softness = softness_after(result.softness, *result.mesh, repaired);
    result.mesh = repaired.mesh;
    defects = find_defects(*result.mesh);
  };
  if (options.weld && (options.tolerance > 0 || !defects.duplicates.empty())) {
    take(weld(*result.mesh, options.tolerance, progress.part(0, 0.2)));
    if (const ElementId count = mesh->element_count() - result.mesh->element_count(); count > 0) {
      result.done.push_back(counted(count, "duplicate vertex welded", "duplicate vertices welded"));
    }
  }
  if (const auto count = defects.loose.size(); options.loose && count > 0) {
    take(remove_loose(*result.mesh, progress.part(0.2, 0.4)));
    result.done.push_back(counted(count, "loose point removed", "loose points removed"));
  }
  if (const auto count = defects.holes.size(); options.holes && count > 0) {
    const std::size_t triangles = result.mesh->triangles.size();
    take(close_holes(*result.mesh, defects.holes, progress.part(0.4, 1)));
    result.done.push_back(counted(count - std::min(count, defects.holes.size()), "hole", "holes") + " closed with " +
                          counted(result.mesh->triangles.size() - triangles, "triangle", "triangles"));
  }
  if (const auto count = defects.inverted.size(); options.cells && count > 0) {
    take(turn_cells(*result.mesh, defects.inverted, progress.part(0.9, 1)));
    result.done.push_back(counted(count, "cell turned", "cells turned"));
  }
  return result;
}

}  // namespace chainmail
