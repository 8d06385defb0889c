#pragma once

#include "common/plot_widget.h"
#include "docks/report/report_dock.h"
#include "docks/report/report_results.h"
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
  const std::vector<report::PlotMark>& marks() { return plot().plot().panels.front().marks; }
  QString cell(const QString& contestant, int column) {
    for (int row = 0; row < table().rowCount(); ++row) {
      if (table().item(row, 0)->text() == contestant) {
        return table().item(row, column)->text().trimmed();  // spaces align the digits
      }
    }
    return {};
  }
};

// Columns of the table.
constexpr int msColumn = 1, violationColumn = 2;

}  // namespace chainmail
