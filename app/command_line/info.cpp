#include "chainmail/repair.h"
#include "chainmail/session.h"
#include "command_line/common.h"

namespace chainmail::command_line {
namespace {

/// Reads a mesh, or the object of a session. Reading a session checks its moves and its lesson, too. A mesh that it
/// names is beside it or among the samples.
api::Mesh contents_of(const MeshOptions& options) {
  const std::filesystem::path path = *value_of(options.path);
  if (!api::is_session(path)) {
    return open_mesh(options);
  }
  const api::Body body = api::read_session(path, [&](const std::string& name) {
    const std::filesystem::path beside = path.parent_path() / name, sample = samples_folder() / name;
    std::error_code none;
    return api::read_mesh(!exists(beside, none) && exists(sample, none) ? sample : beside);
  });
  return body.mesh();
}

}  // namespace

Command add_info(CLI::App& root) {
  CLI::App* app = root.add_subcommand("info", "Show the contents of a mesh, or check a session and its lesson");
  const MeshOptions mesh = add_mesh_options(*app);
  CLI::Option* json = add_value(*app, "--json", "FILE", "write JSON to this file instead");
  app->footer("Formats:\n" + api::file_formats_help(api::FileUse::read) +
              "\nExample:\n  chainmail info 3x3.dat --json -");
  return {app, [mesh, json] {
            const api::Mesh opened = contents_of(mesh);
            if (const auto path = value_of(json)) {
              api::Outputs outputs;
              outputs.keep(*value_of(mesh.path));
              outputs.add(*path, [&](std::ostream& out) { out << api::describe_json(opened); });
              outputs.commit();
            } else {
              api::write_file("-", [&](std::ostream& out) { out << api::describe(opened); });
            }
          }};
}

}  // namespace chainmail::command_line
