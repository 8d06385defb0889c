#include "report/page/physics_figures.h"

#include <vector>

namespace chainmail::report {
namespace physics {

using Row = PhysicsRow;

/// Returns the value of the first figure that has one: that of a drag, or that of a growing object.
template <auto First, auto Second>
FigureValue either(const Row& row) {
  const FigureValue value = First(row);
  return value.index() != 0 ? value : Second(row);
}
template <auto... Members>
constexpr auto measured = at<Row, &Row::entry, &PhysicsEntry::measurement, Members...>;
template <auto... Members>
constexpr auto later = measured<&PhysicsMeasurement::ms_per_move, Members...>;
template <auto Member>
constexpr auto shape = measured<&PhysicsMeasurement::shape, Member>;
template <auto Member>
constexpr auto error =
    either<measured<&PhysicsMeasurement::error, Member>, at<Row, &Row::point, &GrowthPoint::error, Member>>;

const PhysicsContestant& contestant_of(const Row& row) {
  return row.entry != nullptr ? row.entry->contestant : row.series->contestant;
}
template <auto Member>
FigureValue contestant(const Row& row) {
  return follow(contestant_of(row), Member);
}

/// Returns the times of repetitions, or a part of them; none if nothing was timed.
template <auto Times, auto... Part>
FigureValue timed(const Row& row) {
  const FigureValue value = Times(row);
  const auto* ms = std::get_if<TimeSpread>(&value);
  return ms != nullptr && ms->count > 0 ? follow(*ms, Part...) : FigureValue();
}
constexpr auto first = measured<&PhysicsMeasurement::first_move>;
constexpr auto with_cut = measured<&PhysicsMeasurement::move_after_cut>;
constexpr auto factorize = measured<&PhysicsMeasurement::prepare, &Preparation::factorize>;
constexpr auto grab = measured<&PhysicsMeasurement::prepare, &Preparation::grab>;

FigureValue object_name(const Row& row) {
  return row.growth != nullptr ? "growing " + row.growth->name : row.object->name;
}
FigureValue repetitions(const Row& row) {
  return row.point != nullptr ? FigureValue(1) : later<&TimeSpread::count>(row);
}
FigureValue prepare_ms(const Row& row) {
  return row.entry != nullptr && row.entry->measurement ? row.entry->measurement->prepare.ms() : FigureValue();
}

/// Returns by how much the contestant differs on the turned object.
template <std::size_t Angle, auto Member>
FigureValue turned(const Row& row) {
  const Symmetry* found = row.object == nullptr ? nullptr : find_symmetry(row.object->symmetry, contestant_of(row));
  return found != nullptr && Angle < found->turns.size() ? found->turns[Angle].*Member : FigureValue();
}

// Relative errors below this come from Newton's method and from single precision: the method equals the reference.
constexpr double reference_found_again = 1e-5;

std::string relative_cell(const std::optional<double>& error) {
  return error && *error < reference_found_again ? "<1e-5" : figure(error);
}
std::string yes_no(const std::optional<double>& is) { return !is ? "" : *is != 0 ? "yes" : "no"; }

constexpr const char* shapes = "shape: worst of the drags";
constexpr const char* equilibrium = "equilibrium: worst of the drags";

constexpr Figure<Row> figures[]{
    {"object", object_name},
    {"elements", either<at<Row, &Row::object, &PhysicsObject::elements>, at<Row, &Row::point, &GrowthPoint::elements>>},
    {"pins", at<Row, &Row::object, &PhysicsObject::pins>},
    {"drag", at<Row, &Row::drag, &PhysicsDrag::name>},
    {"hand", at<Row, &Row::drag, &PhysicsDrag::handle_displacement>},
    {"algorithm", [](const Row& row) -> FigureValue { return name(contestant_of(row)); }},
    {"sweeps", contestant<&PhysicsContestant::sweeps>},
    {"refusal", at<Row, &Row::entry, &PhysicsEntry::refusal>},
    {"", later<>, "/ms_per_move"},
    {"", timed<first>, "/first_move_ms", "time (ms)", "first"},
    {"", timed<later<>>, "", "time (ms)", "later"},
    {"", timed<with_cut>, "/move_after_cut_ms", "time (ms)", after_cut},
    {"repetitions", repetitions},
    {"ms", either<later<&TimeSpread::median>, at<Row, &Row::point, &GrowthPoint::ms_per_move>>},
    {"ms_lower_quartile", later<&TimeSpread::lower_quartile>},
    {"ms_upper_quartile", later<&TimeSpread::upper_quartile>},
    {"ms_min", later<&TimeSpread::min>},
    {"ms_max", later<&TimeSpread::max>},
    {"prepare_ms", either<prepare_ms, at<Row, &Row::point, &GrowthPoint::prepare_ms>>, "/prepare_ms"},
    {"", timed<factorize>, "/factorize_ms", "prepare (ms)", "factorize"},
    {"", timed<grab>, "/grab_ms", "prepare (ms)", "grab"},
    {"", error<&PhysicalError::relative>, "/error/relative", relative_error, "", relative_cell},
    {"error_rms", error<&PhysicalError::rms>, "/error/rms", "RMS error (%)", "", percent},
    {"error_max", error<&PhysicalError::max>, "/error/max", "largest error (%)", "", percent},
    {"moving_rms", error<&PhysicalError::moving_rms>, "/error/moving_rms", "RMS, what moves (%)", "", percent},
    {"moving_max", error<&PhysicalError::moving_max>, "/error/moving_max", "largest, what moves (%)", "", percent},
    {"", error<&PhysicalError::moving>, "/error/moving_elements"},
    {"moving_elements", measured<&PhysicsMeasurement::error, &PhysicalError::moving>},
    {"relative", error<&PhysicalError::relative>},
    {"first_ms", timed<first, &TimeSpread::median>},
    {"first_lower_quartile", timed<first, &TimeSpread::lower_quartile>},
    {"first_upper_quartile", timed<first, &TimeSpread::upper_quartile>},
    {"first_repetitions", timed<first, &TimeSpread::count>},
    {"after_cut_ms", timed<with_cut, &TimeSpread::median>},
    {"after_cut_lower_quartile", timed<with_cut, &TimeSpread::lower_quartile>},
    {"after_cut_upper_quartile", timed<with_cut, &TimeSpread::upper_quartile>},
    {"after_cut_repetitions", timed<with_cut, &TimeSpread::count>},
    {"factorize_ms", timed<factorize, &TimeSpread::median>},
    {"factorize_lower_quartile", timed<factorize, &TimeSpread::lower_quartile>},
    {"factorize_upper_quartile", timed<factorize, &TimeSpread::upper_quartile>},
    {"factorize_repetitions", timed<factorize, &TimeSpread::count>},
    {"grab_ms", timed<grab, &TimeSpread::median>},
    {"grab_lower_quartile", timed<grab, &TimeSpread::lower_quartile>},
    {"grab_upper_quartile", timed<grab, &TimeSpread::upper_quartile>},
    {"grab_repetitions", timed<grab, &TimeSpread::count>},
    {"handle", at<Row, &Row::drag, &PhysicsDrag::handle>},
    {"calibrated", [](const Row& row) -> FigureValue { return contestant_of(row).calibrated.has_value(); }},
    {"equilibrium", contestant<&PhysicsContestant::equilibrium>},
    {"open_regions", contestant<&PhysicsContestant::open_regions>},
    {"hausdorff", shape<&ShapeFigures::hausdorff>, "/shape/hausdorff", shapes, "Hausdorff (rest lengths)"},
    {"volume_change", shape<&ShapeFigures::volume_change>, "/shape/volume_change", shapes, "volume change (%)",
     signed_percent},
    {"inverted_cells", shape<&ShapeFigures::inverted_cells>, "/shape/inverted_cells", shapes, "inverted cells", count},
    {"largest_stretch", shape<&ShapeFigures::stretch>, "/shape/largest_stretch", shapes, "stretch (ratio)"},
    {"violation_max", shape<&ShapeFigures::violation>, "/shape/violation_max", shapes, "violation (rest lengths)"},
    {"turned_45_max", turned<0, &TurnDifference::max>},
    {"turned_45_relative", turned<0, &TurnDifference::relative>},
    {"turned_90_max", turned<1, &TurnDifference::max>},
    {"turned_90_relative", turned<1, &TurnDifference::relative>},
    {"residual", measured<&PhysicsMeasurement::residual>, "/residual", equilibrium, "residual (ratio)", figure, true},
    {"regions_bind", measured<&PhysicsMeasurement::binds>, "/regions_bind", equilibrium, "regions bind", yes_no, true},
    // Per move: the least with which the contestant is close to its own limit.
    {"iterations", measured<&PhysicsMeasurement::iterations>, "/iterations", "", "", count, true},
};
static_assert(symmetry_angles == std::array{45.0, 90.0}, "the columns turned_… name the angles");

}  // namespace physics

std::span<const Figure<PhysicsRow>> physics_figures() { return physics::figures; }

void write_csv(std::ostream& out, const PhysicsReport& report) {
  std::vector<PhysicsRow> rows;
  for (const PhysicsObject& object : report.objects) {
    for (const PhysicsDrag& drag : object.drags) {
      for (const PhysicsEntry& entry : drag.entries) {
        rows.push_back({&object, &drag, &entry});
      }
    }
  }
  for (const PhysicsGrowth& growth : report.growths) {
    for (const GrowthSeries& series : growth.series) {
      for (const GrowthPoint& point : series.points) {
        rows.push_back({.growth = &growth, .series = &series, .point = &point});
      }
    }
  }
  write_csv(out, physics_figures(), rows);
}

}  // namespace chainmail::report
