#include "files/repair/repair.h"

#include <optional>
#include <sstream>

#include "command_line/common.h"
#include "command_line/progress_line.h"
#include "files/results/summary.h"
#include "files/text/text.h"
#include "mesh/error.h"

namespace chainmail::command_line {
namespace {

struct RepairOptions {
  MeshOptions mesh;
  CLI::Option *weld = nullptr, *loose = nullptr, *holes = nullptr;

  /// True if this repair was asked for, or none was: then all are made.
  bool asks(const CLI::Option* repair) const {
    return repair->count() > 0 || weld->count() + loose->count() + holes->count() == 0;
  }
};

/// Adds an option without a value. (With two literals, CLI11's add_flag is ambiguous.)
CLI::Option* add_switch(CLI::App& app, const std::string& name, const std::string& help) {
  return app.add_flag(name, help);
}

std::string number_of(std::size_t count, const char* one, const char* several) {
  return std::to_string(count) + " " + (count == 1 ? one : several);
}

/// Repairs a mesh step by step, and describes what was done.
class Repair {
 public:
  explicit Repair(OpenedMesh& opened) : opened_(opened), defects_(find_defects(*opened.mesh)) {}

  const Defects& defects() const { return defects_; }
  const std::vector<std::string>& done() const { return done_; }

  void weld(double tolerance, const Progress& progress) {
    const ElementId before = opened_.mesh->element_count();
    if (tolerance > 0 || !defects_.duplicates.empty()) {
      take(chainmail::weld(*opened_.mesh, tolerance, progress));
    }
    if (const ElementId count = before - opened_.mesh->element_count(); count > 0) {
      done_.push_back(number_of(count, "duplicate vertex welded", "duplicate vertices welded"));
    }
  }
  void remove_loose(const Progress& progress) {
    if (const auto count = defects_.loose.size(); count > 0) {
      take(chainmail::remove_loose(*opened_.mesh, progress));
      done_.push_back(number_of(count, "loose point removed", "loose points removed"));
    }
  }
  void close_holes(const Progress& progress) {
    if (!defects_.holes.empty()) {
      const std::size_t before = defects_.holes.size(), triangles = opened_.mesh->triangles.size();
      take(chainmail::close_holes(*opened_.mesh, defects_.holes, progress));
      done_.push_back(number_of(before - std::min(before, defects_.holes.size()), "hole", "holes") + " closed with " +
                      number_of(opened_.mesh->triangles.size() - triangles, "triangle", "triangles"));
    }
  }

 private:
  void take(const Repaired& repaired) {
    opened_.softness = softness_after(opened_.softness, *opened_.mesh, repaired);
    opened_.mesh = repaired.mesh;
    defects_ = find_defects(*opened_.mesh);
  }

  OpenedMesh& opened_;
  Defects defects_;
  std::vector<std::string> done_;
};

void carry_out(const RepairOptions& options, Repair& repair, const Progress& progress) {
  if (options.asks(options.weld)) {
    const auto tolerance = value_of(options.weld);
    repair.weld(tolerance && !tolerance->empty() ? tolerance_of(*tolerance) : 0, progress.part(0, 0.2));
  }
  if (options.asks(options.loose)) {
    repair.remove_loose(progress.part(0.2, 0.4));
  }
  if (options.asks(options.holes)) {
    repair.close_holes(progress.part(0.4, 1));
  }
}

/// Refuses to close the holes of an object with cells, if that was asked for.
void check_holes(const RepairOptions& options, const Mesh& mesh) {
  if (options.holes->count() > 0 && mesh.has_cells()) {
    throw Error("--holes", "the object has cells, and only surfaces have holes", "leave it out, or use a surface");
  }
}

void write_repairs(std::ostream& out, const Repair& repair) {
  const auto& done = repair.done();
  out << "repaired  " << (done.empty() ? "nothing" : joined_words(done, ", ")) << '\n';
  if (!repair.defects().empty()) {
    out << "left      " << joined_words(in_words(repair.defects()), ", ") << '\n';
  }
  if (const auto count = repair.defects().outlines; count > 0) {
    out << "open      " << number_of(count, "border: the outline", "borders: outlines") << " of an open surface\n";
  }
}

void repair_file(const RepairOptions& options, const std::string& target, const std::optional<std::string>& json) {
  mesh_format(target, FormatUse::write);
  OpenedMesh opened = open_mesh(options.mesh);
  say_flaws(opened);
  check_holes(options, *opened.mesh);
  RepairSummary summary{summarize(opened), {}};
  Repair repair(opened);
  {
    const std::string name = shown(*value_of(options.mesh.path));
    Watch watch("repairing " + name);
    in_options({{"surface", name}}, [&] { carry_out(options, repair, watch.progress()); });
  }
  summary.after = summarize(*opened.mesh);
  summary.after.defects = repair.defects();
  Outputs outputs;
  add_mesh_file(outputs, options.mesh, target, *opened.mesh, opened.softness);
  if (json) {
    outputs.add(*json, [&](std::ostream& out) { write_json(out, summary); });
  }
  if (json != "-") {
    outputs.add("-", [&](std::ostream& out) { write_repairs(out, repair); });
  }
  outputs.commit();
}

}  // namespace

Command add_repair(CLI::App& root) {
  CLI::App* app = root.add_subcommand("repair", "Repair a mesh: weld duplicates, remove loose points, close holes");
  RepairOptions options;
  options.mesh = add_mesh_options(*app, Welding::by_repair);
  options.weld =
      add_value(*app, "--weld", "TOLERANCE",
                "only weld duplicate vertices: elements at the same position, or as close as TOLERANCE, in mesh "
                "units [0]")
          ->expected(0, 1);
  options.loose = add_switch(*app, "--loose", "only remove loose points: elements without links");
  options.holes = add_switch(*app, "--holes", "only close holes of a surface; the outline of an open surface stays");
  CLI::Option* json = add_value(*app, "--json", "FILE", "write the counts before and after as JSON");
  const CLI::Option* target = add_mesh_target(*app);
  app->footer(
      "Without --weld, --loose and --holes, all three repairs are made. Several may be given.\n"
      "Non-manifold edges are reported but not changed.\n\nExample:\n  chainmail repair scan.ply -o whole.ply");
  return {app, [options, json, target] { repair_file(options, *value_of(target), value_of(json)); }};
}

}  // namespace chainmail::command_line
