#include "command_line/common.h"
#include "files/results/summary.h"
#include "files/session/session.h"

namespace chainmail::command_line {
namespace {

/// Reads a mesh, or the object of a session. Reading a session checks its moves and its lesson, too. A mesh that it
/// names is beside it or among the samples.
OpenedMesh contents_of(const MeshArguments& mesh) {
  const std::filesystem::path path = mesh.path();
  InputFile input = open_file(path);
  if (input.kind != FileKind::session) {
    return open_mesh(mesh, std::move(input));
  }
  const auto open = [&](const std::string& name, std::uint32_t /*across*/, const Progress& progress) {
    const std::filesystem::path beside = path.parent_path() / name, sample = samples_folder() / name;
    std::error_code none;
    return read_mesh(!exists(beside, none) && exists(sample, none) ? sample : beside, {}, progress);
  };
  const Session session = watched("reading " + shown(path), {}, [&](const Progress& progress) {
    return read_session(std::move(input.file), progress, open);
  });
  return {session.mesh, {}, {}, {}};
}

}  // namespace

Command add_info(CLI::App& root) {
  CLI::App* app = root.add_subcommand("info", "Show the contents of a mesh, or check a session and its lesson");
  const auto mesh = add_mesh(*app);
  const CLI::Option* json = add_value(*app, "--json", "FILE", "write JSON to this file instead");
  app->footer("Formats:\n" + mesh_formats_help(FormatUse::read) + "\nExample:\n  chainmail info 3x3.dat --json -");
  return {app, [mesh, json] {
            const auto path = value_of(json);
            mesh->options.read();
            check_outputs({mesh->path()}, {path});
            const MeshSummary summary = summarize(contents_of(*mesh));
            write_outputs({mesh->path()}, {{path, [&](std::ostream& out) { write_json(out, summary); }},
                                           {path ? std::nullopt : standard_output,
                                            [&](std::ostream& out) { write_text(out, summary); }}});
          }};
}

}  // namespace chainmail::command_line
