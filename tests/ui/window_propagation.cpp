// Tests passes in single steps in a real window.

#include <QAction>
#include <QCheckBox>
#include <QComboBox>
#include <QDockWidget>
#include <QLabel>
#include <QSlider>
#include <QTreeView>

#include "common/colours.h"
#include "document/edits.h"
#include "document/panel_colour.h"
#include "drawing/colour_map.h"
#include "window.h"

namespace chainmail::window_propagation {

namespace {

constexpr ElementId middle = 31;  // of 9 x 7
constexpr int alike = 60;         // of 255: a line of one or two pixels is blended with the background

QSlider& slider(Workbench& bench, int panel) {
  return *bench.find<QSlider>(qPrintable(QStringLiteral("propagationStep%1").arg(panel)));
}

/// Opens the dock and makes one far drag, which moves every element of the sample in most algorithms.
void openAndDrag(Workbench& bench, const Point& by = Point(4, 3, 0)) {
  QTest::keyClick(&bench.window, Qt::Key_O);
  QTRY_VERIFY(bench.find<QDockWidget>("propagationDock")->isVisible());
  bench.document().handle().grab(middle);
  bench.document().handle().drag(bench.document().mesh()->rest_position(middle) + by);
  bench.document().handle().release();
  bench.settle();
  QTRY_VERIFY(slider(bench, 0).isEnabled() && slider(bench, 1).isEnabled());
}

QAbstractItemModel& list(Workbench& bench, int panel) {
  return *bench.find<QTreeView>(qPrintable(QStringLiteral("waitingList%1").arg(panel)))->model();
}
QString cell(Workbench& bench, int panel, int row, int column) {
  return list(bench, panel).index(row, column).data().toString();
}
QString updates() { return QStringLiteral("Order of update (candidate of the pass)"); }
std::vector<Point> positions(Workbench& bench, int panel) {
  std::vector<Point> all;
  for (ElementId e = 0; e < bench.document().mesh()->element_count(); ++e) {
    all.push_back(bench.position(panel, e));
  }
  return all;
}

}  // namespace

class WindowPropagation : public QObject {
  Q_OBJECT

 private slots:
  void init() { failOnWarnings(); }

  void aPassIsSteppedBackAndForward() {
    Workbench bench;
    openAndDrag(bench);
    const auto after = positions(bench, 1);
    const int steps = slider(bench, 1).maximum();
    QCOMPARE(quint64(steps), bench.document().solvers().frame(1)->statistics.last_pass.checked);
    QCOMPARE(slider(bench, 1).value(), steps);
    bench.trigger("passFirst");  // no element has followed the handle yet
    for (ElementId e = 0; e < bench.document().mesh()->element_count(); ++e) {
      const Point rest = bench.document().mesh()->rest_position(e);
      QVERIFY(bench.position(1, e) == (e == middle ? Point(rest + Point(4, 3, 0)) : rest));
    }
    QTest::keyClick(&bench.window, Qt::Key_Period);
    QCOMPARE(slider(bench, 1).value(), 1);
    // Natural Queue first takes the handle's neighbour with the lowest id, which is below it.
    QVERIFY(bench.position(1, middle - 9) == after[middle - 9]);
    QVERIFY(bench.position(1, middle - 1) == bench.document().mesh()->rest_position(middle - 1));
    QTest::keyClick(&bench.window, Qt::Key_Comma);
    QVERIFY(bench.position(1, middle - 9) == bench.document().mesh()->rest_position(middle - 9));
    bench.trigger("passLast");
    QVERIFY(positions(bench, 1) == after);
  }

  void behindAnotherDockItColoursNothingAndKeepsItsStep() {
    Workbench bench;
    openAndDrag(bench);
    const auto after = positions(bench, 1);
    bench.trigger("passFirst");
    bench.settle();
    QVERIFY(positions(bench, 1) != after);
    bench.find<QDockWidget>("meshDock")->raise();
    bench.settle();
    QVERIFY(!bench.find<QAction>("passBack")->isEnabled());
    QVERIFY(positions(bench, 1) == after);
    QTRY_VERIFY(bench.window.panel(1).legend().title() != updates());
    QTest::keyClick(&bench.window, Qt::Key_O);
    bench.settle();
    QTRY_COMPARE(bench.window.panel(1).legend().title(), updates());
    QVERIFY(positions(bench, 1) != after);
    QCOMPARE(slider(bench, 1).value(), 0);
  }

