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
  return result;
}

/// Joins what is to say about a file, in sentences without a full stop.
std::string joined(const std::string& one, const std::string& other) {
  return one.empty() || other.empty() ? one + other : one + "; " + other;
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
    return Access::mesh(std::move(opened.mesh), std::move(opened.softness),
                        joined(opened.remark, in_words(opened.flaws)));
  });
}

void write_mesh(const std::filesystem::path& path, const Body& body, const Job& job) {
  guarded([&] {
    const inner::Body& impl = Access::body(body);
    save_mesh(path, {impl.mesh(), impl.cuts(), impl.positions(), impl.softness()}, Access::progress(job));
  });
}

void write_mesh(const std::filesystem::path& path, const Mesh& mesh, const Job& job) {
  guarded([&] {
    const inner::Mesh& impl = *Access::pointer(mesh);
    save_mesh(path, {impl, Cuts(), rest_positions(impl), Softness{{}, Access::impl(mesh).softness}},
              Access::progress(job));
  });
}

}  // namespace chainmail::api
