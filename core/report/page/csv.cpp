#include "report/page/csv.h"

#include <vector>

#include "report/page/csv_table.h"

namespace chainmail::report {
namespace compared_csv {

/// One contestant in one drag of one object.
struct Row {
  const CaseResult* object;
  const DragResult* drag;
  const Entry* entry;
};

/// A member of what was measured, of the times of moves, or of the errors.
template <auto... Members>
constexpr auto measured = at<Row, &Row::entry, &Entry::measurement, Members...>;
template <auto Member>
constexpr auto time = measured<&Measurement::ms_per_move, Member>;
template <auto... Members>
constexpr auto error = measured<&Measurement::errors, Members...>;

constexpr CsvColumn<Row> columns[]{
    {"object", at<Row, &Row::object, &CaseResult::name>},
    {"elements", at<Row, &Row::object, &CaseResult::elements>},
    {"links", at<Row, &Row::object, &CaseResult::links>},
    {"drag", at<Row, &Row::drag, &DragResult::name>},
    {"moves", at<Row, &Row::drag, &DragResult::moves>},
    {"algorithm", [](const Row& row) -> CsvField { return info(row.entry->contestant.algorithm).name; }},
    {"sweeps", at<Row, &Row::entry, &Entry::contestant, &Contestant::sweeps>},
    {"refusal", at<Row, &Row::entry, &Entry::refusal>},
    {"repetitions", time<&TimeSpread::count>},
    {"ms", time<&TimeSpread::median>},
    {"ms_lower_quartile", time<&TimeSpread::lower_quartile>},
    {"ms_upper_quartile", time<&TimeSpread::upper_quartile>},
    {"ms_min", time<&TimeSpread::min>},
    {"ms_max", time<&TimeSpread::max>},
    {"worst_move_ms", measured<&Measurement::worst_move_ms>},
    {"checked", measured<&Measurement::checked>},
    {"moved", measured<&Measurement::moved>},
    {"violation_max", error<&Errors::violation, &Violation::max>},
    {"violation_rms", error<&Errors::violation, &Violation::rms>},
    {"violation_fraction", error<&Errors::violation, &Violation::fraction>},
    {"exact_distance_max", error<&Errors::to_exact, &Distance::max>},
    {"exact_distance_rms", error<&Errors::to_exact, &Distance::rms>},
    {"energy_over_exact", error<&Errors::energy_over_exact>},
    {"float_double_max", error<&Errors::float_to_double, &Distance::max>},
    {"float_double_rms", error<&Errors::float_to_double, &Distance::rms>},
    {"largest_over_hand", error<&Errors::largest_over_handle>},
    {"equilibrium_distance_max", error<&Errors::to_equilibrium, &Distance::max>},
    {"equilibrium_distance_rms", error<&Errors::to_equilibrium, &Distance::rms>},
    {"equilibrium", at<Row, &Row::entry, &Entry::contestant, &Contestant::equilibrium>},
    {"hausdorff", error<&Errors::shape, &ShapeFigures::hausdorff>},
    {"volume_change", error<&Errors::shape, &ShapeFigures::volume_change>},
    {"inverted_cells", error<&Errors::shape, &ShapeFigures::inverted_cells>},
    {"largest_stretch", error<&Errors::shape, &ShapeFigures::stretch>},
};

}  // namespace compared_csv

void write_csv(std::ostream& out, const Comparison& comparison) {
  std::vector<compared_csv::Row> rows;
  for (const CaseResult& object : comparison.cases) {
    for (const DragResult& drag : object.drags) {
      for (const Entry& entry : drag.entries) {
        rows.push_back({&object, &drag, &entry});
      }
    }
  }
  write_csv(out, compared_csv::columns, rows);
}

}  // namespace chainmail::report
