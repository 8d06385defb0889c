#include "chainmail/compare.h"

#include <algorithm>
#include <cmath>
#include <variant>

#include "api/access.h"
#include "api/recorded_moves.h"
#include "api/report_files.h"
#include "chainmail/text.h"
#include "report/page/compared_figures.h"
#include "report/page/html.h"
#include "report/page/physics_figures.h"
#include "report/page/physics_html.h"
#include "report/page/physics_plot.h"
#include "report/page/physics_table.h"
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

report::Case case_of(const ComparedObject& one, Reference against) {
  const inner::Body& impl = Access::body(one.body);
  report::Case object{printable(one.name),
                      printable(one.description),
                      impl.mesh_pointer(),
                      impl.cuts().links(),
                      {impl.pins().begin(), impl.pins().end()},
                      impl.softness(),
                      {},
                      impl.elastic()};
  if (against == Reference::physics && !object.cuts.empty()) {
    throw Error("cuts", "the comparison with physics needs an object without cuts", "uncut its links");
  }
  for (const Drag& drag : one.drags) {
    check_drag(drag, impl, against);
    object.drags.push_back(moves_of(drag, impl.mesh()));
  }
  for (const RecordedMoves& moves : one.recorded) {
    object.drags.push_back(Access::impl(moves).moves);
  }
  return object;
}

std::vector<report::Case> cases_of(const std::vector<ComparedObject>& objects, const CompareOptions& options,
                                   const Job& job) {
  std::vector<report::Case> cases;
  for (const ComparedObject& one : objects) {
    report::Case& object = cases.emplace_back(case_of(one, options.against));
    if (object.drags.empty()) {
      object.drags = options.against == Reference::exact
                         ? report::three_drags(object, Access::stop(job))
                         : report::physics_drags(object, true, options.refined ? report::patch_share : 0);
    }
  }
  return cases;
}

/// Returns each case with each material of the reference solution. Names say the material, except neo-Hookean alone.
std::vector<report::Case> with_materials(std::vector<report::Case> cases, const std::vector<Elasticity>& materials) {
  if (materials.empty()) {
    return cases;
  }
  std::vector<report::Case> all;
  for (const report::Case& object : cases) {
    for (const Elasticity& material : materials) {
      all.push_back(object);
      all.back().law = elastic_options_of(material).law;
      if (materials.size() > 1 || material.law != StrainLaw::neo_hookean) {
        all.back().name += ", " + label(all.back().law);
      }
    }
  }
  return all;
}

ComparedObject object_of(report::Case&& from) {
  const Mesh mesh = Access::mesh(std::move(from.mesh));
  ComparedObject object{from.name, Body(mesh), from.description};
  auto& impl = Access::impl(object.body);
  impl.body().cut(from.cuts);
  impl.body().pin(from.pins);
  impl.set_softness(from.softness);
  impl.body().set_elastic(from.elastic);
  for (report::RecordedMoves& drag : from.drags) {
    object.recorded.push_back(Access::make<RecordedMoves>(std::move(drag), mesh));
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
        rows.back().object = object.name;
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
        rows.back().object = object.name;
      }
      if (!drag.no_reference.empty()) {
        ComparisonRow& row = rows.emplace_back();
        row.object = object.name;
        row.drag = drag.name;
        row.refusal = drag.no_reference;
      }
    }
  }
  return rows;
}

template <class Report>
Comparison finished(Report report, const CompareOptions& options) {
  if (report.stopped) {
    throw Cancelled();
  }
  auto rows = rows_of(report);
  return Access::make<Comparison>(std::move(report), origin_of(options.command, options.program), std::move(rows));
}

void add_plots(std::vector<ReportFile>& /*files*/, const report::Comparison& /*report*/) {}

void add_plots(std::vector<ReportFile>& files, const report::PhysicsReport& report) {
  const auto add = [&](const std::string& name, const report::Plot& plot) { files.push_back(plot_file(name, plot)); };
  if (report.objects.size() > 1) {
    add("overview.svg", physics_overview(report));
  }
  for (std::size_t i = 0; i < report.objects.size(); ++i) {
    add("object-" + std::to_string(i + 1) + ".svg", physics_plot(report.objects[i]));
  }
  if (!report.growths.empty()) {
    add("growth-time.svg", growth_time_plot(report.growths));
    add("growth-prepare.svg", growth_prepare_plot(report.growths));
    add("growth-error.svg", growth_error_plot(report.growths));
  }
}

report::PhysicsOptions physics_of(const CompareOptions& options, const report::CompareOptions& contest) {
  report::PhysicsOptions physics;
  physics.contest = contest;
  physics.growth_seconds = options.growth_seconds;
  if (options.refined) {
    physics.refine = ConvergingOptions();
  }
  if (options.calibrated) {
    physics.calibrate = calibrator_of(contest.scheme);
  }
  return physics;
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

std::vector<ReportFile> Comparison::files() const {
  std::vector<ReportFile> files = report_files(*this);
  std::visit([&](const auto& one) { add_plots(files, one); }, impl_->report);
  return files;
}

void Comparison::write(const std::filesystem::path& folder) const { write_report(folder, files()); }

std::vector<ComparedObject> built_in_objects(Reference against, const LinkSoftness& softness, EnergyKind energy,
                                             const Elasticity& elasticity) {
  check(elasticity);
  return guarded([&] {
    const Softness all{softness_of(softness), {}, energy_of(energy)};
    inner::check(all.global);
    std::vector<ComparedObject> objects;
    for (report::Case& one : against == Reference::exact ? report::default_cases(all)
                                                         : report::physics_cases(all, elastic_options_of(elasticity))) {
      if (against == Reference::physics) {
        one.drags.clear();  // they depend on the options of the comparison
      }
      objects.push_back(object_of(std::move(one)));
    }
    return objects;
  });
}

Comparison compare(const Body& body, const std::vector<Drag>& drags, const CompareOptions& options, const Job& job) {
  return compare({ComparedObject{options.title, body, "object of a program", drags}}, options, job);
}

Comparison compare(const std::vector<ComparedObject>& objects, const CompareOptions& options, const Job& job) {
  return guarded([&] {
    const report::CompareOptions contest = contest_of(options);
    const std::vector<report::Case> cases = cases_of(objects, options, job);
    const auto tell = teller_of(job);
    if (options.against == Reference::exact) {
      return finished(report::compare(cases, contest, tell, Access::stop(job)), options);
    }
    const report::PhysicsOptions physics = physics_of(options, contest);
    return finished(
        report::compare_with_physics(with_materials(cases, options.materials), physics, tell, Access::stop(job)),
        options);
  });
}

}  // namespace chainmail::api
