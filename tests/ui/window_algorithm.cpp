// Tests the choice of algorithms in a real window, and the texts that describe them.

#include <QLabel>
#include <QStandardItemModel>

#include "document/edits.h"
#include "document/panel_colour.h"
#include "window.h"
#include "window/bars.h"

namespace chainmail::window_algorithm {

namespace {

const QStandardItem& item(Workbench& bench, int panel, const char* label) {
  auto& selector = bench.window.panel(panel).selector();
  return *qobject_cast<QStandardItemModel*>(selector.model())->item(selector.findText(QLatin1String(label)));
}

MeshPointer cloth() { return generate({MeshKind::cloth, {9, 7, 1}, 1, {}}); }

}  // namespace

class WindowAlgorithm : public QObject {
  Q_OBJECT

 private slots:
  void init() { failOnWarnings(); }

  void originalIsOfferedWhereItWorksAndTheSelectorFollowsWhatRuns() {
    Workbench bench;
    QVERIFY(item(bench, 0, "3D ChainMail").isEnabled());
    edits::replaceMesh(bench.document(), cloth(), QStringLiteral("cloth"), QStringLiteral("build cloth"));
    for (int p = 0; p < 2; ++p) {
      QVERIFY(!item(bench, p, "3D ChainMail").isEnabled());
      QVERIFY(item(bench, p, "3D ChainMail").toolTip().contains(QStringLiteral("only on grids")));
      QVERIFY(item(bench, p, "Exact ChainMail").isEnabled());
    }
    bench.document().undoStack().undo();
    QVERIFY(item(bench, 0, "3D ChainMail").isEnabled());

    bench.choose(0, "3D ChainMail");
    QCOMPARE(bench.document().solvers().frame(0)->statistics.algorithm, Algorithm::chainmail_3d);
    edits::replaceMesh(bench.document(), cloth(), QStringLiteral("cloth"), QStringLiteral("build cloth"));
    bench.settle();
    QCOMPARE(bench.document().solvers().frame(0)->statistics.algorithm, Algorithm::natural_queue);
    QCOMPARE(bench.document().algorithm(0), Algorithm::natural_queue);
    QCOMPARE(bench.window.panel(0).selector().currentText(), QStringLiteral("Natural Queue ChainMail"));
    QVERIFY(bench.window.messages().isVisible());
    QVERIFY(bench.window.messages().sentence().contains(QStringLiteral("panel A now runs Natural Queue ChainMail")));
    bench.document().undoStack().undo();
    bench.settle();
    // The selector shows the algorithm that runs, for any mesh.
    QCOMPARE(bench.document().solvers().frame(0)->statistics.algorithm, bench.document().algorithm(0));
  }

  /// The shade of a copy, too, when the other panel runs something else.
  void theSwatchHasTheColourOfTheObject() {
    Workbench bench;
    const auto areRight = [&] {
      for (int p = 0; p < 2; ++p) {
        const QList<QLabel*> labels = bench.window.panel(p).findChildren<QLabel*>();
        const QString wanted = QStringLiteral("background:%1;").arg(QColor(panelColour(bench.document(), p)).name());
        if (std::ranges::none_of(labels, [&](const QLabel* one) { return one->styleSheet().startsWith(wanted); })) {
          return false;
        }
      }
      return true;
    };
    QVERIFY(areRight());
    bench.choose(0, "Generalized ChainMail");
    bench.choose(1, "Generalized ChainMail");
    const QColor copy = panelColour(bench.document(), 1);
    QVERIFY(areRight());
    bench.choose(0, "Exact ChainMail");
    QVERIFY(panelColour(bench.document(), 1) != copy);
    QVERIFY(areRight());
  }

  void exactStopsWhereThePinsHoldTheHandAndSaysSo() {
    Workbench bench(generate({MeshKind::line, {5, 1, 1}, 1, {}}));
    bench.choose(1, "Exact ChainMail");
    edits::setPinned(bench.document(), {0}, true);
    auto* state = bench.find<QLabel>("state1");
    const QPoint from = bench.place(0, 4);
    const int link = bench.place(0, 1).x() - bench.place(0, 0).x();
    bench.stroke(0, {from, from + QPoint(3 * link, 0)}, false);
    bench.settle();
    // Four links of length 1, none longer than 1.2.
    QVERIFY(std::abs(bench.position(1, 4).x() - 4.8) < 1e-5);
    QVERIFY(bench.position(0, 4).x() > 6);
    QTRY_VERIFY(state->toolTip().contains(QStringLiteral("taut: pins stop the handle")));
    QVERIFY(!bench.find<QLabel>("state0")->toolTip().contains(QStringLiteral("taut")));
    QTest::mouseRelease(&bench.view(0), Qt::LeftButton, {}, from);
    bench.settle();
    // Move the handle back to a position where the chain is slack.
    const QPoint there = bench.place(1, 4);
    bench.stroke(1, {there, there - QPoint(link / 2, 0)});
    QTRY_VERIFY(!state->toolTip().contains(QStringLiteral("taut")));
  }
};

CHAINMAIL_WINDOW_TEST(WindowAlgorithm)

}  // namespace chainmail::window_algorithm

#include "window_algorithm.moc"
