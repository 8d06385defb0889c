#include "docks/report/report_table.h"

#include <QGuiApplication>
#include <QHeaderView>
#include <QScrollBar>
#include <algorithm>
#include <limits>

#include "common/plot_painting.h"
#include "common/text.h"
#include "report/page/format.h"

namespace chainmail {
namespace {

// In logical pixels.
constexpr int tableMarkSize = 13;
constexpr int headMargin = 14;     // both sides of the text of a header
constexpr int sortMarkWidth = 15;  // on each side, so that the text stays in the middle

/// A cell that is sorted by its number, not by its text. Cells without a number come last.
class FigureItem : public QTableWidgetItem {
 public:
  FigureItem(const QString& words, std::optional<double> number)
      : QTableWidgetItem(words), number_(number.value_or(std::numeric_limits<double>::infinity())) {
    setTextAlignment(Qt::AlignRight | Qt::AlignVCenter);
    setFlags(Qt::ItemIsEnabled | Qt::ItemIsSelectable);
  }
  bool operator<(const QTableWidgetItem& other) const override {
    const auto* figure = dynamic_cast<const FigureItem*>(&other);
    return figure != nullptr && number_ < figure->number_;
  }

 private:
  double number_;
};

using report::Measurement;

struct Column {
  const char* head;
  const char* help;
  std::optional<double> (*number)(const Measurement& one);
  /// Text of the cell, if it is not the number alone.
  std::string (*words)(const Measurement& one) = nullptr;
};

template <double Distance::*Member>
std::optional<double> of(const std::optional<Distance>& distance) {
  return distance ? std::optional((*distance).*Member) : std::nullopt;
}

constexpr std::array columns{
    Column{"Time\n(ms per\nmove)", "Median over the repetitions: a pass and its relaxation",
           [](auto& one) { return std::optional(one.ms_per_move.median); }},
    Column{"Max\nviolation\n(rest\nlengths)", "Largest violation of a link, in its rest lengths",
           [](auto& one) { return std::optional(one.errors.violation.max); }},
    Column{"RMS\nviolation\n(rest\nlengths)", "Root mean square of the violation over all links, in rest lengths",
           [](auto& one) { return std::optional(one.errors.violation.rms); }},
    Column{"Violated\nlinks\n(%)", "Share of the links with a violation above 1e-4",
           [](auto& one) { return std::optional(one.errors.violation.fraction); },
           [](auto& one) { return report::percent(one.errors.violation.fraction); }},
    Column{"Max to\nExact\n(mean rest\nlengths)",
           "Largest distance of an element to its position by Exact ChainMail in double, in mean rest lengths",
           [](auto& one) { return of<&Distance::max>(one.errors.to_exact); }},
    Column{"RMS to\nExact\n(mean rest\nlengths)",
           "Root mean square of the distance to Exact ChainMail in double, in mean rest lengths",
           [](auto& one) { return of<&Distance::rms>(one.errors.to_exact); }},
    Column{"Energy\n(ratio to\nExact)", "Elastic energy over that of Exact ChainMail; n/a if that is 0",
           [](auto& one) { return one.errors.energy_over_exact; }},
    Column{"Quartiles\n(ms per\nmove)", "Lower and upper quartile of the repetitions (ms per move)",
           [](auto& one) { return std::optional(one.ms_per_move.lower_quartile); },
           [](auto& one) {
             return report::figure(one.ms_per_move.lower_quartile) + " – " +
                    report::figure(one.ms_per_move.upper_quartile);
           }},
    Column{"Moved\n(sum over\nmoves)",
           "Elements moved, added up over all moves: an element counts once for each move. Without the handle",
           [](auto& one) { return std::optional(double(one.moved)); },
           [](auto& one) { return report::thousands(one.moved); }},
    Column{"Float to\ndouble\n(mean rest\nlengths)",
           "Largest distance between the contestant in float and in double, in mean rest lengths",
           [](auto& one) { return std::optional(one.errors.float_to_double.max); }},
};

}  // namespace

QString shortName(std::string_view label) {
  QString name = text(label);
  return name.startsWith(QStringLiteral("3D ")) ? name : name.remove(QStringLiteral(" ChainMail"));
}

ReportTable::ReportTable() : QTableWidget(0, int(columns.size()) + 1) {
  setObjectName(QStringLiteral("reportTable"));
  setAccessibleName(QStringLiteral("Table of times and errors"));
  setToolTip(QStringLiteral("Click a column header to sort by it; point at it for an explanation"));
  setSelectionBehavior(SelectRows);
  setAlternatingRowColors(true);
  setShowGrid(false);
  setIconSize({tableMarkSize, tableMarkSize});
  verticalHeader()->hide();
  verticalHeader()->setDefaultSectionSize(21);
  verticalHeader()->setMinimumSectionSize(21);
  auto* contestant = new QTableWidgetItem(QStringLiteral("Algorithm"));
  contestant->setToolTip(QStringLiteral("Algorithm, and relaxation after each move"));
  setHorizontalHeaderItem(0, contestant);
  for (std::size_t i = 0; i < columns.size(); ++i) {
    auto* head = new QTableWidgetItem(QLatin1String(columns[i].head));
    head->setToolTip(QLatin1String(columns[i].help));
    setHorizontalHeaderItem(int(i) + 1, head);
  }
  horizontalHeader()->setHighlightSections(false);
  sortByColumn(1, Qt::AscendingOrder);  // the fastest first
  connect(horizontalHeader(), &QHeaderView::sortIndicatorChanged, this, &ReportTable::fitColumns);
  fitColumns();
}

/// Makes the columns as narrow as their texts. Qt would make room for the mark of sorting in all of them.
void ReportTable::fitColumns() {
  const QFontMetrics letters = horizontalHeader()->fontMetrics();
  for (int column = 0; column < columnCount(); ++column) {
    int head = 0;
    for (const QString& line : horizontalHeaderItem(column)->text().split(QLatin1Char('\n'))) {
      head = std::max(head, letters.horizontalAdvance(line));
    }
    const int mark = column == horizontalHeader()->sortIndicatorSection() ? 2 * sortMarkWidth : 0;
    setColumnWidth(column, std::max(head + headMargin + mark, sizeHintForColumn(column)));
  }
}

int ReportTable::fullWidth() const {
  return horizontalHeader()->length() + verticalScrollBar()->sizeHint().width() + 2 * frameWidth();
}

void ReportTable::show(const report::DragResult& drag) {
  setSortingEnabled(false);  // rows would move while they are filled
  setRowCount(0);
  for (const report::Entry& entry : drag.entries) {
    if (!entry.measurement) {
      continue;
    }
    const int row = rowCount();
    insertRow(row);
    auto* name = new QTableWidgetItem(QIcon(plotMark(entry.contestant.algorithm, !entry.contestant.relaxing().is_none(),
                                                     tableMarkSize, devicePixelRatioF(), QGuiApplication::palette())),
                                      shortName(report::label(entry.contestant)));
    name->setFlags(Qt::ItemIsEnabled | Qt::ItemIsSelectable);
    setItem(row, 0, name);
  }
  for (std::size_t i = 0; i < columns.size(); ++i) {
    showColumn(drag, int(i));
  }
  setSortingEnabled(true);
  fitColumns();
}

void ReportTable::showColumn(const report::DragResult& drag, int column) {
  const Column& shown = columns[std::size_t(column)];
  std::vector<std::string> cells;
  std::vector<std::optional<double>> numbers;
  for (const report::Entry& entry : drag.entries) {
    if (entry.measurement) {
      numbers.push_back(shown.number(*entry.measurement));
      cells.push_back(shown.words != nullptr ? shown.words(*entry.measurement) : report::figure(numbers.back()));
    }
  }
  cells = report::aligned(std::move(cells));
  for (std::size_t row = 0; row < cells.size(); ++row) {
    setItem(int(row), column + 1, new FigureItem(text(cells[row]), numbers[row]));
  }
}

}  // namespace chainmail
