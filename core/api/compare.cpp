#include "chainmail/compare.h"

#include <algorithm>
#include <cmath>
#include <system_error>
#include <variant>

#include "api/access.h"
#include "files/text/outputs.h"
#include "files/text/text.h"
#include "report/page/compared_figures.h"
#include "report/page/html.h"
#include "report/page/physics_figures.h"
#include "report/page/physics_html.h"
#include "report/page/physics_plot.h"
#include "report/page/physics_table.h"
#include "report/page/svg.h"
#include "report/page/table.h"
#include "report/run/compare.h"
#include "report/run/drags.h"
#include "report/run/machine.h"
#include "report/run/physics.h"
#include "report/run/physics_cases.h"
#ifdef CHAINMAIL_HAS_JSON
#include "files/results/report_json.h"
#endif

namespace chainmail::api {

struct Comparison::Impl {
  std::variant<report::Comparison, report::PhysicsReport> report;
  report::Origin origin;
  std::vector<ComparisonRow> rows;
};

namespace {

report::CompareOptions contest_of(const CompareOptions& options) {
  report::CompareOptions how;
  for (const std::string& name : options.methods) {
    const Algorithm algorithm = algorithm_of(name);
    if (std::ranges::find(how.algorithms, algorithm) != how.algorithms.end()) {
      throw Error("method " + in_quotes(name), "it is given twice", "name each method once");
    }
    how.algorithms.push_back(algorithm);
  }
  if (!(options.seconds >= 0) || !std::isfinite(options.seconds)) {
    throw Error("seconds", "the time is not a number from 0", "use a number of seconds");
  }
  how.sweeps = options.sweeps;
  how.equilibrium = options.equilibrium;
  how.scheme = scheme_of(options.scheme);
  how.relax_step = options.relax_step;
  how.precision = precision_of(options.precision);
  how.repetitions = options.repetitions;
  how.seconds = options.seconds;
  check(how);
  return how;
}

void check_drag(const Drag& drag, const inner::Body& body, Reference against) {
  const std::string where = "drag " + in_quotes(drag.name);
  const inner::Handle handle(body, drag.elements);
  if (drag.path.empty()) {
    throw Error(where, "its path is empty", "give at least one motion");
  }
  if (against == Reference::physics && !handle.has_one()) {
    throw Error(where, "it grabs many elements", "compare with physics on drags of one element");
  }
  for (const Motion& motion : drag.path) {
    check_coordinates(body.mesh(), where, motion.by, true);
    check(rotation_of(motion.rotation), body.mesh());
  }
}

/// Targets are absolute for a handle of one element, as the comparison with physics reads them.
report::RecordedMoves moves_of(const Drag& drag, const inner::Mesh& mesh) {
  report::RecordedMoves moves{printable(drag.name), "", {commands::Grab(drag.elements)}};
  for (const Motion& motion : drag.path) {
    const bool has_one = drag.elements.size() == 1;
    const Point from = has_one ? mesh.rest_position(drag.elements[0]) : Point(Point::Zero());
    moves.commands.emplace_back(commands::Drag{from + point_of(motion.by), rotation_of(motion.rotation), !has_one});
  }
  return moves;
}

report::Case case_of(const inner::Body& body, const std::vector<Drag>& drags, const CompareOptions& options,
                     const std::stop_token& stop) {
  report::Case object{printable(options.title),
                      "object of a program",
                      body.mesh_pointer(),
                      body.cuts().links(),
                      {body.pins().begin(), body.pins().end()},
                      body.softness(),
                      {},
                      body.elastic()};
  if (options.against == Reference::physics && !object.cuts.empty()) {
    throw Error("cuts", "the comparison with physics needs an object without cuts", "uncut its links");
  }
  for (const Drag& drag : drags) {
    check_drag(drag, body, options.against);
    object.drags.push_back(moves_of(drag, body.mesh()));
  }
  if (drags.empty()) {
    object.drags =
        options.against == Reference::exact ? report::three_drags(object, stop) : report::physics_drags(object);
  }
  return object;
}

Spread spread_of_distance(const Distance& distance) { return {distance.max, distance.rms}; }

ComparisonRow row_of(const report::DragResult& drag, const report::Entry& entry) {
  ComparisonRow row;
  row.drag = drag.name;
  row.method = info(entry.contestant.algorithm).offered_name();
  row.label = label(entry.contestant);
  row.sweeps = entry.contestant.sweeps;
  row.equilibrium = entry.contestant.equilibrium;
  row.refusal = entry.refusal;
  if (const auto& measured = entry.measurement) {
    const report::Errors& errors = measured->errors;
    row.ms_per_move = measured->ms_per_move.median;
    row.lower_quartile = measured->ms_per_move.lower_quartile;
    row.upper_quartile = measured->ms_per_move.upper_quartile;
    row.violation = {errors.violation.max, errors.violation.rms, errors.violation.fraction, errors.violation.links};
    row.to_exact = errors.to_exact ? std::optional(spread_of_distance(*errors.to_exact)) : std::nullopt;
    row.energy_over_exact = errors.energy_over_exact;
    row.float_to_double = spread_of_distance(errors.float_to_double);
  }
  return row;
}

ComparisonRow row_of(const report::PhysicsDrag& drag, const report::PhysicsEntry& entry) {
  ComparisonRow row;
  row.drag = drag.name;
  row.method = entry.contestant.algorithm ? info(*entry.contestant.algorithm).offered_name() : "nothing";
  row.label = label(entry.contestant);
  row.sweeps = entry.contestant.sweeps;
  row.equilibrium = entry.contestant.equilibrium;
  row.refusal = entry.refusal;
  if (const auto& measured = entry.measurement) {
    if (entry.contestant.algorithm) {
      // A drag of one move has no later ones.
      const TimeSpread& ms = drag.moves > 1 ? measured->ms_per_move : measured->first_move;
      row.ms_per_move = ms.median;
      row.lower_quartile = ms.lower_quartile;
      row.upper_quartile = ms.upper_quartile;
      row.prepare_ms = measured->prepare.ms();
    }
    row.to_physics = {measured->error.relative, measured->error.rms, measured->error.max};
  }
  return row;
}

std::vector<ComparisonRow> rows_of(const report::Comparison& comparison) {
  std::vector<ComparisonRow> rows;
  for (const report::CaseResult& object : comparison.cases) {
    for (const report::DragResult& drag : object.drags) {
      for (const report::Entry& entry : drag.entries) {
        rows.push_back(row_of(drag, entry));
      }
    }
  }
  return rows;
}

std::vector<ComparisonRow> rows_of(const report::PhysicsReport& comparison) {
  std::vector<ComparisonRow> rows;
  for (const report::PhysicsObject& object : comparison.objects) {
    for (const report::PhysicsDrag& drag : object.drags) {
      for (const report::PhysicsEntry& entry : drag.entries) {
        rows.push_back(row_of(drag, entry));
      }
      if (!drag.no_reference.empty()) {
        ComparisonRow& row = rows.emplace_back();
        row.drag = drag.name;
        row.refusal = drag.no_reference;
      }
    }
  }
  return rows;
}

/// Returns what passes the share of a report that is done on to a job.
report::Progress teller_of(const Job& job) {
  return [progress = Access::progress(job)](double share, const std::string& /*text*/) { progress.report(share); };
}

template <class Report>
Comparison finished(Report report) {
  if (report.stopped) {
    throw Cancelled();
  }
  auto rows = rows_of(report);
  return Access::make<Comparison>(std::move(report),
                                  report::Origin{report::this_machine(), "chainmail::api::compare",
                                                 report::now_in_words(), "chainmail " + std::string(version())},
                                  std::move(rows));
}

std::vector<report::PlotFile> plots_of(const report::Comparison& /*comparison*/) { return {}; }

/// Makes a folder, if it is missing.
void make_folder(const std::filesystem::path& folder) {
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (error) {
    throw Error(shown(folder), "the folder cannot be created (" + error.message() + ")", "use another folder");
  }
}

}  // namespace

const std::vector<ComparisonRow>& Comparison::rows() const& { return impl_->rows; }
std::vector<ComparisonRow> Comparison::rows() && { return impl_->rows; }

std::string Comparison::text() const {
  return written([&](std::ostream& out) { std::visit([&](const auto& one) { write_text(out, one); }, impl_->report); });
}

std::string Comparison::html() const {
  return written([&](std::ostream& out) {
    std::visit([&](const auto& one) { write_html(out, one, impl_->origin); }, impl_->report);
  });
}

#ifdef CHAINMAIL_HAS_JSON
std::string Comparison::json() const {
  return written([&](std::ostream& out) {
    std::visit([&](const auto& one) { write_json(out, one, impl_->origin); }, impl_->report);
  });
}
#else
std::string Comparison::json() const { refuse_without("nlohmann/json", "comparison"); }
#endif

std::string Comparison::csv() const {
  return written([&](std::ostream& out) { std::visit([&](const auto& one) { write_csv(out, one); }, impl_->report); });
}

void Comparison::write(const std::filesystem::path& folder) const {
  make_folder(folder);
  const auto plots = std::visit([](const auto& one) { return plots_of(one); }, impl_->report);
  guarded([&] {
    Outputs outputs;
    outputs.add(folder / "report.html", [&](std::ostream& out) { out << html(); });
#ifdef CHAINMAIL_HAS_JSON
    outputs.add(folder / "report.json", [&](std::ostream& out) { out << json(); });
#endif
    outputs.add(folder / "report.csv", [&](std::ostream& out) { out << csv(); });
    for (const report::PlotFile& one : plots) {
      outputs.add(folder / one.name, [&](std::ostream& out) { write_svg(out, one.plot, report::file_ink); });
    }
    outputs.commit();
  });
}

Comparison compare(const Body& body, const std::vector<Drag>& drags, const CompareOptions& options, const Job& job) {
  return guarded([&] {
    report::PhysicsOptions physics;
    physics.contest = contest_of(options);
    physics.growth_seconds = 0;
    const std::stop_token stop = Access::stop(job);
    const std::vector<report::Case> cases{case_of(Access::body(body), drags, options, stop)};
    return options.against == Reference::exact
               ? finished(report::compare(cases, physics.contest, teller_of(job), stop))
               : finished(report::compare_with_physics(cases, physics, teller_of(job), stop));
  });
}

}  // namespace chainmail::api
