#include "files/repair/repair.h"

#include "command_line/common.h"
#include "files/results/summary.h"

namespace chainmail::command_line {
namespace {

constexpr const char* repair_footer =
    "Without --weld, --loose, --holes and --cells, all four repairs are made. Several may be given.\n"
    "Non-manifold edges are reported but not changed.\n\nExample:\n  chainmail repair scan.ply -o whole.ply";

/// Returns the repairs that were asked for: all, if none was named.
RepairOptions options_of(const Options& options, double tolerance) {
  const bool weld = options.has("--weld"), loose = options.has("--loose"), holes = options.has("--holes"),
             cells = options.has("--cells"), all = !weld && !loose && !holes && !cells;
  return {weld || all, tolerance, loose || all, holes || all, cells || all};
}

void repair_file(const MeshArguments& mesh, double& tolerance, const std::string& target,
                 const std::optional<std::string>& json) {
  mesh.options.read();
  check_mesh_output(mesh.path(), target, json);
  const OpenedMesh opened = open_mesh(mesh);
  require(!mesh.options.has("--holes") || !opened.mesh->has_cells(), "--holes",
          "the object has cells, and only surfaces have holes", "leave it out, or use a surface");
  say_flaws(opened);
  const std::string name = shown(mesh.path());
  const RepairResult repaired = watched("repairing " + name, {{"surface", name}}, [&](const Progress& progress) {
    return repair(opened.mesh, opened.softness, options_of(mesh.options, tolerance), progress);
  });
  Outputs outputs;
  add_mesh_file(outputs, mesh.path(), target, repaired.mesh, repaired.softness);
  add_files(outputs, {{json, [&](std::ostream& out) { write_json(out, repaired); }},
                      {free_output({json}), [&](std::ostream& out) { write_text(out, repaired); }}});
  outputs.commit();
}

}  // namespace

Command add_repair(CLI::App& root) {
  CLI::App* app =
      root.add_subcommand("repair", "Repair a mesh: weld duplicates, remove loose points, close holes, turn cells");
  const auto mesh = add_mesh_path(*app);
  add_layout(*mesh);
  const auto tolerance = std::make_shared<double>(0);
  mesh->options
      .add("--weld", "TOLERANCE",
           "only weld duplicate vertices: elements at the same position, or as close as TOLERANCE, in mesh units [0]",
           *tolerance,
           [](const std::string& where, const std::string& text) {
             return text.empty() ? 0 : tolerance_of(where, text);
           })
      ->expected(0, 1);
  app->add_flag("--loose")->description("only remove loose points: elements without links");
  app->add_flag("--holes")->description("only close holes of a surface; the outline of an open surface stays");
  app->add_flag("--cells")->description("only turn cells that are inside out while others are not");
  const CLI::Option* json = add_value(*app, "--json", "FILE", "write the counts before and after as JSON");
  const CLI::Option* target = add_mesh_target(*app);
  app->footer(repair_footer);
  return {app, [=] { repair_file(*mesh, *tolerance, *value_of(target), value_of(json)); }};
}

}  // namespace chainmail::command_line
