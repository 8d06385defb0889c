// Tests every control of the docks in a real window.

#include <QCheckBox>
#include <QComboBox>
#include <QDockWidget>
#include <QDoubleSpinBox>
#include <QLabel>
#include <QMenuBar>
#include <QPushButton>
#include <QRegularExpression>
#include <QSlider>
#include <QSpinBox>
#include <QTableWidget>
#include <QToolButton>
#include <QToolTip>
#include <algorithm>
#include <array>
#include <cmath>

#include "common/icons.h"
#include "document/edits.h"
#include "mesh/layers.h"
#include "window.h"
#include "window/docks.h"

namespace chainmail::window_docks {

class WindowDocks : public QObject {
  Q_OBJECT

 private slots:
  void init() { failOnWarnings(); }

  /// Also one that is added to the table.
  void everyDockOfTheTableIsDescribedAndIsInTheWindowAndInOneMenu() {
    const ExtraRow<DockEntry> extra({.id = "dummyDock",
                                     .action = "showDummyDock",
                                     .title = "Dummy",
                                     .tooltip = "Shows nothing",
                                     .icon = "mesh",
                                     .key = "Ctrl+Alt+D",
                                     .area = Qt::LeftDockWidgetArea,
                                     .visible = false,
                                     .make = [](const DockParts& /*parts*/) { return new QDockWidget; }});
    QCOMPARE(dockEntries().back().id, "dummyDock");
    QSet<QString> names;
    for (const DockEntry& entry : dockEntries()) {
      const QList<const char*> texts{entry.id, entry.action, entry.title, entry.tooltip, entry.icon};
      QVERIFY2(std::ranges::all_of(texts, [](const char* one) { return one != nullptr && *one != 0; }), entry.id);
      QVERIFY2(iconNames().contains(QLatin1String(entry.icon)), entry.icon);
      names << QLatin1String(entry.id) << QLatin1String(entry.action) << QLatin1String(entry.title);
    }
    QCOMPARE(names.size(), qsizetype(3 * dockEntries().size()));

    Workbench bench;
    QCOMPARE(bench.window.findChildren<QDockWidget*>().size(), qsizetype(dockEntries().size()));
    for (const DockEntry& entry : dockEntries()) {
      const auto* dock = bench.find<QDockWidget>(entry.id);
      QCOMPARE(dock->windowTitle(), QLatin1String(entry.title));
      QCOMPARE(dock->toolTip(), QLatin1String(entry.tooltip));
      QCOMPARE(bench.window.dockWidgetArea(const_cast<QDockWidget*>(dock)), entry.area);
      QCOMPARE(!dock->isHidden(), entry.visible);
      const QAction* show = dock->toggleViewAction();
      QCOMPARE(show->objectName(), QLatin1String(entry.action));
      QCOMPARE(show->statusTip(), QLatin1String(entry.tooltip));
      QVERIFY(!show->icon().isNull());
      QCOMPARE(show->shortcut(), QKeySequence(QLatin1String(entry.key)));
    }

    const QList<QAction*> actions = bench.window.actions();
    for (const DockEntry& entry : dockEntries()) {
      QAction* show = bench.find<QDockWidget>(entry.id)->toggleViewAction();
      QCOMPARE(menu(bench, "Docks").count(show), 1);
      QCOMPARE(menu(bench, "View").count(show), 0);
      QCOMPARE(actions.count(show), 1);
    }
    QCOMPARE(menu(bench, "Docks").size(), qsizetype(dockEntries().size()));
    bench.trigger("showDummyDock");
    QVERIFY(bench.find<QDockWidget>("dummyDock")->isVisible());
    const auto placed = bench.window.docks().layout().docks;
    QCOMPARE(std::ranges::count(placed, QStringLiteral("dummyDock"), &DockPlace::id), 1);
  }

