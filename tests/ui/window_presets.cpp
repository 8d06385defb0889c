// Tests presets of softness in a real window.

#include <QComboBox>
#include <QDoubleSpinBox>
#include <QFile>
#include <QLineEdit>

#include "docks/preset_row.h"
#include "window.h"
#include "window/bars.h"

namespace chainmail::window_presets {

namespace {

struct PresetBench : Workbench {
  PresetBench() : Workbench(generate({MeshKind::grid, {9, 7, 1}, 1, {}})) {}

  QComboBox& field() { return *find<QComboBox>("preset"); }
  PresetRow& row() { return *window.findChild<PresetRow*>(); }
  QString shown() { return field().currentText(); }
  void pick(const char* name) {
    field().setCurrentIndex(field().findText(QLatin1String(name)));
    emit field().activated(field().currentIndex());
  }
  void set(const char* spin, double value) { find<QDoubleSpinBox>(spin)->setValue(value); }
  bool enabled(const char* action) { return find<QAction>(action)->isEnabled(); }
  /// Opens the name field with an action and types a name.
  void name(const char* action, const char* typed) {
    trigger(action);
    auto* line = find<QLineEdit>("presetName");
    QVERIFY(line->isVisible());
    line->clear();
    QTest::keyClicks(line, QLatin1String(typed));
    QTest::keyClick(line, Qt::Key_Return);
  }
  bool has(const char* name) { return field().findText(QLatin1String(name)) >= 0; }
};

}  // namespace

class WindowPresets : public QObject {
  Q_OBJECT

 private slots:
  void init() {
    failOnWarnings();
    QSettings().clear();
    QFile::remove(PresetStore::file());
  }

  void thoseBuiltInActLiveAsOneStepAndAreKnownByTheirValues() {
    PresetBench bench;
    QCOMPARE(bench.shown(), QStringLiteral("Standard"));
    for (const BuiltInPreset& preset : built_in_presets()) {
      QVERIFY(bench.has(std::string(preset.name).c_str()));
    }
    const int steps = bench.document().undoStack().count();
    bench.pick("Rubber");
    QCOMPARE(bench.shown(), QStringLiteral("Rubber"));
    QCOMPARE(bench.document().softness().stretch, 2.0);
    QCOMPARE(bench.find<QDoubleSpinBox>("stretchSpin")->value(), 2.0);
    QCOMPARE(bench.document().undoStack().count(), steps + 1);
    QCOMPARE(bench.document().undoStack().undoText(), QStringLiteral("preset Rubber"));
    bench.document().undoStack().undo();
    QCOMPARE(bench.document().softness(), LinkSoftness());
    QCOMPARE(bench.shown(), QStringLiteral("Standard"));

    // Changed values show as Custom, unless they equal those of a preset.
    bench.set("stretchSpin", 1.3);
    QCOMPARE(bench.shown(), QStringLiteral("Custom"));
    QVERIFY(bench.enabled("savePreset"));
    bench.set("compressionSpin", 0.7);
    bench.set("shearSpin", 0.5);
    bench.set("stretchSpin", 2);
    QCOMPARE(bench.shown(), QStringLiteral("Rubber"));
    QVERIFY(!bench.enabled("savePreset") && !bench.enabled("deletePreset"));
    QVERIFY(bench.find<QAction>("deletePreset")->toolTip().contains(QStringLiteral("built in")));
  }

  void oneOfTheUsersIsSavedDeletedAndKept() {
    {
      PresetBench bench;
      bench.set("stretchSpin", 1.25);
      bench.name("savePreset", "wet clay");
      QCOMPARE(bench.shown(), QStringLiteral("wet clay"));
      bench.pick("Jelly");
    }
    PresetBench bench;  // the next start of the program
    bench.pick("wet clay");
    QCOMPARE(bench.document().softness().stretch, 1.25);
    bench.trigger("deletePreset");
    QVERIFY(!bench.has("wet clay"));
    QCOMPARE(bench.shown(), QStringLiteral("Custom"));
    QCOMPARE(bench.document().softness().stretch, 1.25);
  }

  void presetsThatAreBrokenSaySo() {
    QFile file(PresetStore::file());
    QVERIFY(file.open(QIODevice::WriteOnly) && file.write("nonsense") > 0);
    file.close();
    PresetBench bench;
    QVERIFY(bench.window.messages().sentence().startsWith(file.fileName() + QStringLiteral(":1: ")));
    QCOMPARE(bench.shown(), QStringLiteral("Standard"));
  }
};

CHAINMAIL_WINDOW_TEST(WindowPresets)

}  // namespace chainmail::window_presets

#include "window_presets.moc"
