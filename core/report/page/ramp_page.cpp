#include "report/page/ramp_page.h"

#include <algorithm>
#include <string>

#include "report/page/format.h"

namespace chainmail::report {
namespace {

std::string size_of(std::uint32_t width) { return std::to_string(width) + "x" + std::to_string(width); }

std::string left_aligned(std::string text, std::size_t width) {
  text.resize(std::max(text.size(), width), ' ');
  return text;
}

std::string right_aligned(const std::string& text, std::size_t width) {
  return std::string(width - std::min(width, text.size()), ' ') + text;
}

const RampRow* find_row(const Ramp& ramp, std::uint32_t width, Algorithm algorithm) {
  const auto found = std::find_if(ramp.rows.begin(), ramp.rows.end(),
                                  [&](const RampRow& row) { return row.width == width && row.algorithm == algorithm; });
  return found == ramp.rows.end() ? nullptr : &*found;
}

void write_conditions(std::ostream& out, const Ramp& ramp, const Machine& machine) {
  const RampOptions& options = ramp.options;
  out << "Square grids in real time: 99% of passes within " << figure(1000 * options.budget) << " ms\n"
      << (options.precision == Precision::single_precision ? "float" : "double") << ", compression "
      << all_digits(options.softness.compression) << ", stretch " << all_digits(options.softness.stretch) << ", shear "
      << all_digits(options.softness.shear) << "; " << options.drags << " drags of " << options.moves
      << " moves at each size, seed " << options.seed << '\n'
      << machine.processor << ", " << machine.cores << " cores; " << machine.compiler << ", " << machine.build << "; "
      << figure(ramp.seconds) << " s\n";
  if (ramp.stopped) {
    out << "The ramp was stopped before its end.\n";
  }
}

void write_verdict(std::ostream& out, const Ramp& ramp, const RampVerdict& verdict) {
  out << left_aligned(std::string(info(verdict.algorithm).label), 24);
  if (verdict.largest_width) {
    const RampRow& row = *find_row(ramp, *verdict.largest_width, verdict.algorithm);
    out << right_aligned(size_of(row.width) + (verdict.lost ? "" : " or more"), 18)
        << right_aligned(std::to_string(row.elements), 10) << right_aligned(figure(row.median_ms), 11)
        << right_aligned(figure(row.p99_ms), 9);
  } else {
    out << right_aligned(verdict.lost ? "never" : "not measured", 18) << right_aligned("", 30);
  }
  if (const auto& growth = verdict.growth) {
    out << right_aligned(figure(growth->power), 10) << "  " << std::to_string(std::uint64_t(growth->from)) << " to "
        << std::to_string(std::uint64_t(growth->to));
  }
  out << '\n';
}

/// Returns `median/p99` in ms, with a `!` if the budget is exceeded; empty if the algorithm has left the ramp.
std::string cell(const RampRow* row) {
  if (row == nullptr) {
    return "";
  }
  return figure(row->median_ms, 2) + "/" + figure(row->p99_ms, 2) + (row->in_real_time ? " " : "!");
}

void write_sizes(std::ostream& out, const Ramp& ramp) {
  out << "\nmedian/99th percentile in ms; ! over the budget in two attempts\n" << left_aligned("", 10);
  for (const Algorithm algorithm : ramp.options.algorithms) {
    out << right_aligned(std::string(info(algorithm).offered_name()) + " ", 16);
  }
  out << '\n';
  std::uint32_t last = 0;
  for (const RampRow& row : ramp.rows) {
    if (row.width == last) {
      continue;
    }
    last = row.width;
    std::string line = left_aligned(size_of(row.width), 10);
    for (const Algorithm algorithm : ramp.options.algorithms) {
      line += right_aligned(cell(find_row(ramp, row.width, algorithm)), 16);
    }
    out << line.substr(0, line.find_last_not_of(' ') + 1) << '\n';
  }
}

}  // namespace

void write_text(std::ostream& out, const Ramp& ramp, const Machine& machine) {
  write_conditions(out, ramp, machine);
  out << '\n'
      << left_aligned("", 24) << right_aligned("real time up to", 18) << right_aligned("elements", 10)
      << right_aligned("median ms", 11) << right_aligned("99th ms", 9) << right_aligned("exponent", 10)
      << "  of the median, over elements\n";
  for (const RampVerdict& verdict : ramp.verdicts) {
    write_verdict(out, ramp, verdict);
  }
  write_sizes(out, ramp);
}

std::span<const Figure<RampRow>> ramp_figures() {
  static constexpr Figure<RampRow> figures[]{
      {"width", at<RampRow, &RampRow::width>},
      {"elements", at<RampRow, &RampRow::elements>},
      {"links", at<RampRow, &RampRow::links>},
      {"algorithm", [](const RampRow& row) -> FigureValue { return info(row.algorithm).name; }},
      {"passes", at<RampRow, &RampRow::passes>},
      {"median_ms", at<RampRow, &RampRow::median_ms>},
      {"p99_ms", at<RampRow, &RampRow::p99_ms>},
      {"mean_moved", at<RampRow, &RampRow::mean_moved>},
      {"repeated", at<RampRow, &RampRow::repeated>},
      {"real_time", at<RampRow, &RampRow::in_real_time>},
  };
  return figures;
}

void write_csv(std::ostream& out, const Ramp& ramp) { write_csv(out, ramp_figures(), ramp.rows); }

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