  void theKeyOfTheElementDockClosesItAgainAndAnIdThatIsNoneGetsAnAnswer() {
    Workbench bench;
    auto* dock = bench.find<QDockWidget>("elementDock");
    QTest::keyClick(&bench.window, Qt::Key_E, Qt::ControlModifier);
    QTRY_VERIFY(bench.find<QSpinBox>("elementId")->hasFocus());
    QTest::keyClick(bench.find<QSpinBox>("elementId"), Qt::Key_E, Qt::ControlModifier);
    QVERIFY(dock->isHidden());

    bench.trigger("showElement");
    auto* id = bench.find<QSpinBox>("elementId");
    const auto enter = [&](const char* digits) {
      id->setFocus();
      id->selectAll();
      QTest::keyClicks(id, QLatin1String(digits));
      QTest::keyClick(id, Qt::Key_Return);
      bench.settle();
    };
    enter("99");
    QVERIFY(bench.document().selection().empty());  // it does not select the last element instead
    enter("7");
    QCOMPARE(bench.document().selection().elements(), std::vector<ElementId>{7});
    enter("63");  // the first id beyond the last
    const auto answered = [&] {
      return bench.find<QLabel>("elementState")->text().contains(QStringLiteral("from 0 to 62"));
    };
    QVERIFY(answered());
    QCOMPARE(bench.document().selection().elements(), std::vector<ElementId>{7});
    QCOMPARE(id->value(), 7);
    Document& document = bench.document();
    const auto shown = [&] { return bench.find<QTableWidget>("elementPositions")->item(1, 1)->text(); };
    const QString before = shown();
    document.handle().grab(7);  // the frames of a drag refresh the dock, but the message stays
    document.handle().drag(document.mesh()->rest_position(7) + Point(0.5, 0, 0));
    document.handle().release();
    QTRY_VERIFY(shown() != before);
    QVERIFY(answered());
    enter("8");
    QVERIFY(!answered());
  }

  void aNumberOutsideItsRangeIsRefusedInWordsAndOneDragOfASliderIsOneStepOfUndo() {
    Workbench bench;
    auto* spin = bench.find<QDoubleSpinBox>("stretchSpin");
    const double before = spin->value();
    const auto enter = [&](const char* typed) {
      spin->setFocus();
      spin->selectAll();
      QTest::keyClicks(spin, QLatin1String(typed));
      QTest::keyClick(spin, Qt::Key_Return);
    };
    enter("1e9");
    QCOMPARE(spin->value(), before);
    QCOMPARE(bench.document().undoStack().count(), 0);
    QVERIFY2(QToolTip::text().contains(QStringLiteral("1e9 is too large")), qPrintable(QToolTip::text()));
    enter("0.5");
    QCOMPARE(spin->value(), before);
    QVERIFY2(QToolTip::text().contains(QStringLiteral("too small")), qPrintable(QToolTip::text()));
    enter("1.5e1");
    QCOMPARE(spin->value(), 15.0);
    QCOMPARE(of(bench, "stretch"), 15.0);

    bench.document().undo();
    bench.document().undoStack().clear();
    auto* slider = bench.find<QSlider>("stretchSlider");
    slider->setSliderDown(true);
    for (int at = 200; at <= 400; at += 20) {
      slider->setValue(at);
    }
    slider->setSliderDown(false);
    QCOMPARE(bench.document().undoStack().count(), 1);
    bench.document().undoStack().undo();
    QCOMPARE(bench.document().softness(), LinkSoftness());
  }

  void stiffness_data() {
    QTest::addColumn<QByteArray>("name");
    QTest::addColumn<double>("value");
    QTest::newRow("compression") << QByteArray("compression") << 0.5;
    QTest::newRow("stretch") << QByteArray("stretch") << 1.75;
    QTest::newRow("shear") << QByteArray("shear") << 0.4;
    QTest::newRow("lateral stiffness") << QByteArray("lateral") << 0.025;
    QTest::newRow("link stiffness") << QByteArray("stiffness") << 2.5;
    QTest::newRow("length exponent") << QByteArray("exponent") << -2.25;
  }
  void stiffness() {
    QFETCH(QByteArray, name);
    QFETCH(double, value);
    Workbench bench;
    auto* spin = bench.find<QDoubleSpinBox>(name + "Spin");
    auto* slider = bench.find<QSlider>(name + "Slider");
    auto* reset = bench.find<QToolButton>(name + "Reset");
    const double standard = spin->value();
    const int sliderAt = slider->value();
    QVERIFY(!reset->isEnabled());
    spin->setValue(value);
    QCOMPARE(of(bench, name), value);
    QVERIFY(slider->value() != sliderAt);
    QVERIFY(reset->isEnabled());
    QCOMPARE(bench.document().undoStack().undoText(), QLatin1String(QTest::currentDataTag()));
    bench.document().undoStack().undo();
    QCOMPARE(spin->value(), standard);
    QCOMPARE(slider->value(), sliderAt);
    slider->setValue(slider->maximum());
    QVERIFY(of(bench, name) != standard);
    reset->click();
    QCOMPARE(of(bench, name), standard);
    slider->setValue(slider->maximum() / 4);
    const double quarter = spin->value();
    reset->click();
    spin->setValue(quarter);
    QVERIFY2(std::abs(slider->value() - slider->maximum() / 4) <= slider->maximum() / 100,
             qPrintable(QString::number(slider->value())));
  }

