#include "chainmail/repair.h"
#include "command_line/common.h"

namespace chainmail::command_line {
Command add_info(CLI::App& root) {
  CLI::App* app = root.add_subcommand("info", "Show the contents of a mesh");
  const MeshOptions mesh = add_mesh_options(*app);
  CLI::Option* json = add_value(*app, "--json", "FILE", "write JSON to this file instead");
  app->footer("Formats:\n" + api::file_formats_help(api::FileUse::read) +
              "\nExample:\n  chainmail info 3x3.dat --json -");
  return {app, [mesh, json] {
            const api::Mesh opened = open_mesh(mesh);
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
