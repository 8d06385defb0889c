#include "chainmail/repair.h"
#include "command_line/common.h"
#include "command_line/progress_line.h"

namespace chainmail::command_line {

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
