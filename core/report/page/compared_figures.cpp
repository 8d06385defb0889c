#include "report/page/compared_figures.h"

#include <vector>

namespace chainmail::report {
namespace compared {

using Row = ComparedRow;

/// A member of what was measured, of the times of moves, or of the errors.
template <auto... Members>
constexpr auto measured = at<Row, &Row::entry, &Entry::measurement, Members...>;
template <auto... Member>
constexpr auto time = measured<&Measurement::ms_per_move, Member...>;
template <auto... Members>
constexpr auto error = measured<&Measurement::errors, Members...>;
template <auto... Members>
constexpr auto shape = error<&Errors::shape, Members...>;

FigureValue quartiles(const Row& row) {
  const TimeSpread& ms = row.entry->measurement->ms_per_move;
  return figure(ms.lower_quartile) + "–" + figure(ms.upper_quartile);
}
template <auto Count>
FigureValue per_move(const Row& row) {
  return double((*row.entry->measurement).*Count) / row.drag->moves;
}

constexpr const char* times = "ms per move";
constexpr const char* counts = "elements per move";
constexpr const char* violation = "violation (rest lengths)";
constexpr const char* exact = "distance to Exact (mean rest lengths)";
constexpr const char* precisions = "float to double (mean rest lengths)";

constexpr Figure<Row> figures[]{
    {"object", at<Row, &Row::object, &CaseResult::name>},
    {"elements", at<Row, &Row::object, &CaseResult::elements>},
    {"links", at<Row, &Row::object, &CaseResult::links>},
    {"drag", at<Row, &Row::drag, &DragResult::name>},
    {"moves", at<Row, &Row::drag, &DragResult::moves>},
    {"algorithm", [](const Row& row) -> FigureValue { return info(row.entry->contestant.algorithm).name; }},
    {"sweeps", at<Row, &Row::entry, &Entry::contestant, &Contestant::sweeps>},
    {"refusal", at<Row, &Row::entry, &Entry::refusal>},
    {"", time<>, "/ms_per_move"},
    {"repetitions", time<&TimeSpread::count>},
    {"ms", time<&TimeSpread::median>, "", times, "median"},
    {"ms_lower_quartile", time<&TimeSpread::lower_quartile>},
    {"ms_upper_quartile", time<&TimeSpread::upper_quartile>},
    {"", quartiles, "", times, "quartiles"},
    {"ms_min", time<&TimeSpread::min>},
    {"ms_max", time<&TimeSpread::max>},
    {"worst_move_ms", measured<&Measurement::worst_move_ms>, "/worst_move_ms", times, "worst move"},
    {"checked", measured<&Measurement::checked>, "/checked"},
    {"", per_move<&Measurement::checked>, "", counts, "checked"},
    {"moved", measured<&Measurement::moved>, "/moved"},
    {"", per_move<&Measurement::moved>, "", counts, "moved"},
    {"violation_max", error<&Errors::violation, &Violation::max>, "/violation/max", violation, "max"},
    {"violation_rms", error<&Errors::violation, &Violation::rms>, "/violation/rms", violation, "RMS"},
    {"violation_fraction", error<&Errors::violation, &Violation::fraction>, "/violation/fraction", "violated links",
     "share (%)", percent},
    {"exact_distance_max", error<&Errors::to_exact, &Distance::max>, "/distance_to_exact/max", exact, "max"},
    {"exact_distance_rms", error<&Errors::to_exact, &Distance::rms>, "/distance_to_exact/rms", exact, "RMS"},
    {"energy_over_exact", error<&Errors::energy_over_exact>, "/energy_over_exact", "energy", "/ Exact’s (ratio)"},
    {"float_double_max", error<&Errors::float_to_double, &Distance::max>, "/float_to_double/max", precisions, "max"},
    {"float_double_rms", error<&Errors::float_to_double, &Distance::rms>, "/float_to_double/rms", precisions, "RMS"},
    {"largest_over_hand", error<&Errors::largest_over_handle>, "/largest_over_hand", "farthest", "/ handle (ratio)"},
    {"equilibrium_distance_max", error<&Errors::to_equilibrium, &Distance::max>, "/distance_to_equilibrium/max"},
    {"equilibrium_distance_rms", error<&Errors::to_equilibrium, &Distance::rms>, "/distance_to_equilibrium/rms"},
    {"equilibrium", at<Row, &Row::entry, &Entry::contestant, &Contestant::equilibrium>},
    {"hausdorff", shape<&ShapeFigures::hausdorff>, "/shape/hausdorff", "shape",
     "Hausdorff to Exact (mean rest lengths)"},
    {"volume_change", shape<&ShapeFigures::volume_change>, "/shape/volume_change", "shape", "volume change (%)",
     signed_percent},
    {"inverted_cells", shape<&ShapeFigures::inverted_cells>, "/shape/inverted_cells", "shape", "inverted cells", count},
    {"largest_stretch", shape<&ShapeFigures::stretch>, "/shape/largest_stretch", "shape", "largest stretch (ratio)"},
    {"", shape<&ShapeFigures::violation>, "/shape/violation_max"},
    {"", error<&Errors::to_equilibrium, &Distance::max>, "", equilibrium_group, "max"},
    {"", error<&Errors::to_equilibrium, &Distance::rms>, "", equilibrium_group, "RMS"},
};

}  // namespace compared

std::span<const Figure<ComparedRow>> compared_figures() { return compared::figures; }

void write_csv(std::ostream& out, const Comparison& comparison) {
  std::vector<ComparedRow> rows;
  for (const CaseResult& object : comparison.cases) {
    for (const DragResult& drag : object.drags) {
      for (const Entry& entry : drag.entries) {
        rows.push_back({&object, &drag, &entry});
      }
    }
  }
  write_csv(out, compared_figures(), rows);
}

}  // namespace chainmail::report