  void energy() {
    Workbench bench;
    auto* field = bench.find<QComboBox>("energy");
    auto* lateral = bench.find<QDoubleSpinBox>("lateralSpin");
    const auto choose = [&](EnergyKind kind) {
      field->setCurrentIndex(field->findData(int(kind)));
      emit field->activated(field->currentIndex());
    };
    const auto now = [&] { return bench.document().wholeSoftness()->energy; };
    QCOMPARE(field->count(), int(energy_kinds().size()));
    QCOMPARE(field->currentData().toInt(), int(EnergyKind::material));
    choose(EnergyKind::isotropic);
    QVERIFY(now() == EnergyKind::isotropic);
    QVERIFY(!lateral->isEnabled());  // its numbers do not count
    QCOMPARE(bench.document().undoStack().undoText(), QStringLiteral("isotropic energy"));
    bench.find<QDoubleSpinBox>("shearSpin")->setValue(0.5);
    QVERIFY(now() == EnergyKind::isotropic);
    bench.document().undoStack().undo();
    bench.document().undoStack().undo();
    QVERIFY(now() == EnergyKind::material);
    QCOMPARE(field->currentData().toInt(), int(EnergyKind::material));
    QVERIFY(lateral->isEnabled());  // sweeps relax links
    QCOMPARE(lateral->value(), info(EnergyKind::material).lateral);
    choose(EnergyKind::axial);
    QCOMPARE(lateral->value(), info(EnergyKind::axial).lateral);  // the one that suits it
    bench.trigger("resetStiffness");
    QVERIFY(now() == EnergyKind::material);
  }

  void theFrameOfRegions() {
    Workbench bench;
    auto* field = bench.find<QComboBox>("frame");
    QVERIFY(field->isEnabled());
    MeshParts parts;
    parts.rest = {{0, 0, 0}, {3, 4, 0}, {6, 8, 0}, {-0.8, 0.6, 0}};
    parts.links = {{0, 1}, {1, 2}, {0, 3}};
    edits::replaceMesh(bench.document(), build_mesh(std::move(parts)), QStringLiteral("leaning"),
                       QStringLiteral("open"));
    auto* note = bench.find<QLabel>("frameNote");
    const auto choose = [&](AxesKind kind) {
      field->setCurrentIndex(field->findData(int(kind)));
      emit field->activated(field->currentIndex());
    };
    const auto now = [&] { return bench.document().wholeSoftness()->axes; };
    QCOMPARE(field->currentData().toInt(), int(AxesKind::axes));
    QCOMPARE(field->count(), 2);
    const int steps = bench.document().undoStack().count();
    choose(AxesKind::object);
    QVERIFY(now().kind() == AxesKind::object && now().is_turned() && note->isHidden());
    QCOMPARE(bench.document().undoStack().undoText(), QStringLiteral("regions along the object's axes"));
    bench.find<QDoubleSpinBox>("shearSpin")->setValue(0.5);
    QVERIFY(now().is_turned());
    bench.document().undoStack().undo();
    bench.document().undoStack().undo();
    QVERIFY(now() == RegionAxes());
    QCOMPARE(field->currentData().toInt(), int(AxesKind::axes));
    bench.document().undoStack().redo();
    QVERIFY(now().kind() == AxesKind::object);
    QCOMPARE(bench.document().undoStack().count(), steps + 2);
    // A square has no axes of its own: the dock says so. The choice stays for the next object.
    edits::replaceMesh(bench.document(), generate({MeshKind::grid, {4, 4, 1}, 1, {}}), QStringLiteral("square"),
                       QStringLiteral("open"));
    QVERIFY(now().kind() == AxesKind::object && !now().is_turned() && !note->isHidden());
    choose(AxesKind::axes);
    QVERIFY(note->isHidden());
    choose(AxesKind::object);
    QVERIFY(!note->isHidden());
    bench.trigger("resetStiffness");
    QVERIFY(now() == RegionAxes() && note->isHidden());

    // A rotation comes from a session or from moves. It is listed while it applies.
    Change edit = bench.document().change(QStringLiteral("rotation"));
    Softness softness = *bench.document().wholeSoftness();
    softness.axes = RegionAxes(AxesKind::given, Point(0, 0, 0.5));
    edit.after.softness = std::make_shared<const Softness>(std::move(softness));
    bench.document().apply(std::move(edit));
    QCOMPARE(field->currentText(), QStringLiteral("Given axes"));
    bench.document().undo();
    QCOMPARE(field->currentText(), QStringLiteral("World's axes"));
    QCOMPARE(field->count(), 2);

    // Nothing of a line can be turned.
    edits::replaceMesh(bench.document(), generate({MeshKind::line, {6, 1, 1}, 1, {}}), QStringLiteral("line"),
                       QStringLiteral("open"));
    QVERIFY(!field->isEnabled());
  }

