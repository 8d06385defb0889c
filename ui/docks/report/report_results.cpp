#include "docks/report/report_results.h"

#include <QCoreApplication>
#include <QDateTime>
#include <QDir>
#include <QGuiApplication>
#include <QHeaderView>
#include <QResizeEvent>
#include <QScrollBar>
#include <QSettings>
#include <QVBoxLayout>
#include <algorithm>
#include <array>
#include <limits>

#include "common/as_path.h"
#include "common/colours.h"
#include "common/plot_painting.h"
#include "common/plot_widget.h"
#include "common/text.h"
#include "files/results/report_json.h"
#include "files/text/outputs.h"
#include "io/questions.h"
#include "mesh/error.h"
#include "report/page/compared_figures.h"
#include "report/table/format.h"
#include "report/page/html.h"

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

constexpr int narrowestPlot = 420;    // beside a table whose columns are not cut (pixels)
constexpr double widestColumn = 2.4;  // ratio of width to height up to which the table is below the plot

constexpr std::array files{"report.html", "report.json", "report.csv"};

/// Writes the three files, or none of them.
void saveReport(const std::filesystem::path& folder, const report::Comparison& comparison) {
  const QString date = QDateTime::currentDateTimeUtc().toString(QStringLiteral("yyyy-MM-dd HH:mm 'UTC'"));
  const report::Origin origin{report::this_machine(), "the Report dock of the workbench, while its window was open",
                              date.toStdString(), "chainmail " + QCoreApplication::applicationVersion().toStdString()};
  Outputs outputs;
  outputs.add(folder / files[0], [&](std::ostream& out) { write_html(out, comparison, origin); });
  outputs.add(folder / files[1], [&](std::ostream& out) { write_json(out, comparison, origin); });
  outputs.add(folder / files[2], [&](std::ostream& out) { write_csv(out, comparison); });
  outputs.commit();
}

/// Returns each reason for a refusal once, with the names of the refused algorithms.
QString refusalsOf(const report::DragResult& drag) {
  QStringList sentences;
  QMap<QString, QStringList> refused;
  for (const report::Entry& entry : drag.entries) {
    if (entry.measurement) {
      continue;
    }
    const QString sentence = text(entry.refusal);
    const QString name = text(info(entry.contestant.algorithm).label);
    if (!sentences.contains(sentence)) {
      sentences << sentence;
    }
    if (!refused[sentence].contains(name)) {
      refused[sentence] << name;
    }
  }
  QStringList lines;
  for (const QString& sentence : sentences) {
    lines << QStringLiteral("%1: refused. %2").arg(refused[sentence].join(QStringLiteral(", ")), sentence);
  }
  if (!drag.no_exact.empty()) {
    lines << QStringLiteral("No distances to Exact ChainMail: %1").arg(text(drag.no_exact));
  }
  return lines.join(QLatin1Char('\n'));
}

/// Returns the name of a contestant without "ChainMail", which all names have; "3D ChainMail" stays.
QString shortName(std::string_view label) {
  QString name = text(label);
  return name.startsWith(QStringLiteral("3D ")) ? name : name.remove(QStringLiteral(" ChainMail"));
}

}  // namespace

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

ReportResults::ReportResults()
    : heading_(new QLabel),
      drag_(new QComboBox),
      error_(new QComboBox),
      savePlot_(new QPushButton(QStringLiteral("Save plot…"))),
      save_(new QPushButton(QStringLiteral("Save report…"))),
      plot_(new PlotWidget(QStringLiteral("No values for this drag"))),
      legend_(new PlotLegend),
      table_(new ReportTable),
      refusals_(new QLabel),
      split_(new QSplitter(Qt::Vertical)) {
  split_->setObjectName(QStringLiteral("reportSplitter"));
  split_->setChildrenCollapsible(false);
  split_->addWidget(makePlot());
  split_->addWidget(table_);
  split_->setSizes({1000, 1000});  // equal shares
  refusals_->setObjectName(QStringLiteral("reportRefusals"));
  refusals_->setAccessibleName(QStringLiteral("Refused algorithms, with the reason"));
  refusals_->setToolTip(refusals_->accessibleName());
  refusals_->setTextFormat(Qt::PlainText);
  refusals_->setTextInteractionFlags(Qt::TextSelectableByMouse);
  refusals_->setWordWrap(true);
  auto* column = new QVBoxLayout(this);
  column->setContentsMargins(0, 0, 0, 0);
  column->setSpacing(4);
  column->addLayout(makeBar());
  column->addWidget(heading_);
  column->addWidget(split_, 1);
  column->addWidget(refusals_);
  followTheme(*this, [this] { showDrag(); });  // the marks depend on the theme
}

int ReportResults::tableWidth() const { return table_->fullWidth(); }

/// Sets the table beside the plot where there is room for both, otherwise below it.
void ReportResults::resizeEvent(QResizeEvent* event) {
  const QSize size = event->size();
  const bool isWide = size.width() > widestColumn * size.height() && size.width() > tableWidth() + narrowestPlot;
  split_->setOrientation(isWide ? Qt::Horizontal : Qt::Vertical);
  QWidget::resizeEvent(event);
}

QWidget* ReportResults::makePlot() {
  plot_->setObjectName(QStringLiteral("reportPlot"));
  plot_->setAccessibleName(QStringLiteral("Plot of time against error"));
  plot_->setToolTip(
      QStringLiteral("Time per move against the error: left is faster, down is better. Point at a mark "
                     "to see its values"));
  legend_->setObjectName(QStringLiteral("reportLegend"));
  legend_->setAccessibleName(QStringLiteral("Legend of the plot"));
  legend_->setToolTip(QStringLiteral("Colour and shape show the algorithm; bars are the quartiles of the time"));
  auto* both = new QWidget;
  auto* row = new QHBoxLayout(both);
  row->setContentsMargins(0, 0, 0, 0);
  row->addWidget(plot_, 1);
  row->addWidget(legend_, 0, Qt::AlignVCenter);
  return both;
}

