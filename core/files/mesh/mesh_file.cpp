#include "files/mesh/mesh_file.h"

#include <algorithm>
#include <cassert>
#include <string>

#include "files/formats/dat.h"
#include "files/formats/msh.h"
#include "files/formats/obj.h"
#include "files/formats/ply.h"
#include "files/formats/positions_csv.h"
#include "files/formats/vtu.h"
#include "files/mesh/open_mesh.h"
#include "files/text/outputs.h"
#include "files/text/text.h"
#include "mesh/error.h"

namespace chainmail {

MeshPointer read_mesh(const std::filesystem::path& path, const ReadOptions& options, const Progress& progress) {
  return open_mesh(path, options, progress).mesh;
}

void write_mesh(std::ostream& out, MeshFormat format, const MeshState& state, const Progress& progress) {
  switch (format) {
    case MeshFormat::dat:
      return write_dat(out, state.mesh, state.cuts, progress);
    case MeshFormat::obj:
      return write_obj(out, state.mesh, state.cuts, state.positions, progress);
    case MeshFormat::ply:
      return write_ply(out, state, progress);
    case MeshFormat::vtu:
      return write_vtu(out, state, progress);
    case MeshFormat::msh:
      return write_msh(out, state, progress);
    case MeshFormat::csv:
      return write_positions_csv(out, state.mesh, state.positions, progress);
    default:
      assert(false && "mesh_format gives none but those that are written");
  }
}

void save_mesh(const std::filesystem::path& path, const MeshState& state, const Progress& progress) {
  const MeshFormat format = mesh_format(path, FormatUse::write);
  if (!info(format).holds_positions && !state.mesh.lattice) {
    throw Error(shown(path), "a .dat file holds lattices alone, and this mesh stands in none", "save it as .obj");
  }
  write_file(path, [&](std::ostream& out) { write_mesh(out, format, state, progress); });
}

}  // namespace chainmail