  void theListSaysWhatWaits() {
    Workbench bench;
    openAndDrag(bench);
    bench.trigger("passFirst");
    QCOMPARE(cell(bench, 1, 0, 2), QStringLiteral("handle"));
    const auto row = [&](int i) { return cell(bench, 1, i, 0) + cell(bench, 1, i, 2); };
    QCOMPARE(row(1), QStringLiteral("22next"));
    QCOMPARE(row(2), QStringLiteral("30waits"));
    QCOMPARE(row(4), QStringLiteral("40waits"));
    QCOMPARE(list(bench, 1).rowCount(), 5);
    bench.trigger("passForward");
    QVERIFY(row(0) == QStringLiteral("22moved") && cell(bench, 1, 0, 1) == QStringLiteral("31"));
    QCOMPARE(row(1), QStringLiteral("30next"));
    QCOMPARE(row(4), QStringLiteral("13waits"));
    QCOMPARE(list(bench, 1).rowCount(), 1 + 6 + 1);
    QVERIFY(bench.find<QLabel>("propagationState1")->text().contains(QStringLiteral("<b>6</b> waiting")));
    // Generalized takes the last candidate of the list first, and admits candidates that are updated already.
    QCOMPARE(cell(bench, 0, 0, 0), QStringLiteral("40"));
    bench.trigger("passForward");
    bool drops = false;
    for (int i = 1; i < list(bench, 0).rowCount(); ++i) {
      drops =
          drops || (cell(bench, 0, i, 0) == QStringLiteral("40") && cell(bench, 0, i, 2) == QStringLiteral("dropped"));
    }
    QVERIFY(drops);
    auto* view = bench.find<QTreeView>("waitingList1");
    view->setCurrentIndex(list(bench, 1).index(3, 0));
    QCOMPARE(QString::number(*bench.document().highlight().marks().element), cell(bench, 1, 3, 0));
    bench.choose(1, "Exact ChainMail");
    edits::resetObject(bench.document());
    bench.trigger("showPropagation");
    openAndDrag(bench);
    bench.trigger("passFirst");
    QTRY_VERIFY(bench.find<QLabel>("propagationState1")->text().contains(QStringLiteral("no waiting list")));
    QTRY_COMPARE(cell(bench, 1, 1, 2), QStringLiteral("to come"));
  }

  /// Backward, so that fewer candidates at the head of the list are dropped than at the step before.
  void theNextOneIsTheOneThatIsTakenNext() {
    Workbench bench;
    openAndDrag(bench);
    const auto candidate = [&](int panel, int row) { return cell(bench, panel, row, 0) + cell(bench, panel, row, 1); };
    for (int panel = 0; panel < 2; ++panel) {
      int droppedFirst = 0;
      for (int step = slider(bench, panel).maximum(); step > 0; --step) {
        slider(bench, panel).setValue(step);
        const QString taken = candidate(panel, 0);
        slider(bench, panel).setValue(step - 1);
        QStringList next;
        for (int row = 1; row < list(bench, panel).rowCount(); ++row) {
          next += cell(bench, panel, row, 2) == QStringLiteral("next") ? candidate(panel, row) : QString();
        }
        next.removeAll({});
        QCOMPARE(next, QStringList{taken});
        droppedFirst += cell(bench, panel, 1, 2) == QStringLiteral("dropped") ? 1 : 0;
      }
      QVERIFY(droppedFirst > 0 || panel > 0);  // Generalized admits what is updated already
    }
  }

  void elementsAreColouredByOrderOfUpdate() {
    Workbench bench;
    openAndDrag(bench, Point(1.5, 1, 0));
    QTRY_VERIFY(bench.window.panel(1).legend().title().contains(QStringLiteral("Order of update")));
    const auto* box = bench.find<QComboBox>("colourBy");
    QTRY_VERIFY(box->placeholderText().contains(QStringLiteral("Order of update")) && box->currentIndex() == -1);
    bench.trigger("passFirst");
    bench.trigger("passForward");
    bench.document().highlight().set({});
    const int most = std::max(slider(bench, 0).maximum(), slider(bench, 1).maximum());
    QTRY_COMPARE(bench.window.panel(1).legend().highest(), QLocale().toString(double(most), 'g', 3));
    QVERIFY(bench.distanceFromColour(1, bench.place(1, 22), colour_map::at(0)) < alike);
    QVERIFY(bench.distanceFromColour(1, bench.place(1, 4), colour_map::at(0)) > alike);
    bench.trigger("showPropagation");  // closing the dock restores the normal views
    edits::resetObject(bench.document());
    bench.settle();
    QTRY_VERIFY(!bench.window.panel(1).legend().isWanted());
    QTRY_COMPARE(box->currentText(), QStringLiteral("Plain"));
    bench.document().highlight().set({});
    QVERIFY(bench.distanceFromColour(1, bench.place(1, 22), colours::stronger(panelColour(bench.document(), 1))) <
            alike);
  }