QLayout* ReportResults::makeBar() {
  const auto name = [](QWidget* widget, const char* object, const QString& accessible, const QString& help) {
    widget->setObjectName(QLatin1String(object));
    widget->setAccessibleName(accessible);
    widget->setToolTip(help);
  };
  name(heading_, "reportHeading", QStringLiteral("Compared object and drag"), {});
  heading_->setTextFormat(Qt::PlainText);
  heading_->setSizePolicy(QSizePolicy::Ignored, QSizePolicy::Preferred);  // a long name does not widen the dock
  name(drag_, "reportDrag", QStringLiteral("Drag shown"), QStringLiteral("Drag that the plot and the table show"));
  name(error_, "reportError", QStringLiteral("Error shown"), QStringLiteral("Error that the plot shows against time"));
  name(savePlot_, "reportSavePlot", QStringLiteral("Save the plot"),
       QStringLiteral("Saves the plot with its legend as SVG, PDF or PNG"));
  name(save_, "reportSave", QStringLiteral("Save the report"),
       QStringLiteral("Writes report.html, report.json and report.csv with all drags into a folder"));
  for (const report::PlottedError& error : report::plotted_errors()) {
    QString sentence = text(error.name);
    sentence[0] = sentence[0].toUpper();
    error_->addItem(sentence);
  }
  auto* bar = new QHBoxLayout;
  bar->addWidget(drag_);
  bar->addWidget(error_);
  bar->addStretch();
  bar->addWidget(savePlot_);
  bar->addWidget(save_);
  connect(drag_, &QComboBox::currentIndexChanged, this, &ReportResults::showDrag);
  connect(error_, &QComboBox::currentIndexChanged, this, &ReportResults::showDrag);
  connect(savePlot_, &QPushButton::clicked, this, &ReportResults::askWherePlot);
  connect(save_, &QPushButton::clicked, this, &ReportResults::save);
  return bar;
}

void ReportResults::show(const ReportThread::Result& result) {
  result_ = result;
  const report::CaseResult& object = result->cases.front();
  {
    const QSignalBlocker block(drag_);
    drag_->clear();
    for (const report::DragResult& drag : object.drags) {
      drag_->addItem(text(drag.name));
      drag_->setItemData(drag_->count() - 1, text(drag.description), Qt::ToolTipRole);
    }
  }
  drag_->setEnabled(object.drags.size() > 1);
  showDrag();
}

void ReportResults::showDrag() {
  if (result_ == nullptr) {
    return;
  }
  const report::CaseResult& object = result_->cases.front();
  const report::DragResult& drag = object.drags[std::size_t(drag_->currentIndex())];
  heading_->setText(QStringLiteral("%1, %2; %3; %4")
                        .arg(text(object.name), counted(object.elements, QStringLiteral("element")),
                             text(drag.description), counted(drag.moves, QStringLiteral("move"))));
  heading_->setToolTip(heading_->text());
  showPlot(drag);
  table_->show(drag);
  const QString refusals = refusalsOf(drag);
  refusals_->setText(refusals);
  refusals_->setVisible(!refusals.isEmpty());
}

void ReportResults::showPlot(const report::DragResult& drag) {
  report::Plot plot = report::error_plot(drag, report::plotted_errors()[std::size_t(error_->currentIndex())]);
  for (report::PlotSeries& series : plot.series) {
    series.label = shortName(series.label).toStdString();
  }
  const std::vector<int>& sweeps = result_->options.sweeps;
  plot.legend_notes.clear();
  if (std::ranges::count(sweeps, 0) > 0) {
    plot.legend_notes.emplace_back("filled: no sweeps");
  }
  if (const int most = std::ranges::max(sweeps); most > 0) {
    plot.legend_notes.push_back("hollow: " + std::to_string(most) + " sweeps");
  }
  if (result_->options.equilibrium) {
    plot.legend_notes.emplace_back(report::equilibrium_note);
  }
  legend_->show(plot);
  plot_->show(std::move(plot));
}

void ReportResults::save() {
  const QString folder = askFolder(*this, QStringLiteral("Folder for report.html, report.json and report.csv"));
  if (!folder.isEmpty()) {
    askAndSaveTo(folder);
  }
}

void ReportResults::askAndSaveTo(const QString& folder) {
  QStringList present;
  for (const char* file : files) {
    if (QFileInfo::exists(QDir(folder).filePath(QLatin1String(file)))) {
      present << QLatin1String(file);
    }
  }
  if (present.isEmpty() || askBeforeReplacing(*this, folder, present)) {
    saveTo(folder);
  }
}

void ReportResults::saveTo(const QString& folder) {
  try {
    saveReport(asPath(folder), *result_);
    emit saved(folder + QStringLiteral("/report.html, .json and .csv"));
  } catch (const Error& error) {
    emit failed(QString::fromStdString(error.what()));
  }
}

void ReportResults::askWherePlot() {
  const QString path = askWhere(*this, QStringLiteral("Save plot"), plotFilters(),
                                asFileName(text(result_->cases.front().name)) + QStringLiteral("-plot"));
  if (!path.isEmpty()) {
    savePlotTo(path);
  }
}

void ReportResults::savePlotTo(const QString& path) {
  try {
    savePlot(plot_->plot(), path);
    emit saved(path);
  } catch (const Error& error) {
    emit failed(QString::fromStdString(error.what()));
  }
}

}  // namespace chainmail
