// Tests the frame rate over time in a real window.

#include <QComboBox>
#include <QDeadlineTimer>
#include <QFile>
#include <QLabel>
#include <QTemporaryDir>
#include <functional>

#include "docks/frame_rate_dock.h"
#include "document/edits.h"
#include "report/table/format.h"
#include "window.h"
#include "window/bars.h"

namespace chainmail::window_rate {

namespace {

struct RateBench : Workbench {
  RateBench() : Workbench(generate({MeshKind::grid, {9, 7, 1}, 1, {}})) {}

  FrameRateDock& dock() { return *window.findChild<FrameRateDock*>(); }
  const report::Plot& plot() { return find<PlotWidget>("ratePlot")->plot(); }
  double end() { return plot().x.ends->back(); }
  void shake() {
    const QPoint from = place(0, 31);
    QList<QPoint> there{from};
    for (int i = 0; i < 12; ++i) {
      there << from + QPoint(i % 2 == 0 ? 120 : 0, -60);
    }
    stroke(0, there);
  }
  /// Drags until `met` returns true. The dock reads its figures five times per second while there are passes.
  bool shakeUntil(const std::function<bool()>& met) {
    for (const QDeadlineTimer limit(20'000); !met() && !limit.hasExpired();) {
      shake();
      QCoreApplication::processEvents();
    }
    return met();
  }
  bool shakeUntilSampled(std::size_t panel) {
    return shakeUntil([&] { return points(panel).size() > 3; });
  }
  bool shakeUntilShown() {
    return shakeUntil([&] { return find<QLabel>("painted0")->text().toInt() > 0; });
  }
  void set(const char* box, const QVariant& data) {
    auto* field = find<QComboBox>(box);
    field->setCurrentIndex(field->findData(data));
    emit field->activated(field->currentIndex());
  }
  /// Returns the points of a panel's lines.
  QPolygonF points(std::size_t panel) {
    QPolygonF all;
    for (const report::PlotCurve& curve : plot().panels.front().curves) {
      for (const auto& [x, y] : curve.points) {
        curve.series == panel ? all << QPointF(x, y) : all;
      }
    }
    return all;
  }
  void rest() { QTRY_COMPARE(find<QLabel>("painted0")->text(), QStringLiteral("idle")); }
};

QByteArray bytesOf(const QString& path) {
  QFile file(path);
  return file.open(QIODevice::ReadOnly) ? file.readAll() : QByteArray();
}

}  // namespace

class WindowRate : public QObject {
  Q_OBJECT

 private slots:
  void init() {
    failOnWarnings();
    QSettings().clear();
  }

  /// The next window begins with what was chosen.
  void whatIsChosenIsPlottedAtOnce() {
    for (const bool isFirst : {true, false}) {
      RateBench bench;
      const auto length = [&] { return bench.end() - bench.plot().x.ends->front(); };
      const auto title = [&] { return QString::fromStdString(bench.plot().title); };
      QTRY_COMPARE(length(), isFirst ? 10.0 : 60.0);
      QCOMPARE(title(),
               isFirst ? QStringLiteral("Time of a pass (ms)") : QStringLiteral("Painted frames per second (1/s)"));
      bench.set("rateSpan", 60);
      QCOMPARE(length(), 60.0);
      bench.set("rateQuantity", QStringLiteral("painted"));
      QCOMPARE(title(), QStringLiteral("Painted frames per second (1/s)"));
    }
  }

  void aPlotStandsStillWhereItIsPausedOrNothingHappens() {
    RateBench bench;
    QVERIFY(bench.shakeUntilShown());
    bench.rest();
    const QList<QTimer*> readings = bench.dock().findChildren<QTimer*>(QString(), Qt::FindDirectChildrenOnly);
    QVERIFY(!readings.isEmpty());
    const auto isRead = [&] { return std::ranges::any_of(readings, &QTimer::isActive); };
    QTRY_VERIFY(!isRead());
    bench.settleFigures();
    QTRY_VERIFY(!isRead());  // nor does a last frame start the timer again
    const auto before = bench.points(0);
    const double to = bench.end();
    bench.settle();
    QVERIFY(!isRead());
    QCOMPARE(bench.end(), to);
    bench.trigger("pauseRates");
    QVERIFY(bench.shakeUntilShown());
    bench.rest();
    QCOMPARE(bench.points(0), before);
    QCOMPARE(bench.end(), to);
    bench.trigger("pauseRates");
    QVERIFY(bench.shakeUntilShown());
    bench.rest();
    QVERIFY(bench.end() > to);
    QVERIFY(bench.points(0) != before);
  }

  void theTableHoldsAllQuantitiesExactly() {
    const QTemporaryDir folder;
    const QString path = folder.filePath(QStringLiteral("rates.csv"));
    RateBench bench;
    bench.shake();
    const double ms = bench.document().solvers().frame(0)->statistics.last_pass_ms;
    bench.rest();
    QCOMPARE(bench.points(0).last().y(), ms);
    checkThatTheCursorReads(bench, ms);
    QVERIFY(std::uint64_t(bench.points(0).size()) <= bench.document().solvers().frame(0)->statistics.passes);
    bench.dock().saveTablePath(path);
    const QList<QByteArray> rows = bytesOf(path).trimmed().split('\n');
    QVERIFY(rows[0].startsWith("time_s,panel,algorithm,painted_per_s,passes_per_s,pass_ms,"));
    double time = 0;
    bool found = false;
    for (const QByteArray& row : rows.mid(1)) {
      const QList<QByteArray> fields = row.split(',');
      QCOMPARE(fields.size(), rows[0].split(',').size());
      QVERIFY(fields[0].toDouble() >= time);
      time = fields[0].toDouble();
      found = found || (fields[1] == "A" && fields[2] == "generalized" && fields[5].toDouble() == ms);
      // The painted rate is always present; times of the solver only if there was a pass.
      QVERIFY(!fields[3].isEmpty());
      QCOMPARE(fields[4].isEmpty(), fields[5].isEmpty());
    }
    QVERIFY(found);
  }

 private:
  static void checkThatTheCursorReads(RateBench& bench, double ms) {
    auto& plot = *bench.find<PlotWidget>("ratePlot");
    QStringList readings;
    for (int x = 0; x < plot.width(); ++x) {
      readings << plot.readingAt(QPointF(x, plot.height() / 2)).split(QLatin1Char('\n'));
    }
    QVERIFY2(readings.contains(QString::fromStdString(plot.plot().series[0].label + ": " + report::figure(ms) + " ms")),
             qPrintable(readings.join(QLatin1Char('|'))));
    QVERIFY(plot.readingAt(QPointF(0, 0)).isEmpty());  // outside the axes
  }
};

CHAINMAIL_WINDOW_TEST(WindowRate)

}  // namespace chainmail::window_rate

#include "window_rate.moc"
