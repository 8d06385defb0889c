#include "report/format.h"
#include "report/physics_report.h"

namespace chainmail::report {
namespace {

constexpr int figures = 12;  // columns of a measurement

void write_measurement(std::ostream& out, const PhysicsMeasurement& measured) {
  const TimeSpread& ms = measured.ms_per_move;
  const PhysicalError& error = measured.error;
  out << ',' << ms.count;
  for (const double number : {ms.median, ms.lower_quartile, ms.upper_quartile, ms.min, ms.max, measured.prepare_ms,
                              error.rms, error.max, error.moving_rms, error.moving_max}) {
    out << ',' << all_digits(number);
  }
  out << ',' << error.moving;
}

void write_growth(std::ostream& out, const PhysicsGrowth& growth) {
  for (const GrowthSeries& series : growth.series) {
    for (const GrowthPoint& point : series.points) {
      const PhysicalError error = point.error.value_or(PhysicalError{});
      const auto known = [&](double number) { return point.error ? all_digits(number) : ""; };
      out << csv_field("growing " + growth.name) << ',' << point.elements << ",,,,"
          << info(series.contestant.algorithm).name << ',' << series.contestant.sweeps << ",,1,"
          << all_digits(point.ms_per_move) << ",,,,," << all_digits(point.prepare_ms) << ',' << known(error.rms) << ','
          << known(error.max) << ',' << known(error.moving_rms) << ',' << known(error.moving_max) << ",\n";
    }
  }
}

}  // namespace

void write_csv(std::ostream& out, const PhysicsReport& report) {
  out << "object,elements,pins,drag,hand,algorithm,sweeps,refusal,repetitions,ms,ms_lower_quartile,ms_upper_quartile,"
         "ms_min,ms_max,prepare_ms,error_rms,error_max,moving_rms,moving_max,moving_elements\n";
  for (const PhysicsObject& object : report.objects) {
    for (const PhysicsDrag& drag : object.drags) {
      for (const PhysicsEntry& entry : drag.entries) {
        out << csv_field(object.name) << ',' << object.elements << ',' << object.pins << ',' << csv_field(drag.name)
            << ',' << all_digits(drag.hand) << ',' << info(entry.contestant.algorithm).name << ','
            << entry.contestant.sweeps << ',' << csv_field(entry.refusal);
        if (entry.measurement) {
          write_measurement(out, *entry.measurement);
        } else {
          out << std::string(figures, ',');
        }
        out << '\n';
      }
    }
  }
  for (const PhysicsGrowth& growth : report.growths) {
    write_growth(out, growth);
  }
}

}  // namespace chainmail::report
