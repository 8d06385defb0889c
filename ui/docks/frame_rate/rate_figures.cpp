#include "docks/frame_rate/rate_figures.h"

#include <QGridLayout>
#include <QLocale>
#include <algorithm>
#include <array>
#include <cmath>

#include "common/text.h"
#include "document/panel_colour.h"

namespace chainmail {
namespace {

constexpr int rateColumns = 4;
constexpr std::array rateWidths{54, 58, 52, 52};  // logical pixels; wide enough for the headers and for 1,000,000

}  // namespace

RateFigures::RateFigures(const Document& document) : document_(document) {
  auto* grid = new QGridLayout(this);
  grid->setContentsMargins(0, 0, 0, 0);
  grid->setHorizontalSpacing(3);
  grid->setVerticalSpacing(1);
  addHead(*grid);
  for (int panel = 0; panel < Document::maxPanels; ++panel) {
    addRow(*grid);
  }
  followPanels();
  connect(&document, &Document::panelsChanged, this, &RateFigures::followPanels);
  connect(&document, &Document::algorithmChanged, this, [this](int panel) {
    clear(panel);
    followPanels();  // the colours of other panels may change, too
  });
}

void RateFigures::addHead(QGridLayout& grid) {
  const auto add = [&](int column, const QString& text, const QString& help) {
    auto* label = new QLabel(text);
    label->setAlignment(Qt::AlignRight);
    label->setToolTip(help);
    label->setMinimumWidth(std::max(rateWidths[std::size_t(column)], label->minimumSizeHint().width()));
    grid.addWidget(label, 0, column);
    grid.setColumnStretch(column, 1);
  };
  add(0, QStringLiteral("painted/s"), QStringLiteral("Frames that reached the screen in the last second"));
  add(1, QStringLiteral("passes/s"),
      QStringLiteral("1 over the median time of a pass: the rate of the algorithm without drawing"));
  add(2, QStringLiteral("median"), QStringLiteral("Median time of a pass over the last second"));
  add(3, QStringLiteral("worst"), QStringLiteral("Longest pass of the last second"));
}

/// Adds the row of a panel. The panel's name has its own line, because the four figures need the width.
void RateFigures::addRow(QGridLayout& grid) {
  const int panel = int(rows_.size());
  const auto figure = [&](const char* name, const QString& meaning) {
    auto* label = new QLabel(QStringLiteral("–"));
    label->setObjectName(QStringLiteral("%1%2").arg(QLatin1String(name)).arg(panel));
    label->setAlignment(Qt::AlignRight);
    label->setAccessibleDescription(meaning);
    return label;
  };
  Row row{new QLabel, nullptr, nullptr, nullptr, nullptr};
  row.name->setObjectName(QStringLiteral("rateName%1").arg(panel));
  row.painted = figure("painted", QStringLiteral("Painted frames per second"));
  row.passes = figure("passes", QStringLiteral("Passes per second"));
  row.median = figure("median", QStringLiteral("Median time of a pass"));
  row.worst = figure("worst", QStringLiteral("Longest pass"));
  row.name->setTextFormat(Qt::RichText);
  row.name->setSizePolicy(QSizePolicy::Ignored, QSizePolicy::Preferred);
  const int line = 2 * panel + 1;
  grid.addWidget(row.name, line, 0, 1, rateColumns);
  int column = 0;
  for (QLabel* label : {row.painted, row.passes, row.median, row.worst}) {
    grid.addWidget(label, line + 1, column++);
  }
  rows_.push_back(row);
  followTheme(*row.name, [this, panel] { nameRow(panel); });
}

/// Hides the rows of missing panels.
void RateFigures::followPanels() {
  for (int panel = 0; panel < int(rows_.size()); ++panel) {
    const Row& row = rows_[std::size_t(panel)];
    for (QLabel* label : {row.name, row.painted, row.passes, row.median, row.worst}) {
      label->setVisible(panel < document_.panels());
    }
    nameRow(panel);
  }
}

void RateFigures::nameRow(int panel) {
  const Row& row = rows_[std::size_t(panel)];
  row.name->setText(QStringLiteral("<span style='color:%1'>━━</span> <b>%2</b> %3")
                        .arg(QColor(panelColour(document_, panel)).name(), panelName(panel),
                             text(info(document_.algorithm(panel)).label)));
}

void RateFigures::clear(int panel) {
  const Row& row = rows_[std::size_t(panel)];
  for (QLabel* label : {row.passes, row.median, row.worst}) {
    label->setText(QStringLiteral("–"));
  }
}

void RateFigures::show(int panel, const RateSample& sample) {
  const Row& row = rows_[std::size_t(panel)];
  row.painted->setText(sample.painted > 0 ? QString::number(int(sample.painted)) : QStringLiteral("idle"));
  if (std::isnan(sample.medianMs)) {
    return;
  }
  const double passes = sample.passesPerSecond();
  row.passes->setText(std::isnan(passes) ? QStringLiteral("–") : shownRate(passes));
  row.median->setText(shownTime(sample.medianMs));
  row.worst->setText(shownTime(sample.worstMs));
}

}  // namespace chainmail
