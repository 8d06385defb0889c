#pragma once

#include "common/plot_widget.h"
#include "common/text.h"
#include "docks/report/report_dock.h"
#include "docks/report/report_results.h"
#include "document/edits.h"
#include "mesh/layers.h"
#include "window.h"
#include "window/bars.h"

namespace chainmail {

/// The window with the Report dock open; runs are short.
struct ReportBench : Workbench {
  explicit ReportBench(const MeshPointer& mesh = generate({MeshKind::grid, {9, 7, 1}, 1, {}})) : Workbench(mesh) {
    trigger("showReport");
    click("reportCancel");  // of the run that opening it starts
    settle();
    effort(0.1);
  }

  void effort(double seconds) { find<QDoubleSpinBox>("reportSeconds")->setValue(seconds); }
  /// Chooses these rows of a list, and no others.
  void check(const char* list, const QSet<int>& rows) {
    auto* items = find<QListWidget>(list);
    for (int row = 0; row < items->count(); ++row) {
      items->item(row)->setCheckState(rows.contains(row) ? Qt::Checked : Qt::Unchecked);
    }
  }
  void choose(const char* box, int row) { find<QComboBox>(box)->setCurrentIndex(row); }
  void click(const char* button) { QTest::mouseClick(find<QPushButton>(button), Qt::LeftButton); }
  ReportThread& thread() { return *window.findChild<ReportThread*>(); }
  ReportTable& table() { return *find<ReportTable>("reportTable"); }
  ReportResults& results() { return *window.findChild<ReportResults*>(); }
  QString progress() { return find<QProgressBar>("reportProgress")->format(); }

  void run() {
    click("reportRun");
    QVERIFY(thread().running());
    QTRY_VERIFY_WITH_TIMEOUT(!thread().running(), 60'000);
    QVERIFY2(results().isVisible(), qPrintable(window.messages().sentence()));
  }
  void isReady() {
    QVERIFY(!thread().running());
    QVERIFY(find<QPushButton>("reportRun")->isEnabled());
    QVERIFY(!find<QPushButton>("reportCancel")->isEnabled());
    QCOMPARE(progress(), QStringLiteral("ready"));
  }
  /// Starts a run that would take minutes, and waits until it makes progress.
  void runForLong() {
    effort(60);
    click("reportRun");
    QTRY_VERIFY_WITH_TIMEOUT(find<QProgressBar>("reportProgress")->value() > 0, 60'000);
    QVERIFY(thread().atWork());
  }

  PlotWidget& plot() { return *find<PlotWidget>("reportPlot"); }
  QString cellOf(int row, int column) { return table().item(row, column)->text().trimmed(); }  // spaces align digits
  const std::vector<report::PlotMark>& marks() { return plot().plot().panels.front().marks; }
  /// Returns the number of a figure of the first contestant whose name begins so.
  double numberOf(const QString& contestant, const report::Figure& figure) {
    for (int row = 0; row < table().rowCount(); ++row) {
      for (int column = 1; column < table().columnCount(); ++column) {
        if (table().item(row, 0)->text().startsWith(contestant) &&
            table().horizontalHeaderItem(column)->data(Qt::UserRole) == text(figure.key)) {
          return table().item(row, column)->data(Qt::UserRole).toDouble();
        }
      }
    }
    return std::numeric_limits<double>::quiet_NaN();
  }
  QString cell(const QString& contestant, int column) {
    for (int row = 0; row < table().rowCount(); ++row) {
      if (table().item(row, 0)->text() == contestant) {
        return cellOf(row, column);
      }
    }
    return {};
  }
};

/// A bar of 4 × 2 × 2 elements, pinned at its left side.
struct PinnedBench : ReportBench {
  PinnedBench() : ReportBench(generate({MeshKind::tetra, {4, 2, 2}, 1, {}})) {
    edits::setPinned(document(), layer(*document().mesh(), *find_side("left")), true);
    choose("reportAgainst", 1);
  }
};

// Rows of the list of drags.
constexpr int myLastDrag = 0, firstGenerated = 1;

// Columns of the table.
constexpr int msColumn = 1, violationColumn = 2;

}  // namespace chainmail
