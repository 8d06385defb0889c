#include "command_line/common.h"
#include "command_line/progress_line.h"
#include "files/mesh/fill.h"
#include "files/repair/simplify.h"

// The subcommands that write another mesh: convert, fill and simplify.
namespace chainmail::command_line {

Command add_convert(CLI::App& root) {
  CLI::App* app = root.add_subcommand("convert", "Write a mesh in another format");
  MeshOptions options = add_mesh_options(*app);
  const CLI::Option* target = add_mesh_target(*app);
  app->footer("Example:\n  chainmail convert liver.msh -o liver.vtu");
  return {app, [options, target] {
            mesh_format(*value_of(target), FormatUse::write);
            const OpenedMesh opened = open_mesh(options);
            say_flaws(opened);
            write_mesh_file(options, *value_of(target), opened.mesh, opened.softness);
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
              return fill(*surface.mesh, number_of(size, surface.mesh->mean_link_length), watch.progress());
            });
            write_mesh_file(options, *value_of(target), filled);
          }};
}

Command add_simplify(CLI::App& root) {
  CLI::App* app = root.add_subcommand("simplify", "Give a surface fewer elements");
  const MeshOptions options = add_mesh_options(*app);
  const CLI::Option* elements =
      add_value(*app, "--elements", "N", "number of elements of the result, fewer than the surface has")->required();
  const CLI::Option* target = add_mesh_target(*app, "-o,--output");
  app->footer(
      "Collapses edges, those that change the shape least first. Faces become triangles. A closed surface stays\n"
      "closed; elements at the border of an open one stay where they are. Simplify before you fill.\n\n"
      "Example:\n  chainmail simplify scan.ply --elements 3000 -o coarse.ply");
  return {app, [options, elements, target] {
            const std::uint32_t count = whole_number_of(elements, fewest_simplified, fewest_simplified);
            mesh_format(*value_of(target), FormatUse::write);
            const OpenedMesh opened = open_mesh(options);
            say_flaws(opened);
            const std::string name = shown(*value_of(options.path));
            Watch watch("simplifying " + name);
            const MeshPointer coarse = in_options({{"elements", "--elements"}, {"surface", name}},
                                                  [&] { return simplify(*opened.mesh, count, watch.progress()); });
            write_mesh_file(options, *value_of(target), coarse);
          }};
}

}  // namespace chainmail::command_line
