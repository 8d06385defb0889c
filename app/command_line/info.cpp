#include <ostream>

#include "command_line/common.h"
#include "files/results/summary.h"
#include "files/text/outputs.h"
#include "files/text/text.h"

namespace chainmail::command_line {
namespace {

std::string short_digits(double number) {
  std::string text;
  append_number(text, number);
  return text;
}

std::string short_digits(const Point& point) {
  return "(" + short_digits(point.x()) + ", " + short_digits(point.y()) + ", " + short_digits(point.z()) + ")";
}

void write_summary(std::ostream& out, const MeshSummary& summary) {
  out << "elements          " << summary.elements << '\n'
      << "links             " << summary.links << '\n'
      << "triangles         " << summary.triangles << '\n'
      << "tetrahedra        " << summary.tetrahedra << '\n'
      << "hexahedra         " << summary.hexahedra << '\n'
      << "object dimension  " << summary.object_dimension << '\n'
      << "space dimension   " << summary.space_dimension << '\n'
      << "parts             " << summary.components << '\n'
      << "bounds            " << short_digits(summary.bounds[0]) << " to " << short_digits(summary.bounds[1]) << '\n'
      << "mean link length  " << short_digits(summary.mean_link_length) << '\n';
  for (const auto& [title, words] :
       {std::pair("read as           ", summary.remark), std::pair("note              ", in_words(summary.flaws)),
        std::pair("defects           ", joined_words(in_words(summary.defects), ", "))}) {
    if (!words.empty()) {
      out << title << words << '\n';
    }
  }
}

}  // namespace

Command add_info(CLI::App& root) {
  CLI::App* app = root.add_subcommand("info", "Show the contents of a mesh");
  const MeshOptions mesh = add_mesh_options(*app);
  CLI::Option* json = add_value(*app, "--json", "FILE", "write JSON to this file instead");
  app->footer("Formats:\n" + mesh_formats_help(FormatUse::read) + "\nExample:\n  chainmail info 3x3.dat --json -");
  return {app, [mesh, json] {
            const MeshSummary summary = summarize(open_mesh(mesh));
            if (const auto path = value_of(json)) {
              Outputs outputs;
              outputs.keep(*value_of(mesh.path));
              outputs.add(*path, [&](std::ostream& out) { write_json(out, summary); });
              outputs.commit();
            } else {
              write_file("-", [&](std::ostream& out) { write_summary(out, summary); });
            }
          }};
}

}  // namespace chainmail::command_line
