#include <optional>

#include "command_line/common.h"
#include "command_line/progress_line.h"
#include "files/mesh/fill.h"
#include "files/text/text.h"
#include "mesh/error.h"

// The subcommands convert and fill.
namespace chainmail::command_line {
namespace {

/// Returns the length of the inner edges (mesh units). The default is the mean edge length of the surface.
double size_of(const CLI::Option* option, const Mesh& surface) {
  const auto text = value_of(option);
  return text ? parse_number_of("--edge", *text) : surface.mean_link_length;
}

}  // namespace

Command add_convert(CLI::App& root) {
  CLI::App* app = root.add_subcommand("convert", "Write a mesh in another format");
  MeshOptions options = add_mesh_options(*app);
  const CLI::Option* target = add_mesh_target(*app);
  app->footer("Example:\n  chainmail convert liver.msh -o liver.vtu");
  return {app, [options, target] {
            mesh_format(*value_of(target), FormatUse::write);
            const OpenedMesh opened = open_mesh(options);
            say_flaws(opened);
            write_mesh_file(options, *value_of(target), *opened.mesh, opened.softness);
          }};
}

Command add_fill(CLI::App& root) {
  CLI::App* app = root.add_subcommand("fill", "Fill a closed surface with tetrahedra");
  MeshOptions options;
  options.path = add_value(*app, "MESH", "", "file of the surface: " + mesh_endings(FormatUse::read))->required();
  const CLI::Option* size = add_value(
      *app, "--edge", "LENGTH", "approximate length of inner edges, in mesh units [the mean edge of the surface]");
  const CLI::Option* target = add_mesh_target(*app);
  app->footer("Example:\n  chainmail fill sphere.obj --edge 0.8 -o ball.msh");
  return {app, [options, size, target] {
            const std::string path = *value_of(options.path);
            mesh_format(*value_of(target), FormatUse::write);
            const OpenedMesh surface = chainmail::open_mesh(path);
            say_flaws(surface);
            Watch watch("filling " + shown(path));
            const MeshPointer filled = in_options({{"size", "--edge"}, {"surface", shown(path)}}, [&] {
              return fill(*surface.mesh, size_of(size, *surface.mesh), watch.progress());
            });
            write_mesh_file(options, *value_of(target), *filled, {});
          }};
}

}  // namespace chainmail::command_line
