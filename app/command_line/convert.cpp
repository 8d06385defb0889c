#include "command_line/common.h"
#include "files/mesh/fill.h"
#include "files/repair/simplify.h"

// The subcommands that write another mesh: convert, fill and simplify.
namespace chainmail::command_line {

Command add_convert(CLI::App& root) {
  CLI::App* app = root.add_subcommand("convert", "Write a mesh in another format");
  const auto mesh = add_mesh(*app);
  const CLI::Option* target = add_mesh_target(*app);
  app->footer("Example:\n  chainmail convert liver.msh -o liver.vtu");
  return {app, [mesh, target] {
            mesh->options.read();
            check_mesh_output(mesh->path(), *value_of(target));
            const OpenedMesh opened = open_mesh(*mesh);
            say_flaws(opened);
            write_mesh_file(mesh->path(), *value_of(target), opened.mesh, opened.softness);
          }};
}

Command add_fill(CLI::App& root) {
  CLI::App* app = root.add_subcommand("fill", "Fill a closed surface with tetrahedra");
  const auto mesh = add_mesh_path(*app);
  const auto edge = std::make_shared<std::optional<double>>();
  mesh->options.add("--edge", "LENGTH",
                    "approximate length of inner edges, in mesh units [the mean edge of the surface]", *edge,
                    [](const std::string& where, const std::string& text) {
                      const double length = parse_number_of(where, text);
                      require(length > 0, where, "it must be a number above 0", "use the length of the new edges");
                      return length;
                    });
  const CLI::Option* target = add_mesh_target(*app);
  app->footer("Example:\n  chainmail fill sphere.obj --edge 0.8 -o ball.msh");
  return {app, [=] {
            const std::string path = mesh->path(), name = shown(path);
            mesh->options.read();
            check_mesh_output(path, *value_of(target));
            const OpenedMesh surface = open_mesh(*mesh);
            say_flaws(surface);
            const double size = edge->value_or(surface.mesh->mean_link_length);
            write_mesh_file(path, *value_of(target),
                            watched("filling " + name, {{"surface", name}},
                                    [&](const Progress& progress) { return fill(*surface.mesh, size, progress); }));
          }};
}

Command add_simplify(CLI::App& root) {
  CLI::App* app = root.add_subcommand("simplify", "Give a surface fewer elements");
  const auto mesh = add_mesh_path(*app);
  add_weld(*mesh);
  const auto count = std::make_shared<std::uint32_t>(0);
  mesh->options
      .add("--elements", "N", "number of elements of the result, fewer than the surface has", *count,
           count_from(fewest_simplified))
      ->required();
  const CLI::Option* target = add_mesh_target(*app, "-o,--output");
  app->footer(
      "Collapses edges, those that change the shape least first. Faces become triangles. A closed surface stays\n"
      "closed; elements at the border of an open one stay where they are. Simplify before you fill.\n\n"
      "Example:\n  chainmail simplify scan.ply --elements 3000 -o coarse.ply");
  return {app, [=] {
            mesh->options.read();
            const std::string path = mesh->path(), name = shown(path);
            check_mesh_output(path, *value_of(target));
            const OpenedMesh opened = open_mesh(*mesh);
            say_flaws(opened);
            write_mesh_file(
                path, *value_of(target),
                watched("simplifying " + name, {{"elements", "--elements"}, {"surface", name}},
                        [&](const Progress& progress) { return simplify(*opened.mesh, *count, progress); }));
          }};
}

}  // namespace chainmail::command_line
