#include "report/page/csv.h"

#include "report/page/format.h"

namespace chainmail::report {
namespace {

void write_distance(std::ostream& out, const std::optional<Distance>& distance) {
  out << ',' << (distance ? all_digits(distance->max) : "") << ',' << (distance ? all_digits(distance->rms) : "");
}

void write_errors(std::ostream& out, const Errors& errors) {
  out << ',' << all_digits(errors.violation.max) << ',' << all_digits(errors.violation.rms) << ','
      << all_digits(errors.violation.fraction);
  write_distance(out, errors.to_exact);
  out << ',' << all_digits(errors.energy_over_exact);
  write_distance(out, errors.float_to_double);
  out << ',' << all_digits(errors.largest_over_handle);
  write_distance(out, errors.to_equilibrium);
}

constexpr int shape_figures_written = 4;  // number of columns

void write_shape(std::ostream& out, const ShapeFigures& shape) {
  out << ',' << all_digits(shape.hausdorff) << ',' << all_digits(shape.volume_change) << ','
      << (shape.inverted_cells ? std::to_string(*shape.inverted_cells) : "") << ',' << all_digits(shape.stretch);
}

void write_measurement(std::ostream& out, const Measurement& measurement) {
  const TimeSpread& ms = measurement.ms_per_move;
  out << ',' << ms.count;
  for (const double time : {ms.median, ms.lower_quartile, ms.upper_quartile, ms.min, ms.max}) {
    out << ',' << all_digits(time);
  }
  out << ',' << all_digits(measurement.worst_move_ms) << ',' << measurement.checked << ',' << measurement.moved;
  write_errors(out, measurement.errors);
}

constexpr int comparison_figures = 20;  // number of columns of a measurement

}  // namespace

void write_csv(std::ostream& out, const Comparison& comparison) {
  out << "object,elements,links,drag,moves,algorithm,sweeps,refusal,repetitions,ms,ms_lower_quartile,"
         "ms_upper_quartile,ms_min,ms_max,worst_move_ms,checked,moved,violation_max,violation_rms,violation_fraction,"
         "exact_distance_max,exact_distance_rms,energy_over_exact,float_double_max,float_double_rms,largest_over_hand,"
         "equilibrium_distance_max,equilibrium_distance_rms,equilibrium,hausdorff,volume_change,inverted_cells,"
         "largest_stretch\n";
  for (const CaseResult& object : comparison.cases) {
    for (const DragResult& drag : object.drags) {
      for (const Entry& entry : drag.entries) {
        out << csv_field(object.name) << ',' << object.elements << ',' << object.links << ',' << csv_field(drag.name)
            << ',' << drag.moves << ',' << info(entry.contestant.algorithm).name << ',' << entry.contestant.sweeps
            << ',' << csv_field(entry.refusal);
        if (entry.measurement) {
          write_measurement(out, *entry.measurement);
        } else {
          out << std::string(comparison_figures, ',');
        }
        out << ',' << (entry.contestant.equilibrium ? 1 : 0);
        if (entry.measurement) {
          write_shape(out, entry.measurement->errors.shape);
        } else {
          out << std::string(shape_figures_written, ',');
        }
        out << '\n';
      }
    }
  }
}

}  // namespace chainmail::report
