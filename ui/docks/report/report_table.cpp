#include "docks/report/report_table.h"

#include <QGuiApplication>
#include <QHeaderView>
#include <QScrollBar>
#include <algorithm>
#include <limits>

#include "common/describe.h"
#include "common/plot_pictures.h"
#include "common/text.h"
#include "report/page/tables.h"
#include "report/table/format.h"
#include "report/table/summary.h"

namespace chainmail {
namespace {

// In logical pixels.
constexpr int tableMarkSize = 13;
constexpr int headMargin = 14;         // both sides of the text of a header
constexpr int sortMarkWidth = 15;      // on each side, so that the text stays in the middle
constexpr qsizetype headLetters = 12;  // of a line of a header, if its words are not longer

/// A cell that is sorted by its number, not by its text. Cells without a number come last.
class FigureItem : public QTableWidgetItem {
 public:
  FigureItem(const QString& words, double number) : QTableWidgetItem(words) {
    setData(Qt::UserRole, number);
    setTextAlignment(Qt::AlignRight | Qt::AlignVCenter);
    setFlags(Qt::ItemIsEnabled | Qt::ItemIsSelectable);
  }
  bool operator<(const QTableWidgetItem& other) const override {
    return data(Qt::UserRole).toDouble() < other.data(Qt::UserRole).toDouble();
  }
};

/// A time is written with a unit that fits.
bool isTime(const report::Figure& figure) { return figure.unit == "ms"; }

std::string cellOf(const report::Figure& figure, const report::Row& row) {
  return isTime(figure) && row[figure] ? report::time_in_words(*row[figure]) : report::cell_of(figure, row);
}

QString headOf(const report::Figure& figure) {
  QString words = text(figure.group) + QLatin1Char(' ') + text(figure.heading);
  words[0] = words[0].toUpper();
  words += isTime(figure) ? QString() : text(report::in_brackets(figure));
  QStringList lines;
  for (const QString& word : words.split(QLatin1Char(' '))) {
    if (!lines.isEmpty() && lines.last().size() + 1 + word.size() <= headLetters) {
      lines.last() += QLatin1Char(' ') + word;
    } else {
      lines << word;
    }
  }
  return lines.join(QLatin1Char('\n'));
}

QString helpOf(const report::Figure& figure) {
  const QString what = text(figure.definition.empty() ? std::string(figure.heading) : report::definition_of(figure));
  return what + (figure.over_drags == report::OverDrags::worst ? QStringLiteral(".\nOver several drags: the worst")
                                                               : QStringLiteral(".\nOver several drags: the mean"));
}

/// Returns the figures of a contestant over the drags. Of drags with a cut, only the time after it counts if there are
/// others.
report::Joined joinedOf(const report::Results& results, const report::Contestant& contestant) {
  using namespace report;
  Joined cut = joined(results, 0, contestant, Drags::cut);
  Joined all = joined(results, 0, contestant, Drags::uncut);
  if (all.of == 0) {
    return cut;
  }
  if (const Value* ms = cut.row.find(figures::after_cut_ms)) {
    all.row.figures.emplace_back(&figures::after_cut_ms, *ms);
  }
  return all;
}

}  // namespace

QString shortName(std::string_view label) {
  QString name = text(label);
  return name.startsWith(QStringLiteral("3D ")) ? name : name.remove(QStringLiteral(" ChainMail"));
}

ReportTable::ReportTable() : QTableWidget(0, 1) {
  describe(this, "reportTable", QStringLiteral("Table of times and errors"),
           QStringLiteral("Click a column header to sort by it; point at it for an explanation"));
  setSelectionBehavior(SelectRows);
  setAlternatingRowColors(true);
  setShowGrid(false);
  setIconSize({tableMarkSize, tableMarkSize});
  verticalHeader()->hide();
  verticalHeader()->setDefaultSectionSize(21);
  verticalHeader()->setMinimumSectionSize(21);
  auto* contestant = new QTableWidgetItem(QStringLiteral("Contestant"));
  contestant->setToolTip(QStringLiteral("Algorithm, and relaxation after each move"));
  setHorizontalHeaderItem(0, contestant);
  horizontalHeader()->setHighlightSections(false);
  connect(horizontalHeader(), &QHeaderView::sortIndicatorChanged, this, &ReportTable::fitColumns);
  setFigures({});
}

/// Makes a column for each figure of the results, first those that a reader needs first.
void ReportTable::setFigures(const report::Results& results) {
  std::vector<const report::Figure*> shown = report::first_figures(results.kind);
  const auto present = report::figures_in(results, 0);
  if (!present.empty()) {
    std::erase_if(shown, [&](const auto* one) { return std::ranges::count(present, one) == 0; });
  }
  first_ = int(shown.size());
  std::ranges::copy_if(present, std::back_inserter(shown), [&](const auto* one) {
    return std::find(shown.begin(), shown.begin() + first_, one) == shown.begin() + first_;
  });
  if (shown != figures_) {
    figures_ = shown;
    setColumnCount(int(figures_.size()) + 1);
    for (std::size_t i = 0; i < figures_.size(); ++i) {
      auto* head = new QTableWidgetItem(headOf(*figures_[i]));
      head->setData(Qt::UserRole, text(figures_[i]->key));
      head->setToolTip(helpOf(*figures_[i]));
      setHorizontalHeaderItem(int(i) + 1, head);
    }
    sortByColumn(1, Qt::AscendingOrder);  // the fastest or the closest first
  }
  showAll(all_);
}

void ReportTable::showAll(bool all) {
  all_ = all;
  for (int column = 1; column < columnCount(); ++column) {
    setColumnHidden(column, !all && column > first_);
  }
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
    if (!isColumnHidden(column)) {
      setColumnWidth(column, std::max(head + headMargin + mark, sizeHintForColumn(column)));
    }
  }
}

