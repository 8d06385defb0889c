#include "docks/report/report_results.h"

#include <QDialog>
#include <QDialogButtonBox>
#include <QDir>
#include <QFormLayout>
#include <QResizeEvent>
#include <QVBoxLayout>
#include <algorithm>
#include <numeric>

#include "common/as_path.h"
#include "common/colours.h"
#include "common/describe.h"
#include "common/number_field.h"
#include "common/plot_widget.h"
#include "common/text.h"
#include "files/results/results_json.h"
#include "files/text/outputs.h"
#include "io/questions.h"
#include "mesh/error.h"
#include "report/page/plots.h"
#include "report/page/report.h"
#include "report/page/svg.h"

namespace chainmail {
namespace {

constexpr int narrowestPlot = 420;    // beside a table whose columns are not cut (pixels)
constexpr double widestColumn = 2.4;  // ratio of width to height up to which the table is below the plot
constexpr int allDrags = -1;          // stands for the index of a drag

/// A file of a report.
struct ReportFile {
  std::string name;
  Outputs::Writer write;
};

std::vector<ReportFile> filesOf(const report::Results& results) {
  std::vector<ReportFile> files{{"report.html", [&](std::ostream& out) { report::write_html(out, results); }},
                                {"report.json", [&](std::ostream& out) { write_json(out, results); }},
                                {"report.csv", [&](std::ostream& out) { report::write_csv(out, results); }}};
  for (report::PlotFile& one : report::plots_of(results)) {
    files.push_back({one.name, [plot = std::move(one.plot)](std::ostream& out) {
                       report::write_svg(out, plot, report::file_ink);
                     }});
  }
  return files;
}

/// Returns the results of one drag alone, or of all.
report::Results only(report::Results results, int drag) {
  if (drag != allDrags) {
    auto& drags = results.objects.front().drags;
    drags = {drags[std::size_t(drag)]};
    std::erase_if(results.rows, [&](const report::Row& row) { return row.drag != std::size_t(drag); });
    std::ranges::for_each(results.rows, [](report::Row& row) { row.drag = 0; });
  }
  return results;
}

/// Returns each reason for a refusal once, with the names of the refused contestants, and why errors are missing.
QString refusalsOf(const report::Results& shown) {
  QStringList reasons, lines;
  QMap<QString, QStringList> refused;
  for (const report::Row& row : shown.rows) {
    const QString reason = text(row.refusal), name = text(label(report::curve_of(row.contestant)));
    if (!reason.isEmpty() && !refused.contains(reason)) {
      reasons << reason;
    }
    if (!reason.isEmpty() && !refused[reason].contains(name)) {
      refused[reason] << name;
    }
  }
  for (const QString& reason : reasons) {
    lines << QStringLiteral("%1: refused. %2").arg(refused[reason].join(QStringLiteral(", ")), reason);
  }
  const report::ObjectInfo& object = shown.objects.front();
  for (const report::DragInfo& drag : object.drags) {
    if (!drag.no_reference.empty()) {
      lines << QStringLiteral("No distances to %1 in '%2': %3")
                   .arg(text(object.reference), text(drag.name), text(drag.no_reference));
    }
  }
  return lines.join(QLatin1Char('\n'));
}

QString headingOf(const report::Results& shown) {
  const report::ObjectInfo& object = shown.objects.front();
  const report::DragInfo* drag = object.drags.size() == 1 ? &object.drags.front() : nullptr;
  const QString what =
      drag == nullptr ? QStringLiteral("means of %1").arg(counted(object.drags.size(), QStringLiteral("drag")))
                      : text(drag->description) + QStringLiteral("; ") + counted(drag->moves, QStringLiteral("move"));
  return QStringLiteral("%1, %2%3; %4")
      .arg(text(object.name), counted(object.elements, QStringLiteral("element")),
           shown.stopped ? QStringLiteral("; stopped") : QString(), what);
}

/// Returns the plots of some drags that show something, with their names.
std::vector<std::pair<QString, report::Plot>> plotsOf(const report::Results& shown) {
  std::vector<std::pair<QString, report::Plot>> plots;
  const auto add = [&](const std::string& name, report::Plot plot) {
    QString words = text(name);
    words[0] = words[0].toUpper();
    for (report::PlotSeries& series : plot.series) {
      series.label = shortName(series.label).toStdString();
    }
    plots.emplace_back(words, std::move(plot));
  };
  if (shown.kind == report::ReportKind::compare) {
    std::vector<std::size_t> drags(shown.objects.front().drags.size());
    std::iota(drags.begin(), drags.end(), std::size_t{0});
    for (const report::Figure* error : report::plotted_errors()) {
      add(std::string(error->heading) + " " + std::string(error->group), error_plot(shown, 0, drags, *error));
    }
    return plots;
  }
  for (const report::SpeedAgainstError& speed : report::speeds_against_error()) {
    if (report::Plot plot = report::speed_plot(shown, {0}, speed); !report::is_empty(plot)) {
      add(std::string(speed.what), std::move(plot));
    }
  }
  return plots;
}

/// Fills a list, and chooses the entry that was chosen before, else the first one.
void fill(QComboBox& box, const std::vector<std::pair<QString, int>>& entries) {
  const QSignalBlocker block(&box);
  const QString before = box.currentText();
  box.clear();
  for (const auto& [name, value] : entries) {
    box.addItem(name, value);
  }
  box.setCurrentIndex(std::max(0, box.findText(before)));
  box.setEnabled(box.count() > 1);
}

/// Asks for the size of a saved plot. Returns false if the user cancels.
bool askSize(QWidget& window, PlotSize& size) {
  QDialog dialog(&window);
  dialog.setObjectName(QStringLiteral("plotSize"));
  dialog.setWindowTitle(QStringLiteral("Size of the plot"));
  auto* form = new QFormLayout(&dialog);
  const auto add = [&](const char* name, const QString& label, double value, std::pair<double, double> limits,
                       const QString& suffix) {
    auto* field = new NumberField(label);
    describe(field, name, label, QStringLiteral("A column of a paper is about 88 mm wide. Only PNG has dots"));
    field->setDecimals(0);
    field->setRange(limits.first, limits.second);
    field->setSuffix(suffix);
    field->setValue(value);
    form->addRow(label, field);
    return field;
  };
  const auto* width = add("plotWidth", QStringLiteral("Width"), size.widthMm, {20, 300}, QStringLiteral(" mm"));
  const auto* height = add("plotHeight", QStringLiteral("Height"), size.heightMm, {20, 300}, QStringLiteral(" mm"));
  const auto* dots = add("plotDots", QStringLiteral("Resolution"), size.dotsPerInch, {50, 600}, QStringLiteral(" dpi"));
  auto* buttons = new QDialogButtonBox(QDialogButtonBox::Ok | QDialogButtonBox::Cancel);
  QObject::connect(buttons, &QDialogButtonBox::accepted, &dialog, &QDialog::accept);
  QObject::connect(buttons, &QDialogButtonBox::rejected, &dialog, &QDialog::reject);
  form->addRow(buttons);
  if (dialog.exec() != QDialog::Accepted) {
    return false;
  }
  size = {width->value(), height->value(), int(dots->value())};
  return true;
}

}  // namespace

ReportResults::ReportResults()
    : heading_(new QLabel),
      drag_(new QComboBox),
      error_(new QComboBox),
      all_(new QCheckBox(QStringLiteral("All figures"))),
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
  const QString refused = QStringLiteral("Refused contestants, with the reason");
  describe(refusals_, "reportRefusals", refused, refused);
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

/// Sets the table beside the plot where there is room for both, otherwise below it.
void ReportResults::resizeEvent(QResizeEvent* event) {
  const QSize size = event->size();
  const bool isWide = size.width() > widestColumn * size.height() && size.width() > tableWidth() + narrowestPlot;
  split_->setOrientation(isWide ? Qt::Horizontal : Qt::Vertical);
  QWidget::resizeEvent(event);
}

QWidget* ReportResults::makePlot() {
  describe(plot_, "reportPlot", QStringLiteral("Plot of time against error"),
           QStringLiteral("Time against the error: left is faster, down is better. Point at a mark to see its values"));
  describe(legend_, "reportLegend", QStringLiteral("Legend of the plot"),
           QStringLiteral("Colour and shape show the algorithm; bars are the quartiles of the time"));
  auto* both = new QWidget;
  auto* row = new QHBoxLayout(both);
  row->setContentsMargins(0, 0, 0, 0);
  row->addWidget(plot_, 1);
  row->addWidget(legend_, 0, Qt::AlignVCenter);
  return both;
}

QLayout* ReportResults::makeBar() {
  describe(heading_, "reportHeading", QStringLiteral("Compared object and drag"), {});
  heading_->setTextFormat(Qt::PlainText);
  heading_->setSizePolicy(QSizePolicy::Ignored, QSizePolicy::Preferred);  // a long name does not widen the dock
  describe(drag_, "reportDrag", QStringLiteral("Drag shown"), QStringLiteral("Drag that the plot and the table show"));
  describe(error_, "reportError", QStringLiteral("Plot shown"),
           QStringLiteral("Error, or time, that the plot shows; both are means over the drags shown"));
  describe(all_, "reportAllFigures", all_->text(),
           QStringLiteral("Shows all figures in the table, not only the main ones"));
  describe(savePlot_, "reportSavePlot", QStringLiteral("Save the plot"),
           QStringLiteral("Saves the plot with its legend as SVG, PDF or PNG, in a size for a page"));
  describe(save_, "reportSave", QStringLiteral("Save the report"),
           QStringLiteral("Writes report.html, report.json, report.csv and the plots with all drags into a folder"));
  auto* bar = new QHBoxLayout;
  bar->addWidget(drag_);
  bar->addWidget(error_);
  bar->addWidget(all_);
  bar->addStretch();
  bar->addWidget(savePlot_);
  bar->addWidget(save_);
  connect(drag_, &QComboBox::currentIndexChanged, this, &ReportResults::showDrag);
  connect(error_, &QComboBox::currentIndexChanged, this, &ReportResults::showPlot);
  connect(all_, &QCheckBox::toggled, table_, &ReportTable::showAll);
  connect(savePlot_, &QPushButton::clicked, this, &ReportResults::askWherePlot);
  connect(save_, &QPushButton::clicked, this, &ReportResults::save);
  return bar;
}

void ReportResults::show(const ReportThread::Results& results) {
  results_ = results;
  std::vector<std::pair<QString, int>> entries;
  if (results->kind == report::ReportKind::physics) {
    entries.emplace_back(QStringLiteral("all drags"), allDrags);
  }
  int index = 0;
  for (const report::DragInfo& drag : results->objects.front().drags) {
    entries.emplace_back(text(drag.name), index++);
  }
  fill(*drag_, entries);
  showDrag();
}

void ReportResults::showDrag() {
  if (results_ == nullptr) {
    return;
  }
  const report::Results shown = only(*results_, drag_->currentData().toInt());
  heading_->setText(headingOf(shown));
  heading_->setToolTip(heading_->text());
  plots_ = plotsOf(shown);
  std::vector<std::pair<QString, int>> names;
  for (const auto& [name, plot] : plots_) {
    names.emplace_back(name, int(names.size()));
  }
  fill(*error_, names);
  showPlot();
  table_->show(shown);
  const QString refusals = refusalsOf(shown);
  refusals_->setText(refusals);
  refusals_->setVisible(!refusals.isEmpty());
}

void ReportResults::showPlot() {
  const report::Plot plot = plots_.empty() ? report::Plot() : plots_[std::size_t(error_->currentIndex())].second;
  legend_->show(plot);
  plot_->show(plot);
  savePlot_->setEnabled(!report::is_empty(plot));
}

void ReportResults::save() {
  const QString folder = askFolder(*this, QStringLiteral("Folder for the report"));
  if (!folder.isEmpty()) {
    askAndSaveTo(folder);
  }
}

void ReportResults::askAndSaveTo(const QString& folder) {
  QStringList present;
  for (const ReportFile& file : filesOf(*results_)) {
    if (QFileInfo::exists(QDir(folder).filePath(text(file.name)))) {
      present << text(file.name);
    }
  }
  if (present.isEmpty() || askBeforeReplacing(*this, folder, present)) {
    saveTo(folder);
  }
}

/// Writes all files, or none of them.
void ReportResults::saveTo(const QString& folder) {
  try {
    Outputs outputs;
    for (const ReportFile& file : filesOf(*results_)) {
      outputs.add(asPath(folder) / file.name, file.write);
    }
    outputs.commit();
    emit saved(folder + QStringLiteral("/report.html, .json, .csv and the plots"));
  } catch (const Error& error) {
    emit failed(QString::fromStdString(error.what()));
  }
}

void ReportResults::askWherePlot() {
  if (!askSize(*this, size_)) {
    return;
  }
  const QString path = askWhere(*this, QStringLiteral("Save plot"), plotFilters(),
                                asFileName(text(results_->objects.front().name)) + QStringLiteral("-plot"));
  if (!path.isEmpty()) {
    savePlotTo(path, size_);
  }
}

void ReportResults::savePlotTo(const QString& path, const PlotSize& size) {
  try {
    savePlot(plot_->plot(), path, size);
    emit saved(path);
  } catch (const Error& error) {
    emit failed(QString::fromStdString(error.what()));
  }
}

}  // namespace chainmail
