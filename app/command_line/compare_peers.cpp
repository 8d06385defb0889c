#include "command_line/compare_options.h"
#include "command_line/folder.h"
#include "files/results/peer_json.h"
#include "files/text/outputs.h"
#include "files/text/text.h"
#include "mesh/error.h"
#include "report/page/figure_table.h"
#include "report/page/format.h"

namespace chainmail::command_line {
namespace {

std::string cell_of(const std::optional<double>& number) { return number ? report::figure(*number) : "-"; }

report::FigureTable table_of(const report::PeerCase& object) {
  report::FigureTable table;
  table.caption = printable(object.name);
  table.about = printable(object.description);
  if (object.reference_change) {
    table.about += "; the last refinement of the reference changed it by " + report::figure(*object.reference_change);
  }
  table.corner = "solver";
  table.columns = {{"", "relative error"},        {"move (ms)", "first"},     {"move (ms)", "later"},
                   {"prepare (ms)", "factorize"}, {"prepare (ms)", "grab"},   {"shape", "Hausdorff"},
                   {"shape", "volume change"},    {"shape", "inverted cells"}};
  return table;
}

report::FigureTable::Row row_of(const report::PeerCase& object, const report::PeerAnswer& answer) {
  const report::PeerVerdict verdict = report::judge(object, answer);
  const auto& inverted = verdict.shape.inverted_cells;
  return {printable(answer.solver),
          {report::error_figure(verdict.error.relative, object.reference_change), cell_of(verdict.first_ms),
           cell_of(verdict.later_ms), cell_of(answer.factorize_ms), cell_of(answer.grab_ms),
           cell_of(verdict.shape.hausdorff), cell_of(verdict.shape.volume_change),
           inverted ? std::to_string(*inverted) : "-"},
          {}};
}

}  // namespace

void write_cases(const CLI::App& app, const CompareArguments& arguments) {
  refuse_others(app, "--cases", {arguments.cases, arguments.output});
  OutputFolder folder(*value_of(arguments.output));
  const auto cases = report::peer_cases_of_suite(sample_organs());
  folder.make();
  Outputs outputs;
  for (const report::PeerCase& one : cases) {
    outputs.add(folder.path() / (one.name + ".json"), [&one](std::ostream& out) { write_json(out, one); });
  }
  outputs.commit();
  folder.keep();
}

void judge_answers(const CLI::App& app, const CompareArguments& arguments) {
  refuse_others(app, "--judge", {arguments.judge, arguments.meshes});
  const std::vector<std::string> files = arguments.meshes->results();
  if (files.size() < 2) {
    throw Error("--judge", "the files are missing", "name a case, then one or more answers to it");
  }
  const report::PeerCase object = read_peer_case(files.front());
  report::FigureTable table = table_of(object);
  for (auto file = files.begin() + 1; file != files.end(); ++file) {
    table.rows.push_back(row_of(object, read_peer_answer(*file)));
  }
  Outputs outputs;
  outputs.add("-", [&](std::ostream& out) { write_text(out, table); });
  outputs.commit();
}

}  // namespace chainmail::command_line
