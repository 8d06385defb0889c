#include "chainmail/mesh_file.h"

#include "api/access.h"
#include "files/formats/mesh_state.h"
#include "files/mesh/mesh_file.h"
#include "files/mesh/mesh_formats.h"
#include "files/mesh/open_mesh.h"

namespace chainmail::api {
namespace {

inner::ReadOptions read_options_of(const ReadOptions& options) {
  inner::ReadOptions result;
  result.size = options.lattice;
  result.spacing = options.spacing;
  result.space_dimension = options.space_dimension;
  result.voxels.threshold = options.threshold;
  result.voxels.every = options.every;
  result.data_outside = options.data_outside;
  result.import_program = options.import_program;
  result.voxels.stiff_where_dense = options.stiff_where_dense;
  result.weld = options.weld;
  return result;
}

FormatUse use_of(FileUse use) {
  static_assert(int(FileUse::write_positions) == int(FormatUse::write_positions));
  static_assert(int(FileUse::write) == int(FormatUse::write));
  return FormatUse(int(use));
}

const inner::MeshFormat& written_format(const std::filesystem::path& path) {
  return inner::mesh_format(path, FormatUse::write);
}

/// Calls write(state) with what is written of an object.
template <class Write>
void write_state(const Body& body, Write write) {
  const inner::Body& impl = Access::body(body);
  guarded([&] { write(MeshState{impl.mesh(), impl.cuts(), impl.positions(), impl.softness()}); });
}

template <class Write>
void write_state(const Mesh& mesh, Write write) {
  const inner::Mesh& impl = *Access::pointer(mesh);
  guarded([&] { write(MeshState{impl, Cuts(), rest_positions(impl), Softness{{}, Access::impl(mesh).softness}}); });
}

}  // namespace

std::vector<FileFormat> file_formats() {
  std::vector<FileFormat> formats;
  for (const inner::MeshFormat& one : mesh_formats()) {
    formats.push_back({std::string(one.name), std::string(one.endings), std::string(one.help), one.reads(),
                       one.writes(), one.holds_positions});
  }
  return formats;
}

std::string file_endings(FileUse use, std::string_view last) { return mesh_endings(use_of(use), last); }
std::string file_formats_help(FileUse use) { return mesh_formats_help(use_of(use)); }

void check_format(const std::filesystem::path& path, FileUse use) {
  guarded([&] { inner::mesh_format(path, use_of(use)); });
}

void check_format(const std::filesystem::path& path, const Mesh& mesh) {
  guarded([&] { check_holds(written_format(path), *Access::pointer(mesh), path); });
}

std::string lost_in_format(const std::filesystem::path& path, const Mesh& mesh) {
  return guarded([&] { return lost_in(written_format(path), *Access::pointer(mesh)); });
}

Mesh read_mesh(const std::filesystem::path& path, const ReadOptions& options, const Job& job) {
  return guarded([&] {
    OpenedMesh opened = open_mesh(path, read_options_of(options), Access::progress(job));
    return Access::mesh(std::move(opened.mesh), std::move(opened.softness), std::move(opened.remark), opened.flaws);
  });
}

void write_mesh(const std::filesystem::path& path, const Body& body, const Job& job) {
  write_state(body, [&](const MeshState& state) { save_mesh(path, state, Access::progress(job)); });
}

void write_mesh(const std::filesystem::path& path, const Mesh& mesh, const Job& job) {
  write_state(mesh, [&](const MeshState& state) { save_mesh(path, state, Access::progress(job)); });
}

void write_mesh(std::ostream& out, const std::filesystem::path& name, const Body& body, const Job& job) {
  write_state(body, [&](const MeshState& state) {
    inner::write_mesh(out, written_format(name), state, Access::progress(job));
  });
}

void write_mesh(std::ostream& out, const std::filesystem::path& name, const Mesh& mesh, const Job& job) {
  write_state(mesh, [&](const MeshState& state) {
    inner::write_mesh(out, written_format(name), state, Access::progress(job));
  });
}

}  // namespace chainmail::api
