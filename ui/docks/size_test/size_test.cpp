#include "docks/size_test/size_test.h"

#include "common/panel_names.h"
#include "report/page/format.h"
#include "report/page/plot_style.h"

namespace chainmail {

QString sizeText(std::uint32_t width) { return QStringLiteral("%1×%1").arg(width); }

std::vector<std::uint32_t> widthsOf(const SizeTestOptions& options) {
  return report::ramp_widths(options.first, options.largest, options.growth);
}

report::RampVerdict verdictOf(const SizeTestContestant& contestant, std::span<const SizeTestRow> rows) {
  std::vector<report::RampRow> own;
  for (const SizeTestRow& row : rows) {
    if (row.panel == contestant.panel) {
      own.push_back(row.figures);
    }
  }
  return report::ramp_verdict(contestant.algorithm, own);
}

report::Plot plotOf(const std::vector<SizeTestContestant>& contestants, std::span<const SizeTestRow> rows,
                    double budget) {
  report::Plot plot;
  plot.title = "Elements against time";
  plot.x.title = "elements";
  plot.y.title = "99th percentile of the pass times (ms)";
  plot.good_below = 1e3 * budget;
  plot.good_label = "real time";
  report::PlotPanel& panel = plot.panels.emplace_back();
  for (const SizeTestContestant& contestant : contestants) {
    const std::string name =
        panelName(contestant.panel).toStdString() + ' ' + std::string(info(contestant.algorithm).label);
    const std::size_t series = plot.series.size();
    plot.series.push_back(
        {name, report::style_of(contestant.algorithm), QColor(contestant.colour).name().toStdString()});
    report::PlotCurve curve{series, {}};
    for (const SizeTestRow& row : rows) {
      if (row.panel == contestant.panel) {
        const auto elements = double(row.figures.elements);
        curve.points.push_back({elements, row.figures.p99_ms});
        panel.marks.push_back({elements, elements, elements, row.figures.p99_ms, series, !row.figures.in_real_time, "",
                               name + ", " + sizeText(row.figures.width).toStdString() + ": median " +
                                   report::figure(row.figures.median_ms) + " ms, 99th percentile " +
                                   report::figure(row.figures.p99_ms) + " ms"});
      }
    }
    if (!curve.points.empty()) {
      panel.curves.push_back(std::move(curve));
    }
  }
  return plot;
}

void writeCsv(std::ostream& out, std::span<const SizeTestRow> rows) {
  out << "width,elements,links,panel,algorithm,passes,median_ms,p99_ms,mean_moved,painted_per_s,repeated,real_time\n";
  for (const auto& [panel, one, painted] : rows) {
    out << one.width << ',' << one.elements << ',' << one.links << ',' << panelName(panel).toStdString() << ','
        << info(one.algorithm).name << ',' << one.passes << ',' << report::all_digits(one.median_ms) << ','
        << report::all_digits(one.p99_ms) << ',' << report::all_digits(one.mean_moved) << ',' << painted << ','
        << one.repeated << ',' << one.in_real_time << '\n';
  }
}

}  // namespace chainmail
