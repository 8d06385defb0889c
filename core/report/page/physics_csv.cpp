#include "report/page/physics_csv.h"

#include <vector>

#include "report/page/csv_table.h"

namespace chainmail::report {
namespace physics_csv {

/// One contestant in one drag of one object, or at one size of a growing object. What was not measured is none.
struct Row {
  std::string object;
  std::uint64_t elements = 0;
  std::optional<std::uint64_t> pins = {};
  std::string drag = {};
  std::optional<double> displacement = {};
  const PhysicsContestant* contestant = nullptr;
  std::string refusal = {};
  std::optional<int> repetitions = {};
  std::optional<double> ms = {}, prepare_ms = {};
  const PhysicalError* error = nullptr;
  std::optional<std::uint64_t> moving = {};
  const PhysicsMeasurement* measured = nullptr;
  std::optional<std::uint64_t> handle = {};
  const Symmetry* symmetry = nullptr;
};

Row row_of(const PhysicsObject& object, const PhysicsDrag& drag, const PhysicsEntry& entry) {
  Row row{.object = object.name,
          .elements = object.elements,
          .pins = object.pins,
          .drag = drag.name,
          .displacement = drag.handle_displacement,
          .contestant = &entry.contestant,
          .refusal = entry.refusal,
          .handle = drag.handle,
          .symmetry = find_symmetry(object.symmetry, entry.contestant)};
  if (entry.measurement) {
    row.measured = &*entry.measurement;
    row.repetitions = row.measured->ms_per_move.count;
    row.ms = row.measured->ms_per_move.median;
    row.prepare_ms = row.measured->prepare.ms();
    row.error = &row.measured->error;
    row.moving = row.error->moving;
  }
  return row;
}

Row row_of(const PhysicsGrowth& growth, const GrowthSeries& series, const GrowthPoint& point) {
  return {.object = "growing " + growth.name,
          .elements = point.elements,
          .contestant = &series.contestant,
          .repetitions = 1,
          .ms = point.ms_per_move,
          .prepare_ms = point.prepare_ms,
          .error = point.error ? &*point.error : nullptr};
}

template <auto... Members>
constexpr auto measured = at<Row, &Row::measured, Members...>;
template <auto Member>
constexpr auto later = measured<&PhysicsMeasurement::ms_per_move, Member>;
template <auto Member>
constexpr auto shape = measured<&PhysicsMeasurement::shape, Member>;
template <auto Member>
constexpr auto error = at<Row, &Row::error, Member>;
template <auto Member>
constexpr auto contestant = at<Row, &Row::contestant, Member>;

/// Returns a member of a spread of times; none if nothing was timed.
template <auto Times, auto Member>
CsvField timed(const Row& row) {
  const TimeSpread* ms = row.measured == nullptr ? nullptr : &Times(*row.measured);
  return ms != nullptr && ms->count > 0 ? CsvField(ms->*Member) : CsvField();
}
constexpr auto first = [](const PhysicsMeasurement& m) -> const TimeSpread& { return m.first_move; };
constexpr auto after_cut = [](const PhysicsMeasurement& m) -> const TimeSpread& { return m.move_after_cut; };
constexpr auto factorize = [](const PhysicsMeasurement& m) -> const TimeSpread& { return m.prepare.factorize; };
constexpr auto grab = [](const PhysicsMeasurement& m) -> const TimeSpread& { return m.prepare.grab; };

/// Returns by how much the contestant differs on the turned object.
template <std::size_t Angle, auto Member>
CsvField turned(const Row& row) {
  const bool known = row.symmetry != nullptr && Angle < row.symmetry->turns.size();
  return known ? CsvField(row.symmetry->turns[Angle].*Member) : CsvField();
}

constexpr CsvColumn<Row> columns[]{
    {"object", at<Row, &Row::object>},
    {"elements", at<Row, &Row::elements>},
    {"pins", at<Row, &Row::pins>},
    {"drag", at<Row, &Row::drag>},
    {"hand", at<Row, &Row::displacement>},
    {"algorithm", [](const Row& row) -> CsvField { return name(*row.contestant); }},
    {"sweeps", contestant<&PhysicsContestant::sweeps>},
    {"refusal", at<Row, &Row::refusal>},
    {"repetitions", at<Row, &Row::repetitions>},
    {"ms", at<Row, &Row::ms>},
    {"ms_lower_quartile", later<&TimeSpread::lower_quartile>},
    {"ms_upper_quartile", later<&TimeSpread::upper_quartile>},
    {"ms_min", later<&TimeSpread::min>},
    {"ms_max", later<&TimeSpread::max>},
    {"prepare_ms", at<Row, &Row::prepare_ms>},
    {"error_rms", error<&PhysicalError::rms>},
    {"error_max", error<&PhysicalError::max>},
    {"moving_rms", error<&PhysicalError::moving_rms>},
    {"moving_max", error<&PhysicalError::moving_max>},
    {"moving_elements", at<Row, &Row::moving>},
    {"relative", error<&PhysicalError::relative>},
    {"first_ms", timed<first, &TimeSpread::median>},
    {"first_lower_quartile", timed<first, &TimeSpread::lower_quartile>},
    {"first_upper_quartile", timed<first, &TimeSpread::upper_quartile>},
    {"first_repetitions", timed<first, &TimeSpread::count>},
    {"after_cut_ms", timed<after_cut, &TimeSpread::median>},
    {"after_cut_lower_quartile", timed<after_cut, &TimeSpread::lower_quartile>},
    {"after_cut_upper_quartile", timed<after_cut, &TimeSpread::upper_quartile>},
    {"after_cut_repetitions", timed<after_cut, &TimeSpread::count>},
    {"factorize_ms", timed<factorize, &TimeSpread::median>},
    {"factorize_lower_quartile", timed<factorize, &TimeSpread::lower_quartile>},
    {"factorize_upper_quartile", timed<factorize, &TimeSpread::upper_quartile>},
    {"factorize_repetitions", timed<factorize, &TimeSpread::count>},
    {"grab_ms", timed<grab, &TimeSpread::median>},
    {"grab_lower_quartile", timed<grab, &TimeSpread::lower_quartile>},
    {"grab_upper_quartile", timed<grab, &TimeSpread::upper_quartile>},
    {"grab_repetitions", timed<grab, &TimeSpread::count>},
    {"handle", at<Row, &Row::handle>},
    {"calibrated", [](const Row& row) -> CsvField { return row.contestant->calibrated.has_value(); }},
    {"equilibrium", contestant<&PhysicsContestant::equilibrium>},
    {"open_regions", contestant<&PhysicsContestant::open_regions>},
    {"hausdorff", shape<&ShapeFigures::hausdorff>},
    {"volume_change", shape<&ShapeFigures::volume_change>},
    {"inverted_cells", shape<&ShapeFigures::inverted_cells>},
    {"largest_stretch", shape<&ShapeFigures::stretch>},
    {"violation_max", shape<&ShapeFigures::violation>},
    {"turned_45_max", turned<0, &TurnDifference::max>},
    {"turned_45_relative", turned<0, &TurnDifference::relative>},
    {"turned_90_max", turned<1, &TurnDifference::max>},
    {"turned_90_relative", turned<1, &TurnDifference::relative>},
    {"residual", measured<&PhysicsMeasurement::residual>},
    {"regions_bind", measured<&PhysicsMeasurement::binds>},
};
static_assert(symmetry_angles == std::array{45.0, 90.0}, "the columns turned_… name the angles");

}  // namespace physics_csv

void write_csv(std::ostream& out, const PhysicsReport& report) {
  std::vector<physics_csv::Row> rows;
  for (const PhysicsObject& object : report.objects) {
    for (const PhysicsDrag& drag : object.drags) {
      for (const PhysicsEntry& entry : drag.entries) {
        rows.push_back(physics_csv::row_of(object, drag, entry));
      }
    }
  }
  for (const PhysicsGrowth& growth : report.growths) {
    for (const GrowthSeries& series : growth.series) {
      for (const GrowthPoint& point : series.points) {
        rows.push_back(physics_csv::row_of(growth, series, point));
      }
    }
  }
  write_csv(out, physics_csv::columns, rows);
}

}  // namespace chainmail::report
