#include "files/mesh/mesh_file.h"

#include <cassert>

#include "files/mesh/open_mesh.h"
#include "files/text/outputs.h"
#include "files/text/text.h"
#include "mesh/error.h"

namespace chainmail {

MeshPointer read_mesh(const std::filesystem::path& path, const ReadOptions& options, const Progress& progress) {
  return open_mesh(path, options, progress).mesh;
}

void write_mesh(std::ostream& out, const MeshFormat& format, const MeshState& state, const Progress& progress) {
  assert(format.writes() && "mesh_format returns only formats that are written");
  format.write(out, state, progress);
}

void write_mesh(std::ostream& out, const MeshFormat& format, const Mesh& mesh, const OwnSoftness& softness,
                const Progress& progress) {
  write_mesh(out, format, {mesh, Cuts(), rest_positions(mesh), Softness{{}, softness}}, progress);
}

void save_mesh(const std::filesystem::path& path, const MeshState& state, const Progress& progress) {
  const MeshFormat& format = mesh_format(path, FormatUse::write);
  check_holds(format, state.mesh, path);
  write_file(path, [&](std::ostream& out) { write_mesh(out, format, state, progress); });
}

}  // namespace chainmail