  void stiffnessActsLiveOnADeformedObject() {
    Workbench bench;
    bench.find<QDoubleSpinBox>("stretchSpin")->setValue(3);
    const QPoint from = bench.place(0, 35);
    bench.stroke(0, {from, from + QPoint(100, 0)});
    const double before = bench.position(1, 27).x();
    bench.find<QDoubleSpinBox>("stretchSpin")->setValue(1);
    bench.settle();
    QVERIFY(bench.position(1, 27).x() > before);
    bench.trigger("resetStiffness");
    QCOMPARE(bench.document().softness(), LinkSoftness());
  }

  void meshOfEveryKind_data() {
    QTest::addColumn<QString>("kind");
    QTest::addColumn<unsigned>("elements");
    QTest::addColumn<int>("space");
    QTest::addColumn<QString>("chosen");
    QTest::newRow("line") << QStringLiteral("Line") << 5U << 1 << QString();
    QTest::newRow("grid") << QStringLiteral("Grid") << 20U << 2 << QString();
    QTest::newRow("cloth") << QStringLiteral("Cloth") << 20U << 2 << QString();
    QTest::newRow("block") << QStringLiteral("Block") << 60U << 3 << QString();
    QTest::newRow("tetra") << QStringLiteral("Tetra") << 60U << 3 << QString();
    QTest::newRow("cloth in space") << QStringLiteral("Cloth") << 20U << 3 << QStringLiteral("3D");
  }
  void meshOfEveryKind() {
    QFETCH(QString, kind);
    QFETCH(unsigned, elements);
    QFETCH(int, space);
    QFETCH(QString, chosen);
    Workbench bench;
    const MeshPointer before = bench.document().mesh();
    bench.find<QComboBox>("meshKind")->setCurrentText(kind);
    if (!chosen.isEmpty()) {
      bench.find<QComboBox>("spaceDimension")->setCurrentText(chosen);  // a flat mesh may lie in space
    }
    bench.find<QSpinBox>("sizeW")->setValue(5);
    bench.find<QSpinBox>("sizeH")->setValue(4);
    bench.find<QSpinBox>("sizeD")->setValue(3);
    bench.find<QDoubleSpinBox>("spacingSpin")->setValue(0.25);
    bench.find<QPushButton>("buildMesh")->click();
    bench.settle();
    const Mesh& mesh = *bench.document().mesh();
    QCOMPARE(mesh.element_count(), elements);
    QCOMPARE(mesh.space_dimension, space);
    QCOMPARE(mesh.rest_position(1).x(), 0.25);
    QVERIFY(bench.find<QLabel>("meshDescription")->text().contains(QString::number(elements)));
    bench.document().undoStack().undo();
    bench.settle();
    QCOMPARE(bench.document().mesh(), before);
  }

