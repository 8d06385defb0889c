#include "report/page/suite_table.h"

#include <algorithm>
#include <limits>
#include <tuple>

#include "report/page/format.h"

namespace chainmail::report {
namespace {

// The reference is neo-Hookean: on the object's own cells, neo-Hookean FEM is what the reference converges from. It is
// listed, but no finding names it.
constexpr std::string_view of_reference = "neo-hookean", null_model = "nothing";

std::string cell_of(const std::optional<double>& value) { return value ? figure(*value) : "-"; }

/// Returns a figure of a row. Errors below the change of the reference say no more than that.
std::string cell_of(const SuiteRow& row, const SuiteFigure& of) {
  const auto& value = row.*of.value;
  const bool is_error = of.value == &SuiteRow::relative || of.value == &SuiteRow::relative_turned;
  return value && is_error ? error_figure(*value, row.reference_change) : cell_of(value);
}

/// Returns by how much the last refinement changed a reference, by its number.
std::optional<double> change_of(const SuiteResult& result, std::size_t reference) {
  return reference >= result.references.size() || result.references[reference].levels.empty()
             ? std::nullopt
             : result.references[reference].levels.back().change;
}

/// A mean of the values that exist.
class Mean {
 public:
  void add(const std::optional<double>& value) {
    if (value) {
      sum_ += *value;
      ++count_;
    }
  }
  std::optional<double> value() const { return count_ == 0 ? std::nullopt : std::optional(sum_ / count_); }

