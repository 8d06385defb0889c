#include <optional>

#include "chainmail/repair.h"
#include "command_line/common.h"
#include "command_line/progress_line.h"

// The subcommands that write another mesh: convert, fill and simplify.
namespace chainmail::command_line {
Command add_convert(CLI::App& root) {
  CLI::App* app = root.add_subcommand("convert", "Write a mesh in another format");
  MeshOptions options = add_mesh_options(*app);
  const CLI::Option* target = add_mesh_target(*app);
  app->footer("Example:\n  chainmail convert liver.msh -o liver.vtu");
  return {app, [options, target] {
            api::check_format(*value_of(target), api::FileUse::write);
            const api::Mesh opened = open_mesh(options);
            say_flaws(opened);
            write_mesh_file(options, *value_of(target), opened);
          }};
}

Command add_fill(CLI::App& root) {
  CLI::App* app = root.add_subcommand("fill", "Fill a closed surface with tetrahedra");
  MeshOptions options;
  options.path =
      add_value(*app, "MESH", "", "file of the surface: " + api::file_endings(api::FileUse::read))->required();
  const CLI::Option* size = add_value(
      *app, "--edge", "LENGTH", "approximate length of inner edges, in mesh units [the mean edge of the surface]");
  const CLI::Option* target = add_mesh_target(*app);
  app->footer("Example:\n  chainmail fill sphere.obj --edge 0.8 -o ball.msh");
  return {app, [options, size, target] {
            const std::string path = *value_of(options.path);
            api::check_format(*value_of(target), api::FileUse::write);
            const api::Mesh surface = api::read_mesh(path);
            say_flaws(surface);
            const Watch watch("filling " + api::shown(path));
            const api::Mesh filled = in_options({{"size", "--edge"}, {"surface", api::shown(path)}}, [&] {
              const auto edge = value_of(size);
              return api::fill(surface, edge ? std::optional(parse_number_of("--edge", *edge)) : std::nullopt,
                               watch.job());
            });
            write_mesh_file(options, *value_of(target), filled);
          }};
}

Command add_simplify(CLI::App& root) {
  CLI::App* app = root.add_subcommand("simplify", "Give a surface fewer elements");
  const MeshOptions options = add_mesh_options(*app);
  const CLI::Option* elements =
      add_value(*app, "--elements", "N", "number of elements of the result, fewer than the surface has")->required();
  const CLI::Option* target =
      add_value(*app, "-o,--output", "FILE", "output file: " + api::file_endings(api::FileUse::write))->required();
  app->footer(
      "Collapses edges, those that change the shape least first. Faces become triangles. A closed surface stays\n"
      "closed; elements at the border of an open one stay where they are. Simplify before you fill.\n\n"
      "Example:\n  chainmail simplify scan.ply --elements 3000 -o coarse.ply");
  return {app, [options, elements, target] {
            const std::uint32_t count = whole_number_of(elements, api::fewest_simplified, api::fewest_simplified);
            api::check_format(*value_of(target), api::FileUse::write);
            const api::Mesh opened = open_mesh(options);
            say_flaws(opened);
            const std::string name = api::shown(*value_of(options.path));
            const Watch watch("simplifying " + name);
            const api::Mesh coarse = in_options({{"elements", "--elements"}, {"surface", name}},
                                                [&] { return api::simplify(opened, count, watch.job()); });
            write_mesh_file(options, *value_of(target), coarse);
          }};
}

}  // namespace chainmail::command_line
