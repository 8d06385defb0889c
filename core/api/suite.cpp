#include "chainmail/suite.h"

#include <algorithm>
#include <optional>
#include <utility>

#include "api/access.h"
#include "api/report_files.h"
#include "chainmail/text.h"
#include "report/page/figure_table.h"
#include "report/page/format.h"
#include "report/page/suite_csv.h"
#include "report/page/suite_html.h"
#include "report/page/suite_plot.h"
#include "report/page/suite_table.h"
#include "report/run/peer.h"
#include "report/run/suite.h"
#include "report/run/suite_experiments.h"
#ifdef CHAINMAIL_HAS_JSON
#include "files/results/peer_json.h"
#include "files/results/suite_json.h"
#endif

namespace chainmail::api {

struct Suite::Impl {
  report::Suite suite;
};

std::vector<SuiteExperiment> suite_experiments() {
  std::vector<SuiteExperiment> all;
  for (const report::SuiteExperiment& one : report::suite_experiments()) {
    all.push_back({std::string(one.name), std::string(one.description), one.needs_organ(), one.only_named});
  }
  return all;
}

std::vector<std::string> part_of_suite(const std::vector<std::string>& experiments, int index, int count) {
  if (index < 1 || index > count) {
    throw Error("part", "number " + std::to_string(index) + " of " + std::to_string(count) + " does not exist",
                "use a number from 1 to the number of parts");
  }
  return report::part_of(experiments, {index, count});
}

namespace {

report::SampleOrgans organs_of(const SampleOrgans& organs) {
  const auto pointer = [](const std::optional<Mesh>& mesh) { return mesh ? Access::pointer(*mesh) : nullptr; };
  return {pointer(organs.fine), pointer(organs.coarse)};
}

}  // namespace

std::string Suite::text() const {
  return written([&](std::ostream& out) { write_text(out, impl_->suite); });
}
std::string Suite::html() const {
  return written([&](std::ostream& out) { write_html(out, impl_->suite); });
}
std::string Suite::csv() const {
  return written([&](std::ostream& out) { write_csv(out, impl_->suite); });
}

std::vector<ReportFile> Suite::files() const {
  std::vector<ReportFile> files = report_files(*this);
  for (const report::SpeedAgainstError& measure : report::speeds_against_error) {
    if (const report::Plot plot = suite_plot(impl_->suite, measure); !plot.panels.empty()) {
      files.push_back(plot_file(std::string(measure.file) + ".svg", plot));
    }
  }
  return files;
}

void Suite::write(const std::filesystem::path& folder) const { write_report(folder, files()); }

Suite run_suite(const SuiteOptions& options, const Job& job) {
  return guarded([&] {
    report::SuiteOptions how;
    std::ranges::transform(options.methods, std::back_inserter(how.algorithms), algorithm_of);
    how.repetitions = options.repetitions;
    if (options.calibrated) {
      how.calibrate = calibrator_of(inner::RelaxationScheme::mean);
    }
    how.organs = organs_of(options.organs);
    const auto names = options.experiments.empty() ? report::suite_names() : options.experiments;
    report::Suite suite = report::run_suite(names, how, teller_of(job), Access::stop(job));
    if (suite.stopped) {
      throw Cancelled();
    }
    suite.runs = {{origin_of(options.command, options.program), options.part, names}};
    return Access::make<Suite>(std::move(suite));
  });
}

#ifdef CHAINMAIL_HAS_JSON

std::string Suite::json() const {
  return written([&](std::ostream& out) { write_json(out, impl_->suite); });
}

Suite merge_suites(const std::vector<std::filesystem::path>& reports) {
  return guarded([&] {
    std::vector<report::Suite> parts;
    std::ranges::transform(reports, std::back_inserter(parts), read_suite);
    return Access::make<Suite>(report::merged(parts));
  });
}

namespace {

std::string cell_of(const std::optional<double>& number) { return number ? report::figure(*number) : "-"; }

report::FigureTable peer_table_of(const report::PeerCase& object) {
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

report::FigureTable::Row peer_row_of(const report::PeerCase& object, const report::PeerAnswer& answer) {
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

std::vector<ReportFile> suite_cases(const SampleOrgans& organs) {
  return guarded([&] {
    std::vector<ReportFile> files;
    for (const report::PeerCase& one : report::peer_cases_of_suite(organs_of(organs))) {
      files.push_back({one.name + ".json", written([&](std::ostream& out) { write_json(out, one); })});
    }
    return files;
  });
}

std::string judge_answers(const std::filesystem::path& suite_case, const std::vector<std::filesystem::path>& answers) {
  return guarded([&] {
    const report::PeerCase object = read_peer_case(suite_case);
    report::FigureTable table = peer_table_of(object);
    for (const auto& answer : answers) {
      table.rows.push_back(peer_row_of(object, read_peer_answer(answer)));
    }
    return written([&](std::ostream& out) { write_text(out, table); });
  });
}

#else

std::string Suite::json() const { refuse_without("nlohmann/json", "suite"); }
Suite merge_suites(const std::vector<std::filesystem::path>& /*reports*/) { refuse_without("nlohmann/json", "suite"); }
std::vector<ReportFile> suite_cases(const SampleOrgans& /*organs*/) { refuse_without("nlohmann/json", "suite"); }
std::string judge_answers(const std::filesystem::path& suite_case,
                          const std::vector<std::filesystem::path>& /*answers*/) {
  refuse_without("nlohmann/json", suite_case.string());
}

#endif

}  // namespace chainmail::api
