#include "files/mesh_file.h"

#include <algorithm>
#include <cassert>
#include <string>

#include "files/dat.h"
#include "files/msh.h"
#include "files/obj.h"
#include "files/open_mesh.h"
#include "files/outputs.h"
#include "files/ply.h"
#include "files/tables.h"
#include "files/text.h"
#include "files/vtu.h"
#include "mesh/error.h"

namespace chainmail {

MeshPointer read_mesh(const std::filesystem::path& path, const ReadOptions& options, const Progress& progress) {
  return open_mesh(path, options, progress).mesh;
}

std::optional<std::array<std::uint32_t, 3>> parse_size(std::string_view text, int sizes) {
  std::array<std::uint32_t, 3> size{1, 1, 1};
  int count = 0;
  for (;;) {
    const std::size_t end = std::min(text.find('x'), text.size());
    const auto number = parse_count(text.substr(0, end));
    if (!number || *number == 0 || count == 3) {
      return std::nullopt;
    }
    size[count++] = *number;
    if (end == text.size()) {
      break;
    }
    text.remove_prefix(end + 1);
  }
  return (sizes == 0 ? count > 1 : count == sizes) ? std::optional(size) : std::nullopt;
}

PositionView rest_positions(const Mesh& mesh) {
  return {mesh.rest.data(), sizeof(double) * mesh.space_dimension, Precision::double_precision};
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
