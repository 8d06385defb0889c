#include "docks/size_test/size_test_results.h"

#include <QHeaderView>
#include <QLocale>
#include <QSplitter>
#include <QVBoxLayout>
#include <array>

#include "common/panel_names.h"
#include "common/table_text.h"
#include "common/text.h"
#include "report/page/format.h"

namespace chainmail {
namespace {

constexpr int leading = 2;  // number of columns before those of the panels
constexpr std::array heads{"median\n(ms)", "99th perc.\n(ms)", "painted\n(frames/s)", "real\ntime"};
constexpr std::array helps{"Median time of a pass in the solver (ms)",
                           "99th percentile of the pass times (ms): 99 % of the passes are at most this long. Real "
                           "time means that it is within the limit",
                           "Frames of this panel that reached the screen in the last second of the drags",
                           "'yes' if the 99th percentile is within the limit; 'no' after a second attempt"};

}  // namespace

SizeTestResults::SizeTestResults()
    : verdicts_(new QLabel),
      plot_(new PlotWidget(QStringLiteral("Time of a pass at each size"))),
      table_(new QTableWidget) {
  verdicts_->setTextFormat(Qt::RichText);
  verdicts_->setObjectName(QStringLiteral("sizeTestVerdicts"));
  verdicts_->setAccessibleName(QStringLiteral("Largest size in real time, for each panel"));
  verdicts_->setTextInteractionFlags(Qt::TextSelectableByMouse);
  table_->setObjectName(QStringLiteral("sizeTestTable"));
  table_->setAccessibleName(QStringLiteral("Times at each size"));
  table_->setToolTip(QStringLiteral("One row per size; Ctrl+C copies the table"));
  table_->setEditTriggers(QAbstractItemView::NoEditTriggers);
  table_->setSelectionBehavior(QAbstractItemView::SelectRows);
  table_->setAlternatingRowColors(true);
  table_->verticalHeader()->hide();
  copyByKeys(*table_);
  plot_->setObjectName(QStringLiteral("sizeTestPlot"));
  plot_->setAccessibleName(QStringLiteral("Plot of the time of a pass against the number of elements"));
  plot_->setToolTip(
      QStringLiteral("99 % of the passes are at most this long; the strip is real time. Point at a mark to see its "
                     "values"));
  auto* split = new QSplitter;
  split->setObjectName(QStringLiteral("sizeTestSplitter"));
  split->setChildrenCollapsible(false);
  split->addWidget(plot_);
  split->addWidget(table_);
  split->setStretchFactor(0, 2);
  split->setStretchFactor(1, 3);
  split->setSizes({300, 450});
  auto* column = new QVBoxLayout(this);
  column->setContentsMargins(0, 0, 0, 0);
  column->setSpacing(3);
  column->addWidget(verdicts_);
  column->addWidget(split, 1);
  followTheme(*this, [this] {
    showVerdicts();
    showPlot();
  });
}

void SizeTestResults::begin(const std::vector<SizeTestContestant>& contestants, double budget) {
  contestants_ = contestants;
  budget_ = budget;
  rows_.clear();
  table_->clear();
  table_->setRowCount(0);
  table_->setColumnCount(leading + int(contestants.size() * heads.size()));
  table_->setHorizontalHeaderItem(0, new QTableWidgetItem(QStringLiteral("\nSize")));
  table_->setHorizontalHeaderItem(1, new QTableWidgetItem(QStringLiteral("\nElements")));
  int column = leading;
  for (const SizeTestContestant& one : contestants) {
    for (std::size_t i = 0; i < heads.size(); ++i) {
      const QString name = QString(text(info(one.algorithm).label)).remove(QStringLiteral(" ChainMail"));
      auto* head =
          new QTableWidgetItem(QStringLiteral("%1: %2\n%3").arg(panelName(one.panel), name, QLatin1String(heads[i])));
      head->setToolTip(QLatin1String(helps[i]));
      table_->setHorizontalHeaderItem(column++, head);
    }
  }
  table_->resizeColumnsToContents();
  showPlot();
  setGrowing(true);
}

void SizeTestResults::put(int row, int column, const QString& text, const QString& help) {
  auto* item = new QTableWidgetItem(text);
  item->setTextAlignment(Qt::AlignRight | Qt::AlignVCenter);
  item->setToolTip(help);
  table_->setItem(row, column, item);
}

void SizeTestResults::add(const SizeTestRow& row) {
  const report::RampRow& figures = row.figures;
  if (rows_.empty() || rows_.back().figures.width != figures.width) {
    const int last = table_->rowCount();
    table_->insertRow(last);
    put(last, 0, sizeText(figures.width));
    put(last, 1, QLocale().toString(qulonglong(figures.elements)));
  }
  rows_.push_back(row);
  const int at = table_->rowCount() - 1;
  int column = leading;
  for (const SizeTestContestant& one : contestants_) {
    if (one.panel == row.panel) {
      put(at, column, text(report::figure(figures.median_ms)));
      put(at, column + 1, text(report::figure(figures.p99_ms)),
          figures.repeated ? QStringLiteral("Second attempt with other drags: the first attempt missed the limit")
                           : QString());
      put(at, column + 2, QString::number(row.painted));
      put(at, column + 3, figures.in_real_time ? QStringLiteral("yes") : QStringLiteral("no"));
    }
    column += int(heads.size());
  }
  table_->resizeColumnsToContents();
  table_->scrollToBottom();
  showPlot();
  showVerdicts();
}

void SizeTestResults::setGrowing(bool growing) {
  growing_ = growing;
  showVerdicts();
}

void SizeTestResults::showPlot() { plot_->show(plotOf(contestants_, rows_, budget_)); }

void SizeTestResults::showVerdicts() {
  QStringList lines;
  for (const SizeTestContestant& one : contestants_) {
    lines << QStringLiteral("<span style='color:%1'>━━</span> <b>%2: %3</b>: %4")
                 .arg(QColor(one.colour).name(), panelName(one.panel), text(info(one.algorithm).label),
                      verdictText(one));
  }
  verdicts_->setText(lines.join(QStringLiteral("<br>")));
}

QString SizeTestResults::verdictText(const SizeTestContestant& contestant) const {
  const report::RampVerdict verdict = verdictOf(contestant, rows_);
  if (!verdict.largest_width) {
    return verdict.lost ? QStringLiteral("never in real time")
           : growing_   ? QStringLiteral("not measured yet")
                        : QStringLiteral("not measured; press Size test");
  }
  const std::uint32_t width = *verdict.largest_width;
  const QString upTo =
      QStringLiteral("real time up to %1, %L2 elements").arg(sizeText(width)).arg(qulonglong(width) * width);
  return verdict.lost ? upTo : upTo + (growing_ ? QStringLiteral(" so far") : QStringLiteral(" or more"));
}

}  // namespace chainmail
