#include "report/table/figure.h"

#include <algorithm>
#include <iterator>
#include <string>
#include <vector>

#include "mesh/extra_row.h"
#include "report/table/format.h"

namespace chainmail::report {

namespace {

std::vector<const Figure*>& figure_table() {
  using namespace figures;
  static constexpr const Figure* all[]{&ms_per_move,
                                       &worst_move_ms,
                                       &first_ms,
                                       &later_ms,
                                       &fresh_ms,
                                       &after_cut_ms,
                                       &factorize_ms,
                                       &grab_ms,
                                       &prepare_ms,
                                       &iterations,
                                       &checked,
                                       &moved,
                                       &bytes,
                                       &relative,
                                       &relative_turned,
                                       &reference_change,
                                       &error_rms,
                                       &error_max,
                                       &moving_rms,
                                       &moving_max,
                                       &moving_elements,

                                       &violation_max,
                                       &violation_rms,
                                       &violation_fraction,
                                       &exact_distance_max,
                                       &exact_distance_rms,
                                       &energy_over_exact,
                                       &equilibrium_distance_max,
                                       &equilibrium_distance_rms,
                                       &float_double_max,
                                       &float_double_rms,
                                       &largest_over_handle,
                                       &hausdorff,
                                       &volume_change,
                                       &inverted_cells,
                                       &stretch,
                                       &residual,
                                       &binds,
                                       &turned_45_max,
                                       &turned_45_relative,
                                       &turned_90_max,
                                       &turned_90_relative,
                                       &passes,
                                       &median_ms,
                                       &p99_ms,
                                       &mean_moved,
                                       &repeated,
                                       &real_time};
  static std::vector<const Figure*> table(std::begin(all), std::end(all));
  return table;
}

}  // namespace

std::span<const Figure* const> every_figure() { return figure_table(); }

const Figure* find_figure(std::string_view key) {
  const auto all = every_figure();
  const auto found = std::ranges::find_if(all, [&](const Figure* one) { return one->key == key; });
  return found == all.end() ? nullptr : *found;
}

std::string definition_of(const Figure& of) {
  std::string text(of.definition);
  if (const auto place = text.find("{}"); place != std::string::npos) {
    text.replace(place, 2, figure(of.quoted));
  }
  return text;
}

std::string in_brackets(const Figure& figure) {
  const bool in_percent = figure.format == FigureFormat::percent || figure.format == FigureFormat::signed_percent;
  return figure.unit.empty() || in_percent ? "" : " (" + std::string(figure.unit) + ")";
}

std::string group_with_unit(const Figure& figure) { return std::string(figure.group) + in_brackets(figure); }

}  // namespace chainmail::report

namespace chainmail {
/// For ExtraRow, in tests.
template <>
std::vector<const report::Figure*>& table_of() {
  return report::figure_table();
}
}  // namespace chainmail