 private:
  double sum_ = 0;
  int count_ = 0;
};

std::vector<std::string> contestants_in(const std::vector<SuiteRow>& rows) {
  std::vector<std::string> names;
  for (const SuiteRow& row : rows) {
    if (std::ranges::find(names, row.contestant) == names.end()) {
      names.push_back(row.contestant);
    }
  }
  return names;
}

SuiteMean mean_of(const SuiteResult& result, const std::string& contestant) {
  SuiteMean mean;
  Mean relative, turned, later, fresh, cut, relative_of_cut, change, change_of_cut;
  for (const SuiteRow& row : result.rows) {
    if (row.contestant != contestant) {
      continue;
    }
    mean.contestant = contestant;
    mean.algorithm = row.algorithm;
    cut.add(row.after_cut_ms);
    if (row.has_cut) {
      relative_of_cut.add(row.relative);
      change_of_cut.add(row.reference_change);
      continue;
    }
    ++mean.of;
    mean.drags += row.relative ? 1 : 0;
    mean.refusal = row.refusal.empty() ? mean.refusal : row.refusal;
    relative.add(row.relative);
    change.add(row.reference_change);
    turned.add(row.relative_turned);
    later.add(row.later_ms);
    fresh.add(row.first_ms ? std::optional(*row.first_ms + row.grab_ms.value_or(0)) : std::nullopt);
  }
  mean.relative = mean.relative_of_fresh = relative.value();
  mean.relative_turned = turned.value();
  mean.later_ms = later.value();
  mean.after_cut_ms = cut.value();
  mean.fresh_ms = fresh.value();
  mean.relative_of_cut = relative_of_cut.value();
  mean.change = change.value();
  mean.change_of_cut = change_of_cut.value();
  return mean;
}

/// Returns true if a point of a contestant has this error.
bool is_measured(const SuiteResult& result, const SuitePointFigures& of) {
  return std::ranges::any_of(result.times, [&](const SuiteTime& time) {
    return std::ranges::any_of(time.curve, [&](const SuitePoint& point) { return (point.*of.error).has_value(); });
  });
}

/// Returns how often a point iterates per move, after the name of its contestant.
std::string times_in_words(std::uint64_t iterations) {
  return iterations == 0 ? "" : " × " + std::to_string(iterations);
}

double counted(const SuiteMean& mean) { return counted_error(mean, speeds_against_error.front()); }

/// Returns the contestants with the least error: several, if the change of the reference is not less than theirs.
std::vector<const SuiteMean*> closest(const std::vector<SuiteMean>& means) {
  std::vector<const SuiteMean*> best;
  for (const SuiteMean& mean : means) {
    if (may_win(mean) && (best.empty() || counted(mean) <= counted(*best.front()))) {
      if (!best.empty() && counted(mean) < counted(*best.front())) {
        best.clear();
      }
      best.push_back(&mean);
    }
  }
  return best;
}

std::string summary_cell(const SuiteMean& mean, const std::vector<const SuiteMean*>& best) {
  if (!mean.relative) {
    return "-";
  }
  const bool is_best = std::ranges::find(best, mean.contestant, &SuiteMean::contestant) != best.end();
  const std::string number = error_figure(*mean.relative, mean.change) + (is_best ? "*" : "");
  return mean.drags == mean.of ? number
                               : number + " (" + std::to_string(mean.drags) + " of " + std::to_string(mean.of) + ")";
}

/// Returns the contestants with their errors: `Linear FEM (0.085)`.
std::string errors_of(const std::vector<const SuiteMean*>& means) {
  std::string text;
  for (const SuiteMean* mean : means) {
    text += (text.empty() ? "" : ", ") + mean->contestant + " (" + error_figure(*mean->relative, mean->change) + ")";
  }
  return text;
}

/// Returns the contestants with their times and errors: `Linear FEM (0.02 ms, 0.085)`.
std::string listed(const std::vector<const SuiteMean*>& means, const SpeedAgainstError& measure) {
  std::string text;
  for (const SuiteMean* mean : means) {
    text += (text.empty() ? "" : ", ") + mean->contestant + " (" + figure(*(mean->*measure.ms)) + " ms, " +
            error_figure(*(mean->*measure.error), mean->*measure.change) + ")";
  }
  return text;
}

std::string about(const SuiteResult& result) {
  std::string text = result.description + "; " + thousands(result.elements) + " elements, " + thousands(result.links) +
                     " links, " + std::to_string(result.pins) + " pinned; reference: " + result.reference;
  if (!result.references.empty()) {
    text += "; " + convergence_in_words(result.references);
  }
  for (const std::string& note : result.notes) {
    text += "; " + note;
  }
  return text;
}

}  // namespace

std::vector<SuiteMean> means_of(const SuiteResult& result) {
  std::vector<SuiteMean> means;
  for (const std::string& contestant : contestants_in(result.rows)) {
    means.push_back(mean_of(result, contestant));
  }
  return means;
}

std::vector<SuiteMean> points_of(const SuiteResult& result, const SuiteTime& time) {
  std::vector<SuiteMean> points;
  for (const SuitePoint& point : time.curve) {
    SuiteMean& mean = points.emplace_back();
    mean.contestant = time.contestant + times_in_words(point.iterations);
    mean.algorithm = time.algorithm;
    mean.drags = mean.of = 1;
    mean.relative = point.relative;
    mean.relative_of_fresh = point.fresh_relative;
    mean.relative_of_cut = point.cut_relative;
    mean.later_ms = point.later_ms;
    mean.fresh_ms = point.fresh_ms;
    mean.after_cut_ms = point.after_cut_ms;
    mean.change = change_of(result, 0);
    mean.change_of_cut = change_of(result, 1);
  }
  return points;
}

bool may_win(const SuiteMean& mean) {
  return mean.relative && mean.drags == mean.of && mean.algorithm != of_reference && mean.algorithm != null_model;
}

FigureTable suite_summary(const Suite& suite) {
  FigureTable table{
      "Summary",
      "mean relative error over the drags of an experiment without a cut. 1: as wrong as an object that "
      "does not move. *: the closest, without neo-Hookean FEM, the material of most references. Below: less than "
      "the reference itself changed in its last refinement",
      "detail",
      "contestant",
      {},
      {}};
  std::vector<std::vector<SuiteMean>> columns;
  for (const SuiteResult& result : suite.results) {
    if (!result.rows.empty()) {
      table.columns.push_back({"relative error (ratio)", result.name});
      columns.push_back(means_of(result));
    }
  }
  std::vector<std::string> names;
  for (const auto& column : columns) {
    for (const SuiteMean& mean : column) {
      if (std::ranges::find(names, mean.contestant) == names.end()) {
        names.push_back(mean.contestant);
      }
    }
  }
  for (const std::string& name : names) {
    FigureTable::Row row{name, {}, {}};
    for (const auto& column : columns) {
      const auto found = std::ranges::find(column, name, &SuiteMean::contestant);
      row.cells.push_back(found == column.end() ? "-" : summary_cell(*found, closest(column)));
    }
    table.rows.push_back(std::move(row));
  }
  return table;
}

FigureTable time_table(const SuiteResult& result) {
  FigureTable table{result.name, about(result), "detail", "contestant", {{"relative error (ratio)", "least"}}, {}};
  std::vector<SuitePointFigures> measured;
  std::ranges::copy_if(suite_point_figures, std::back_inserter(measured),
                       [&](const SuitePointFigures& of) { return is_measured(result, of); });
  for (const SuitePointFigures& of : measured) {
    for (const double error : suite_errors) {
      table.columns.push_back({std::string(of.heading), figure(error)});
    }
  }
  table.columns.push_back({"prepare (ms)", "factorize"});
  const auto change = change_of(result, 0);
  for (const SuiteTime& time : result.times) {
    FigureTable::Row& row = table.rows.emplace_back(FigureTable::Row{time.contestant, {}, time.refusal});
    if (!time.refusal.empty()) {
      continue;
    }
    const auto least = least_error(time);
    row.cells.push_back(least ? error_figure(*least, change) : "-");
    for (const SuitePointFigures& of : measured) {
      std::ranges::transform(suite_errors, std::back_inserter(row.cells),
                             [&](double error) { return cell_of(shortest_ms(time, of, error)); });
    }
    row.cells.push_back(cell_of(time.factorize_ms));
  }
  return table;
}

FigureTable order_table(const SuiteResult& result) {
  FigureTable table{result.name, about(result), "detail", "contestant", {}, {}};
  std::vector<std::uint64_t> sizes;
  for (const SuiteOrder& one : result.orders) {
    for (const SuiteOrder::Size& size : one.sizes) {
      if (std::ranges::find(sizes, size.elements) == sizes.end()) {
        sizes.push_back(size.elements);
      }
    }
  }
  std::ranges::sort(sizes);
  for (const std::uint64_t size : sizes) {
    table.columns.push_back({"relative error (ratio), elements", thousands(size)});
  }
  table.columns.push_back({"observed", "order"});
  for (const SuiteOrder& one : result.orders) {
    FigureTable::Row& row = table.rows.emplace_back(FigureTable::Row{one.contestant, {}, {}});
    if (one.sizes.empty()) {
      row.refusal = one.refusal;
      continue;
    }
    for (const std::uint64_t size : sizes) {
      const auto found = std::ranges::find(one.sizes, size, &SuiteOrder::Size::elements);
      row.cells.push_back(found == one.sizes.end() ? "-" : figure(found->relative));
    }
    row.cells.push_back(cell_of(one.order));
  }
  return table;
}

FigureTable suite_table(const SuiteResult& result) {
  FigureTable table{result.name, about(result), "detail", "drag, contestant", {}, {}};
  for (const SuiteFigure& figure : suite_figures) {
    table.columns.push_back({std::string(figure.group), std::string(figure.heading)});
  }
  for (const SuiteRow& one : result.rows) {
    const std::string where = one.drag + ", element " + std::to_string(one.handle) + ": ";
    FigureTable::Row& row = table.rows.emplace_back(FigureTable::Row{where + one.contestant, {}, one.refusal});
    for (const SuiteFigure& figure : suite_figures) {
      if (one.refusal.empty()) {
        row.cells.push_back(cell_of(one, figure));
      }
    }
  }
  return table;
}

std::vector<SuiteMean> compared_in(const SuiteResult& result) {
  std::vector<SuiteMean> all = means_of(result);
  for (const SuiteTime& time : result.times) {
    const auto points = points_of(result, time);
    all.insert(all.end(), points.begin(), points.end());
  }
  return all;
}

std::vector<std::string> suite_findings(const Suite& suite) {
  std::vector<std::string> sentences;
  for (const SuiteResult& result : suite.results) {
    const auto means = means_of(result);
    if (const auto best = closest(means); !best.empty()) {
      sentences.push_back(result.name + ": " + errors_of(best) + (best.size() == 1 ? " is closest" : " are closest"));
    }
    const auto compared = compared_in(result);
    for (const SpeedAgainstError& measure : speeds_against_error) {
      if (const auto winners = front(compared, measure); !winners.empty()) {
        sentences.push_back(result.name + ", " + std::string(measure.what) + ": on the front are " +
                            listed(winners, measure));
      }
    }
  }
  return sentences;
}

FigureTable peer_table(const PeerCase& object) {
  FigureTable table;
  table.caption = object.name;
  table.about = object.description;
  if (object.reference_change) {
    table.about += "; the last refinement of the reference changed it by " + figure(*object.reference_change);
  }
  table.corner = "solver";
  table.columns = {{"", "relative error"},        {"move (ms)", "first"},     {"move (ms)", "later"},
                   {"prepare (ms)", "factorize"}, {"prepare (ms)", "grab"},   {"shape", "Hausdorff"},
                   {"shape", "volume change"},    {"shape", "inverted cells"}};
  return table;
}

FigureTable::Row peer_row(const PeerCase& object, const PeerAnswer& answer) {
  const PeerVerdict verdict = judge(object, answer);
  const auto& inverted = verdict.shape.inverted_cells;
  return {answer.solver,
          {error_figure(verdict.error.relative, object.reference_change), cell_of(verdict.first_ms),
           cell_of(verdict.later_ms), cell_of(answer.factorize_ms), cell_of(answer.grab_ms),
           cell_of(verdict.shape.hausdorff), cell_of(verdict.shape.volume_change),
           inverted ? std::to_string(*inverted) : "-"},
          {}};
}

void write_text(std::ostream& out, const Suite& suite) {
  for (const std::string& sentence : suite_findings(suite)) {
    out << sentence << '\n';
  }
  if (const FigureTable summary = suite_summary(suite); !summary.rows.empty()) {
    write_text(out, summary);
  }
  for (const SuiteResult& result : suite.results) {
    if (!result.orders.empty()) {
      write_text(out, order_table(result));
    }
    if (!result.times.empty()) {
      write_text(out, time_table(result));
    }
  }
}

double counted_error(const SuiteMean& mean, const SpeedAgainstError& measure) {
  return std::max(*(mean.*measure.error), (mean.*measure.change).value_or(0));
}

std::vector<const SuiteMean*> front(const std::vector<SuiteMean>& means, const SpeedAgainstError& measure) {
  std::vector<const SuiteMean*> all, winners;
  for (const SuiteMean& mean : means) {
    if (may_win(mean) && mean.*measure.ms && mean.*measure.error) {
      all.push_back(&mean);
    }
  }
  std::ranges::stable_sort(
      all, {}, [&](const SuiteMean* one) { return std::tuple(*(one->*measure.ms), counted_error(*one, measure)); });
  double closest = std::numeric_limits<double>::infinity();
  for (const SuiteMean* one : all) {
    const double error = counted_error(*one, measure);
    const bool ties = !winners.empty() && *(winners.back()->*measure.ms) == *(one->*measure.ms) && error == closest;
    if (error < closest || ties) {
      winners.push_back(one);
      closest = error;
    }
  }
  return winners;
}

}  // namespace chainmail::report
