#include "files/mesh/fill.h"

#include <cmath>
#include <string>

#include "files/import/handover.h"
#include "files/import/import_process.h"
#include "files/mesh/open_mesh.h"
#include "files/text/text.h"
#include "mesh/error.h"

namespace chainmail {
namespace {

// A million tetrahedra take a minute and less than 2 GiB.
constexpr ImportLimits filling_limits{std::uint64_t{12} << 30, 1800, 7200};

ImportedMesh as_imported(const Mesh& surface) {
  ImportedMesh imported;
  for (ElementId element = 0; element < surface.element_count(); ++element) {
    imported.parts.rest.push_back(surface.rest_position(element));
  }
  imported.parts.triangles.assign(surface.triangles.begin(),
                                  surface.triangles.begin() + static_cast<std::ptrdiff_t>(surface.own_triangles));
  imported.parts.polygons = surface.polygons;
  return imported;
}

}  // namespace

MeshPointer fill(const Mesh& surface, double size, const Progress& progress) {
  if (!(size > 0) || !std::isfinite(size)) {
    throw Error("size", "it must be a number above 0", "use the length of the new edges");
  }
  if (surface.has_cells()) {
    throw Error("surface", "the object already has cells", "use a closed surface");
  }
  ImportInput input("surface");
  const auto bytes = encode_imported(as_imported(surface));
  input.write("surface", {reinterpret_cast<const char*>(bytes.data()), bytes.size()});
  std::string length;
  append_number(length, size);
  auto filled = run_import_of<ImportedMesh>("fill", input, {length}, filling_limits, progress.part(0, 0.9));
  return opened(std::move(filled), "surface", {}, progress.part(0.9, 1)).mesh;
}

}  // namespace chainmail
