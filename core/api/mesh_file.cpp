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

Mesh read_mesh(const std::filesystem::path& path, const ReadOptions& options, const Job& job) {
  return guarded([&] {
    OpenedMesh opened = open_mesh(path, read_options_of(options), Access::progress(job));
    const std::string flaws = in_words(opened.flaws);
    const std::string between = opened.remark.empty() || flaws.empty() ? "" : "; ";
    return Access::mesh(std::move(opened.mesh), std::move(opened.softness), opened.remark + between + flaws);
  });
}

void write_mesh(const std::filesystem::path& path, const Body& body, const Job& job) {
  write_state(body, [&](const MeshState& state) { save_mesh(path, state, Access::progress(job)); });
}

void write_mesh(const std::filesystem::path& path, const Mesh& mesh, const Job& job) {
  write_state(mesh, [&](const MeshState& state) { save_mesh(path, state, Access::progress(job)); });
}

}  // namespace chainmail::api
