#include "report/page/ramp_plot.h"

#include "report/page/format.h"
#include "report/page/plot_style.h"

namespace chainmail::report {

Plot ramp_plot(const Ramp& ramp) {
  Plot plot;
  plot.title = "Elements against time";
  plot.x.title = "elements";
  plot.y.title = "99th percentile of the pass times (ms)";
  plot.good_below = 1e3 * ramp.options.budget;
  plot.good_label = "real time";
  PlotPanel& panel = plot.panels.emplace_back();
  for (const Algorithm algorithm : ramp.options.algorithms) {
    const std::size_t series = series_of(plot, algorithm);
    const std::string name(info(algorithm).label);
    PlotCurve curve{series, {}};
    for (const RampRow& row : ramp.rows) {
      if (row.algorithm == algorithm) {
        const auto elements = static_cast<double>(row.elements);
        const std::string width = std::to_string(row.width);
        curve.points.push_back({elements, row.p99_ms});
        panel.marks.push_back({elements, elements, elements, row.p99_ms, series, !row.in_real_time, "",
                               name + ", " + width + "x" + width + ": median " + figure(row.median_ms) +
                                   " ms, 99th percentile " + figure(row.p99_ms) + " ms"});
      }
    }
    panel.curves.push_back(std::move(curve));
  }
  return plot;
}

}  // namespace chainmail::report