int ReportTable::fullWidth() const {
  return horizontalHeader()->length() + verticalScrollBar()->sizeHint().width() + 2 * frameWidth();
}

void ReportTable::show(const report::Results& results) {
  setSortingEnabled(false);  // rows would move while they are filled
  setRowCount(0);
  setFigures(results);
  std::vector<report::Row> rows;
  for (const report::Contestant& contestant : report::contestants_in(results, 0)) {
    const report::Joined found = joinedOf(results, contestant);
    if (!found.row.has_figures()) {
      continue;
    }
    QString name = shortName(report::label(contestant));
    name += found.drags < found.of ? QStringLiteral(" (%1 of %2 drags)").arg(found.drags).arg(found.of) : QString();
    auto* item = new QTableWidgetItem(name);
    if (contestant.algorithm) {
      item->setIcon(QIcon(plotMark(*contestant.algorithm, contestant.is_relaxed(), tableMarkSize, devicePixelRatioF(),
                                   QGuiApplication::palette())));
    }
    item->setFlags(Qt::ItemIsEnabled | Qt::ItemIsSelectable);
    setRowCount(int(rows.size()) + 1);
    setItem(int(rows.size()), 0, item);
    rows.push_back(found.row);
  }
  for (int column = 1; column < columnCount(); ++column) {
    showColumn(column, rows);
  }
  setSortingEnabled(true);
  fitColumns();
}

void ReportTable::showColumn(int column, const std::vector<report::Row>& rows) {
  const report::Figure& figure = *figures_[std::size_t(column) - 1];
  std::vector<std::string> cells;
  std::ranges::transform(rows, std::back_inserter(cells), [&](const report::Row& row) { return cellOf(figure, row); });
  cells = report::aligned(std::move(cells));
  for (std::size_t i = 0; i < rows.size(); ++i) {
    auto* item = new FigureItem(text(cells[i]), rows[i][figure].value_or(std::numeric_limits<double>::infinity()));
    if (const report::Value* value = rows[i].find(figure); value != nullptr && value->spread) {
      item->setToolTip(QStringLiteral("Median of %1 repetitions; quartiles %2 and %3")
                           .arg(value->spread->count)
                           .arg(text(report::time_in_words(value->spread->lower_quartile)),
                                text(report::time_in_words(value->spread->upper_quartile))));
    }
    setItem(int(i), column, item);
  }
}

}  // namespace chainmail
