#include "files/repair/repair.h"

#include "command_line/common.h"
#include "command_line/progress_line.h"
#include "files/results/summary.h"

namespace chainmail::command_line {
namespace {

struct RepairArguments {
  MeshOptions mesh;
  CLI::Option *weld = nullptr, *loose = nullptr, *holes = nullptr, *cells = nullptr;

  /// True if this repair was asked for, or none was: then all are made.
  bool asks(const CLI::Option* repair) const {
    return repair->count() > 0 || weld->count() + loose->count() + holes->count() + cells->count() == 0;
  }
};

/// Adds an option without a value. (With two literals, CLI11's add_flag is ambiguous.)
CLI::Option* add_switch(CLI::App& app, const std::string& name, const std::string& help) {
  return app.add_flag(name, help);
}

RepairOptions options_of(const RepairArguments& options) {
  const auto tolerance = value_of(options.weld);
  return {.weld = options.asks(options.weld),
          .tolerance = tolerance && !tolerance->empty() ? tolerance_of(*tolerance) : 0,
          .loose = options.asks(options.loose),
          .holes = options.asks(options.holes),
          .cells = options.asks(options.cells)};
}

/// Refuses to close the holes of an object with cells, if that was asked for.
void check_holes(const RepairArguments& options, const Mesh& mesh) {
  if (options.holes->count() > 0 && mesh.has_cells()) {
    throw Error("--holes", "the object has cells, and only surfaces have holes", "leave it out, or use a surface");
  }
}

void repair_file(const RepairArguments& options, const std::string& target, const std::optional<std::string>& json) {
  mesh_format(target, FormatUse::write);
  const OpenedMesh opened = open_mesh(options.mesh);
  say_flaws(opened);
  check_holes(options, *opened.mesh);
  const std::string name = shown(*value_of(options.mesh.path));
  const RepairResult repaired = [&] {
    Watch watch("repairing " + name);
    return in_options({{"surface", name}},
                      [&] { return repair(opened.mesh, opened.softness, options_of(options), watch.progress()); });
  }();
  Outputs outputs;
  add_mesh_file(outputs, options.mesh, target, repaired.mesh, repaired.softness);
  if (json) {
    outputs.add(*json, [&](std::ostream& out) { write_json(out, repaired); });
  }
  if (json != "-") {
    outputs.add("-", [&](std::ostream& out) { write_text(out, repaired); });
  }
  outputs.commit();
}

}  // namespace

Command add_repair(CLI::App& root) {
  CLI::App* app =
      root.add_subcommand("repair", "Repair a mesh: weld duplicates, remove loose points, close holes, turn cells");
  RepairArguments options;
  options.mesh = add_mesh_options(*app, Welding::by_repair);
  options.weld =
      add_value(*app, "--weld", "TOLERANCE",
                "only weld duplicate vertices: elements at the same position, or as close as TOLERANCE, in mesh "
                "units [0]")
          ->expected(0, 1);
  options.loose = add_switch(*app, "--loose", "only remove loose points: elements without links");
  options.holes = add_switch(*app, "--holes", "only close holes of a surface; the outline of an open surface stays");
  options.cells = add_switch(*app, "--cells", "only turn cells that are inside out while others are not");
  CLI::Option* json = add_value(*app, "--json", "FILE", "write the counts before and after as JSON");
  const CLI::Option* target = add_mesh_target(*app);
  app->footer(
      "Without --weld, --loose, --holes and --cells, all four repairs are made. Several may be given.\n"
      "Non-manifold edges are reported but not changed.\n\nExample:\n  chainmail repair scan.ply -o whole.ply");
  return {app, [options, json, target] { repair_file(options, *value_of(target), value_of(json)); }};
}

}  // namespace chainmail::command_line
