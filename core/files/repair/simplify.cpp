#include "files/repair/simplify.h"

#include <algorithm>
#include <string>
#include <vector>

#include "files/import/handover.h"
#include "files/import/import_process.h"
#include "mesh/cells.h"
#include "mesh/error.h"

namespace chainmail {
namespace {

constexpr ImportLimits simplifying_limits{std::uint64_t{12} << 30, 1800, 7200};
constexpr std::uint64_t most_to_simplify = 4'000'000;

/// Throws Error before anything is computed.
void check(const Mesh& surface, std::uint64_t elements) {
  const std::uint64_t count = surface.element_count();
  if (surface.has_cells()) {
    throw Error("surface", "the object has cells, and only surfaces are simplified",
                "simplify its surface, then fill it");
  }
  if (surface.triangles.empty()) {
    throw Error("surface", "it has no faces", "use a surface");
  }
  if (elements < fewest_simplified) {
    throw Error("elements", std::to_string(elements) + " are too few for a surface",
                "choose " + std::to_string(fewest_simplified) + " or more");
  }
  if (elements >= count) {
    throw Error("elements",
                "the surface has " + std::to_string(count) + ", so " + std::to_string(elements) + " are not fewer",
                count > fewest_simplified ? "choose at most " + std::to_string(count - 1) : "use a finer surface");
  }
  if (count > most_to_simplify) {
    throw Error("surface",
                "it has " + std::to_string(count) + " elements, and at most " + std::to_string(most_to_simplify) +
                    " can be simplified",
                "simplify it in another program");
  }
}

/// Throws Error at the first element that is no corner of a face: it has no place on a simplified surface.
void check_faces(const Mesh& surface) {
  std::vector<bool> has_face(surface.element_count(), false);
  for (const auto& corners : surface.triangles) {
    std::for_each(corners.begin(), corners.end(), [&](ElementId e) { has_face[e] = true; });
  }
  const auto bare = std::find(has_face.begin(), has_face.end(), false);
  if (bare != has_face.end()) {
    throw Error("surface", "its element " + std::to_string(bare - has_face.begin()) + " belongs to no face",
                "remove loose points (Object > Repair, or chainmail repair), and links without faces");
  }
}

ImportedMesh as_triangles(const Mesh& surface) {
  ImportedMesh imported;
  for (ElementId element = 0; element < surface.element_count(); ++element) {
    imported.parts.rest.push_back(surface.rest_position(element));
  }
  imported.parts.triangles = surface.triangles;
  return imported;
}

}  // namespace

MeshPointer simplify(const Mesh& surface, std::uint64_t elements, const Progress& progress) {
  check(surface, elements);
  check_faces(surface);
  ImportInput input("surface");
  const auto bytes = encode_imported(as_triangles(surface));
  input.write("surface", {reinterpret_cast<const char*>(bytes.data()), bytes.size()});
  MeshParts parts = run_import_of<ImportedMesh>("simplify", input, {std::to_string(elements)}, simplifying_limits,
                                                progress.part(0, 0.9))
                        .parts;
  for (Point& position : parts.rest) {
    for (int axis = 0; axis < 3; ++axis) {
      position[axis] = surface.has_axis(axis) ? position[axis] : surface.origin[axis];
    }
  }
  add_links_along_edges(parts);
  parts.texture = surface.texture;
  parts.space_dimension = surface.space_dimension;
  return build_mesh(std::move(parts), progress.part(0.9, 1));
}

}  // namespace chainmail