  void panelsStepTogetherOrAlone() {
    Workbench bench;
    openAndDrag(bench);
    bench.trigger("passFirst");
    bench.trigger("passForward");
    QCOMPARE(slider(bench, 0).value(), 1);
    QCOMPARE(slider(bench, 1).value(), 1);
    bench.find<QCheckBox>("passTogether")->setChecked(false);
    slider(bench, 1).setValue(7);
    QCOMPARE(slider(bench, 0).value(), 1);
    bench.trigger("passForward");
    QCOMPARE(slider(bench, 0).value(), 1);
    QCOMPARE(slider(bench, 1).value(), 8);
    bench.find<QCheckBox>("passTogether")->setChecked(true);
    bench.trigger("passBack");
    QCOMPARE(slider(bench, 0).value(), 7);
    QCOMPARE(slider(bench, 1).value(), 7);
  }

  void slowMotionRunsToTheEndAndStops() {
    Workbench bench;
    openAndDrag(bench);
    auto* speed = bench.find<QComboBox>("passSpeed");
    speed->setCurrentIndex(speed->findData(1000));
    bench.trigger("passPlay");
    QVERIFY(bench.find<QAction>("passPlay")->isChecked());
    QVERIFY(slider(bench, 1).value() < slider(bench, 1).maximum());
    QTRY_COMPARE(slider(bench, 1).value(), slider(bench, 1).maximum());
    QTRY_VERIFY(!bench.find<QAction>("passPlay")->isChecked());
  }

  void followingMayBeSwitchedOffAndOn() {
    Workbench bench;
    openAndDrag(bench);
    const auto live = positions(bench, 0);
    bench.trigger("passFollow");
    QVERIFY(!bench.find<QAction>("passFollow")->isChecked());
    bench.trigger("passFirst");
    QVERIFY(positions(bench, 0) != live);
    bench.trigger("passFollow");
    QVERIFY(bench.find<QAction>("passFollow")->isChecked());
    QVERIFY(positions(bench, 0) == live);
  }

  void theHandAndEditsLetGoOfThePass() {
    Workbench bench;
    openAndDrag(bench);
    const auto live = positions(bench, 0);
    bench.trigger("passFirst");
    QVERIFY(!bench.find<QAction>("passFollow")->isChecked());
    QVERIFY(positions(bench, 0) != live);
    bench.document().highlight().set({middle, true, {}});
    QVERIFY(positions(bench, 0) == live);
    bench.document().highlight().set({});
    bench.trigger("passFirst");
    bench.trigger("resetObject");
    bench.settle();
    QVERIFY(bench.find<QAction>("passFollow")->isChecked());
    QVERIFY(bench.position(0, middle) == bench.document().mesh()->rest_position(middle));
    bench.trigger("passFirst");
    edits::replaceMesh(bench.document(), generate({MeshKind::tetra, {5, 5, 5}, 1, {}}), QStringLiteral("other"),
                       QStringLiteral("build"));
    bench.settle();
    QVERIFY(!bench.find<QAction>("passFirst")->isEnabled());
    QVERIFY(bench.find<QAction>("passFirst")->toolTip().contains(QStringLiteral("drag an element")));
  }

  void everyAlgorithmCanBeSteppedInSpace() {
    Workbench bench(generate({MeshKind::block, {5, 5, 5}, 1, {}}));
    for (const auto& one : algorithms()) {
      edits::resetObject(bench.document());
      bench.choose(0, std::string(one.label).c_str());
      if (!bench.find<QDockWidget>("propagationDock")->isHidden()) {
        bench.trigger("showPropagation");
      }
      openAndDrag(bench, Point(3, 2, 1));
      const auto after = positions(bench, 0);
      bench.trigger("passFirst");
      bench.view(0).grabFramebuffer();
      for (const int step : {3, 40, 1, 124}) {
        slider(bench, 0).setValue(step);
        bench.view(0).grabFramebuffer();
      }
      bench.trigger("passLast");
      QVERIFY(positions(bench, 0) == after);
    }
  }
};

CHAINMAIL_WINDOW_TEST(WindowPropagation)

}  // namespace chainmail::window_propagation

#include "window_propagation.moc"