  void theToolsDocksButtonsChooseTheTool() {
    Workbench bench;
    for (const char* tool : {"toolCut", "toolDrag"}) {
      QToolButton* button = nullptr;
      for (auto* one : bench.find<QDockWidget>("toolsDock")->findChildren<QToolButton*>()) {
        button = one->defaultAction() == bench.find<QAction>(tool) ? one : button;
      }
      QVERIFY(button != nullptr);
      QTest::mouseClick(button, Qt::LeftButton);
      QVERIFY(bench.find<QAction>(tool)->isChecked());
      QVERIFY(button->isChecked());
    }
  }

  void relaxationRunsInIdleTimeAndSleeps() {
    Workbench bench;
    auto* on = bench.find<QCheckBox>("relaxationOn");
    on->click();
    QVERIFY(bench.document().relaxation().on);
    bench.find<QDoubleSpinBox>("relax-stepSpin")->setValue(0.5);
    QCOMPARE(bench.document().relaxation().step, 0.5);
    const QPoint from = bench.place(0, 31);
    bench.stroke(0, {from, from + QPoint(150, -150)}, false);
    QTRY_VERIFY(bench.document().solvers().frame(1)->statistics.sweeps > 0);
    QTest::mouseRelease(&bench.view(0), Qt::LeftButton, {}, from + QPoint(150, -150));
    // Relaxation stops by itself.
    QTRY_VERIFY_WITH_TIMEOUT(!bench.document().solvers().frame(0)->statistics.relaxing &&
                                 !bench.document().solvers().frame(1)->statistics.relaxing,
                             12'000);
    on->click();
    QVERIFY(!bench.document().relaxation().on);
  }

  void choosingTheRelaxation() {
    Workbench bench(generate({MeshKind::tetra, {4, 3, 3}, 1, {}}));
    auto* scheme = bench.find<QComboBox>("relaxationScheme");
    QVERIFY(bench.document().relaxation().scheme == RelaxationScheme::mean);
    scheme->setCurrentText(QStringLiteral("link"));
    QVERIFY(bench.document().relaxation().scheme == RelaxationScheme::link);
    bench.find<QCheckBox>("relaxationOn")->click();
    QVERIFY(bench.document().relaxation().on);
    QVERIFY(bench.document().relaxation().scheme == RelaxationScheme::link);
    bench.trigger("undo");
    QVERIFY(!bench.document().relaxation().on);
    QVERIFY(!bench.find<QCheckBox>("relaxationOn")->isChecked());
    bench.trigger("undo");
    QCOMPARE(scheme->currentText(), QStringLiteral("mean"));

    bench.document().undoStack().clear();
    scheme->setCurrentText(QStringLiteral("material"));
    QCOMPARE(bench.document().undoStack().count(), 1);
    QVERIFY(bench.document().relaxation().on && bench.document().relaxation().scheme == RelaxationScheme::equilibrium);
    QVERIFY(bench.document().wholeSoftness()->energy == EnergyKind::material);
    QCOMPARE(bench.document().softness(), (LinkSoftness{0, 3, 2}));
    QCOMPARE(bench.find<QComboBox>("preset")->currentText(), QStringLiteral("Open regions (material)"));
    QCOMPARE(scheme->currentText(), QStringLiteral("material"));
    auto* local = bench.find<QCheckBox>("relaxationLocal");
    QVERIFY(!local->isHidden() && local->isChecked());
    local->click();
    QVERIFY(!bench.document().relaxation().local);
    bench.trigger("undo");
    QVERIFY(bench.document().relaxation().local && local->isChecked());
    edits::setSoftness(bench.document(), {0.5, 3, 2}, QStringLiteral("compression"));
    QCOMPARE(scheme->currentText(), QStringLiteral("equilibrium"));
    bench.trigger("undo");
    bench.trigger("undo");
    QVERIFY(!bench.document().relaxation().on);
    QCOMPARE(scheme->currentText(), QStringLiteral("mean"));
    QVERIFY(local->isHidden());
  }

  void theEquilibriumShowsItsResidual() {
    Workbench bench;
    auto* scheme = bench.find<QComboBox>("relaxationScheme");
    auto* residual = bench.find<QLabel>("residual");
    auto* step = bench.find<QDoubleSpinBox>("relax-stepSpin");
    QVERIFY(residual->isHidden() && step->isEnabled());
    scheme->setCurrentText(QStringLiteral("equilibrium"));
    QVERIFY(bench.document().relaxation().scheme == RelaxationScheme::equilibrium);
    QVERIFY(!residual->isHidden() && !step->isEnabled());
    QVERIFY(step->toolTip().contains(QStringLiteral("no step")));
    QTRY_COMPARE(residual->text(), QStringLiteral("Residual (relative):\nA –, B –"));
    bench.find<QCheckBox>("relaxationOn")->click();
    const QPoint from = bench.place(0, 31);
    bench.stroke(0, {from, from + QPoint(100, -100)}, false);
    const auto shown = [&] {
      return residual->text().section(QStringLiteral("\nA "), 1).section(QLatin1Char(','), 0, 0);
    };
    QTRY_VERIFY_WITH_TIMEOUT(shown() != QStringLiteral("–") && shown().toDouble() < 1e-3, 12'000);
    QTest::mouseRelease(&bench.view(0), Qt::LeftButton, {}, from + QPoint(100, -100));
    QTRY_VERIFY_WITH_TIMEOUT(!bench.document().solvers().frame(0)->statistics.relaxing &&
                                 !bench.document().solvers().frame(1)->statistics.relaxing,
                             12'000);
    scheme->setCurrentText(QStringLiteral("link"));
    QVERIFY(residual->isHidden() && step->isEnabled() && !step->toolTip().contains(QStringLiteral("no step")));
    bench.trigger("undo");
    QVERIFY(!residual->isHidden() && !step->isEnabled());
    QCOMPARE(scheme->currentText(), QStringLiteral("equilibrium"));
  }

  void theMeshDockHasButtonsForFiles() {
    Workbench bench;
    const auto* dock = bench.find<QDockWidget>("meshDock");
    for (const QString& text : {QStringLiteral("Open…"), QStringLiteral("Save…")}) {
      const auto buttons = dock->findChildren<QPushButton*>();
      const auto found = std::ranges::find_if(buttons, [&](const auto* button) { return button->text() == text; });
      QVERIFY2(found != buttons.end() && (*found)->isVisible(), qPrintable(text));
      QVERIFY(dock->rect().contains(QRect((*found)->mapTo(dock, QPoint()), (*found)->size())));
    }
  }

  void aPanelSaysHowFarItIsFromTheEquilibrium() {
    Workbench bench(generate({MeshKind::tetra, {18, 18, 18}, 1, {}}));
    Document& document = bench.document();
    const auto* state = bench.find<QLabel>("state0");
    edits::setPinned(document, layer(*document.mesh(), *find_side("left")), true);
    edits::setRelaxation(document, {.on = true, .step = 0.01, .local = true});
    const auto grab = [&] { document.handle().grab(layer(*document.mesh(), *find_side("right"))); };
    grab();
    double far = 0;
    const auto says = [&](const QString& words) {
      document.handle().drag(Point(17, 8.5, 8.5 + (far += 0.05)));
      return state->toolTip().contains(QRegularExpression(words));
    };
    QTRY_VERIFY(says(QStringLiteral("relaxing, sweep \\d+")));
    QVERIFY(!state->toolTip().contains(QStringLiteral("equilibrium")));
    bench.find<QComboBox>("relaxationScheme")->setCurrentText(QStringLiteral("material"));
    grab();
    QTRY_VERIFY(says(QStringLiteral("about \\d+ % from the full equilibrium")));
    QVERIFY(!state->toolTip().contains(QStringLiteral("relaxing")));
    document.handle().release();
    QTRY_VERIFY(!state->toolTip().contains(QStringLiteral("equilibrium")));
  }

  /// The two links of a chain contradict each other, so sweeps over links never end there.
  void relaxationThatComesNoCloserSaysSo() {
    Workbench bench(generate({MeshKind::line, {3, 1, 1}, 1, {}}));
    Document& document = bench.document();
    edits::setPinned(document, {0}, true);
    document.handle().grab(2);
    document.handle().drag(Point(2.2, 0, 0));
    document.handle().release();
    edits::setPinned(document, {2}, true);
    bench.settle();
    auto* words = bench.find<QLabel>("unsettled0");
    QVERIFY(!words->isVisible());
    edits::setRelaxation(document, {true, 1, RelaxationScheme::link});
    QTRY_VERIFY(words->isVisible());
    QVERIFY2(words->text().startsWith(QStringLiteral("not settled: step 0.")), qPrintable(words->text()));
    QVERIFY(!document.solvers().frame(0)->statistics.relaxing);
    QTest::mouseClick(bench.find<QToolButton>("continueRelaxation0"), Qt::LeftButton);
    bench.settle();
    document.moves().noteRelaxation();
    const MoveHistory& history = document.moves().history();
    const auto& again = std::get<commands::Relaxed>(history.at(history.length() - 1));
    QVERIFY(again.start == commands::Relaxed::Start::awake && again.counts->slices(0) > 1000);
    edits::setRelaxation(document, {false, 1, RelaxationScheme::link});
    QTRY_VERIFY(!words->isVisible());
  }

  void theTimeOfRelaxationIsBesideThatOfThePass() {
    Workbench bench;
    bench.window.panel(0).showFigures(true);
    auto* figures = bench.find<QLabel>("statistics0");
    QVERIFY(!figures->text().contains(QStringLiteral("relaxation")));
    edits::setRelaxation(bench.document(), {true, 0.01, RelaxationScheme::mean});
    bench.document().handle().grab(31);
    bench.document().handle().drag(Point(9, 9, 0));
    QTRY_VERIFY2(figures->text().contains(QStringLiteral("relaxation")), qPrintable(figures->text()));
    bench.document().handle().release();
  }

  void frameRatesAreShownAndRest() {
    Workbench bench;
    const QPoint from = bench.place(0, 31);
    QList<QPoint> there{from};
    for (int i = 0; i < 12; ++i) {
      there << from + QPoint(i % 2 == 0 ? 120 : 0, -60);
    }
    const std::array names{"painted0", "painted1", "passes0", "passes1", "median0", "median1", "worst0", "worst1"};
    const auto shown = [&] {
      return std::ranges::all_of(names, [&](const char* name) {
        return QLocale().toDouble(bench.find<QLabel>(name)->text().section(QLatin1Char(' '), 0, 0)) > 0;
      });
    };
    for (const QDeadlineTimer limit(20'000); !shown() && !limit.hasExpired();) {
      bench.stroke(0, there);
      QCoreApplication::processEvents();
    }
    QStringList texts;
    std::ranges::transform(names, std::back_inserter(texts),
                           [&](const char* name) { return bench.find<QLabel>(name)->text(); });
    QVERIFY2(shown(), qPrintable(texts.join(QStringLiteral(", "))));
    // Nothing is painted while nothing moves.
    QTRY_COMPARE(bench.find<QLabel>("painted0")->text(), QStringLiteral("idle"));
    QTRY_COMPARE(bench.find<QLabel>("painted1")->text(), QStringLiteral("idle"));
    // The figures of another algorithm do not count for the new one, which makes no pass until the object is moved.
    edits::setAlgorithm(bench.document(), 1, bench.document().algorithm(0));
    bench.settle();
    QTRY_COMPARE(bench.find<QLabel>("painted1")->text(), QStringLiteral("idle"));
    for (const char* name : {"passes1", "median1", "worst1"}) {
      QCOMPARE(bench.find<QLabel>(name)->text(), QStringLiteral("–"));
    }
    QVERIFY(bench.find<QLabel>("median0")->text() != QStringLiteral("–"));
  }

 private:
  static QList<QAction*> menu(Workbench& bench, const char* title) {
    for (const QAction* top : bench.window.menuBar()->actions()) {
      if (QString(top->text()).remove(QLatin1Char('&')) == QLatin1String(title)) {
        return top->menu()->actions();
      }
    }
    return {};
  }
  static double of(Workbench& bench, const QByteArray& name) {
    const auto number = std::ranges::find_if(
        softness_numbers, [&](const SoftnessNumber& one) { return one.parameter->name == name.toStdString(); });
    return bench.document().softness().*number->value;
  }
};

CHAINMAIL_WINDOW_TEST(WindowDocks)

}  // namespace chainmail::window_docks

#include "window_docks.moc"
