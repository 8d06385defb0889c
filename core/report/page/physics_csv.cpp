#include "report/page/physics_csv.h"

#include "report/page/format.h"

namespace chainmail::report {
namespace {

constexpr int physics_figures = 29;  // number of columns of a measurement

/// Writes median, quartiles and repetitions; empty fields if nothing was timed.
void write_spread(std::ostream& out, const TimeSpread& ms) {
  if (ms.count == 0) {
    out << ",,,,";
    return;
  }
  out << ',' << all_digits(ms.median) << ',' << all_digits(ms.lower_quartile) << ',' << all_digits(ms.upper_quartile)
      << ',' << ms.count;
}

void write_measurement(std::ostream& out, const PhysicsMeasurement& measured) {
  const TimeSpread& ms = measured.ms_per_move;
  const PhysicalError& error = measured.error;
  out << ',' << ms.count;
  for (const double number : {ms.median, ms.lower_quartile, ms.upper_quartile, ms.min, ms.max, measured.prepare.ms(),
                              error.rms, error.max, error.moving_rms, error.moving_max}) {
    out << ',' << all_digits(number);
  }
  out << ',' << error.moving << ',' << all_digits(error.relative);
  write_spread(out, measured.first_move);
  write_spread(out, measured.move_after_cut);
  write_spread(out, measured.prepare.factorize);
  write_spread(out, measured.prepare.grab);
}

constexpr int physics_shape_figures = 5;  // number of columns

void write_physics_shape(std::ostream& out, const ShapeFigures& shape) {
  out << ',' << all_digits(shape.hausdorff) << ',' << all_digits(shape.volume_change) << ','
      << (shape.inverted_cells ? std::to_string(*shape.inverted_cells) : "") << ',' << all_digits(shape.stretch) << ','
      << all_digits(shape.violation);
}

/// Writes how close the contestant is to its equilibrium; empty fields if it has none.
void write_equilibrium(std::ostream& out, const std::optional<PhysicsMeasurement>& measured) {
  out << ',' << (measured ? all_digits(measured->residual) : "") << ','
      << (measured && measured->binds ? (*measured->binds ? "1" : "0") : "");
}

/// Writes by how much the contestant differs on the turned object; empty fields if that was not measured.
void write_symmetry(std::ostream& out, const PhysicsObject& object, const PhysicsContestant& contestant) {
  const Symmetry* symmetry = find_symmetry(object.symmetry, contestant);
  for (std::size_t i = 0; i < symmetry_angles.size(); ++i) {
    const bool known = symmetry != nullptr && i < symmetry->turns.size();
    out << ',' << (known ? all_digits(symmetry->turns[i].max) : "") << ','
        << (known ? all_digits(symmetry->turns[i].relative) : "");
  }
}

void write_growth(std::ostream& out, const PhysicsGrowth& growth) {
  for (const GrowthSeries& series : growth.series) {
    for (const GrowthPoint& point : series.points) {
      const PhysicalError error = point.error.value_or(PhysicalError{});
      const auto known = [&](double number) { return point.error ? all_digits(number) : ""; };
      out << csv_field("growing " + growth.name) << ',' << point.elements << ",,,," << name(series.contestant) << ','
          << series.contestant.sweeps << ",,1," << all_digits(point.ms_per_move) << ",,,,,"
          << all_digits(point.prepare_ms) << ',' << known(error.rms) << ',' << known(error.max) << ','
          << known(error.moving_rms) << ',' << known(error.moving_max) << ",," << known(error.relative)
          << std::string(16, ',') << ",,," << (series.contestant.equilibrium ? 1 : 0) << ','
          << (series.contestant.open_regions ? 1 : 0)
          << std::string(physics_shape_figures + 2 * symmetry_angles.size() + 2, ',') << '\n';
    }
  }
}

}  // namespace

void write_csv(std::ostream& out, const PhysicsReport& report) {
  out << "object,elements,pins,drag,hand,algorithm,sweeps,refusal,repetitions,ms,ms_lower_quartile,ms_upper_quartile,"
         "ms_min,ms_max,prepare_ms,error_rms,error_max,moving_rms,moving_max,moving_elements,relative,"
         "first_ms,first_lower_quartile,first_upper_quartile,first_repetitions,"
         "after_cut_ms,after_cut_lower_quartile,after_cut_upper_quartile,after_cut_repetitions,"
         "factorize_ms,factorize_lower_quartile,factorize_upper_quartile,factorize_repetitions,"
         "grab_ms,grab_lower_quartile,grab_upper_quartile,grab_repetitions,handle,calibrated,equilibrium,open_regions,"
         "hausdorff,volume_change,inverted_cells,largest_stretch,violation_max,"
         "turned_45_max,turned_45_relative,turned_90_max,turned_90_relative,residual,regions_bind\n";
  for (const PhysicsObject& object : report.objects) {
    for (const PhysicsDrag& drag : object.drags) {
      for (const PhysicsEntry& entry : drag.entries) {
        out << csv_field(object.name) << ',' << object.elements << ',' << object.pins << ',' << csv_field(drag.name)
            << ',' << all_digits(drag.handle_displacement) << ',' << name(entry.contestant) << ','
            << entry.contestant.sweeps << ',' << csv_field(entry.refusal);
        if (entry.measurement) {
          write_measurement(out, *entry.measurement);
        } else {
          out << std::string(physics_figures, ',');
        }
        out << ',' << drag.handle << ',' << (entry.contestant.calibrated ? 1 : 0) << ','
            << (entry.contestant.equilibrium ? 1 : 0) << ',' << (entry.contestant.open_regions ? 1 : 0);
        if (entry.measurement) {
          write_physics_shape(out, entry.measurement->shape);
        } else {
          out << std::string(physics_shape_figures, ',');
        }
        write_symmetry(out, object, entry.contestant);
        write_equilibrium(out, entry.measurement);
        out << '\n';
      }
    }
  }
  for (const PhysicsGrowth& growth : report.growths) {
    write_growth(out, growth);
  }
}

}  // namespace chainmail::report
