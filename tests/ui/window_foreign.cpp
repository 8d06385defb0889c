// Tests what files of other people can do to a real window: layouts, cameras and texts of sessions, names of files.

#include <QDir>
#include <QDockWidget>
#include <QFile>
#include <QHelpEvent>
#include <QJsonArray>
#include <QJsonDocument>
#include <QJsonObject>
#include <QLabel>
#include <QMessageBox>
#include <QToolBar>
#include <QToolButton>
#include <QXmlStreamReader>
#include <cmath>

#include "common/plot_pictures.h"
#include "folders.h"
#include "io/sessions.h"
#include "window.h"
#include "window/bars.h"

namespace chainmail::window_foreign {

namespace {

/// Qt would read this file as a picture, as soon as it shows the text.
const QString markup = QStringLiteral("<img src='file:never'> & <b>bold</b>");

QJsonObject objectIn(const QString& path) {
  QFile file(path);
  return file.open(QIODevice::ReadOnly) ? QJsonDocument::fromJson(file.readAll()).object() : QJsonObject();
}

void write(const QString& path, const QJsonObject& object) {
  QFile file(path);
  QVERIFY(file.open(QIODevice::WriteOnly));
  file.write(QJsonDocument(object).toJson());
}

/// Returns the places of the docks without their sizes and positions, which depend on the window.
std::vector<DockPlace> order(Layout layout) {
  for (DockPlace& place : layout.docks) {
    place.size = {};
    place.position = {};
  }
  return layout.docks;
}

/// Returns the label that shows the tool tip of a widget.
QLabel* shownTip(QWidget& widget) {
  const QPoint middle = widget.rect().center();
  QHelpEvent event(QEvent::ToolTip, middle, widget.mapToGlobal(middle));
  QApplication::sendEvent(&widget, &event);
  for (QWidget* one : QApplication::topLevelWidgets()) {
    if (one->inherits("QTipLabel") && one->isVisible()) {
      return qobject_cast<QLabel*>(one);
    }
  }
  return nullptr;
}

}  // namespace

class WindowForeign : public QObject {
  Q_OBJECT

 private slots:
  void init() {
    failOnWarnings();
    QSettings().clear();
  }

  /// These bytes made QMainWindow::restoreState write outside its memory.
  void aLayoutInBytesIsIgnored() {
    Workbench bench;
    const QString path = saved(bench);
    QJsonObject session = objectIn(path);
    session[QStringLiteral("ui")] =
        QJsonObject{{QStringLiteral("layout"), QStringLiteral("AAAA/wAAAAX9AAAAAQAPQkAAAABkAAAAZPwBAAAAAAAAAAEAAAAB")}};
    write(path, session);
    const Layout before = bench.window.arrangement();
    bench.open(path);
    QVERIFY2(!bench.window.messages().isVisible(), qPrintable(bench.window.messages().sentence()));
    QCOMPARE(bench.window.arrangement(), before);
  }

  void docksComeBackWithASession() {
    Layout places;
    QString path;
    int width = 0;
    {
      Workbench bench;
      auto* stiffness = bench.find<QDockWidget>("stiffnessDock");
      bench.window.addDockWidget(Qt::LeftDockWidgetArea, stiffness);
      bench.window.tabifyDockWidget(bench.find<QDockWidget>("physicsDock"), bench.find<QDockWidget>("relaxationDock"));
      bench.find<QDockWidget>("physicsDock")->show();
      bench.find<QDockWidget>("physicsDock")->raise();
      bench.find<QDockWidget>("toolsDock")->hide();
      bench.find<QDockWidget>("frameRateDock")->setFloating(true);
      bench.trigger("showReport");
      bench.window.resizeDocks({bench.find<QDockWidget>("physicsDock")}, {420}, Qt::Horizontal);
      bench.settle();
      places = bench.window.arrangement();
      width = bench.find<QDockWidget>("physicsDock")->width();
      path = saved(bench);
    }
    QSettings().clear();
    Workbench bench;
    QVERIFY(order(bench.window.arrangement()) != order(places));
    bench.open(path);
    QCOMPARE(order(bench.window.arrangement()), order(places));
    QCOMPARE(bench.find<QDockWidget>("physicsDock")->width(), width);
    QVERIFY(bench.find<QDockWidget>("frameRateDock")->isFloating());
    const QPoint from = bench.place(0, 31);
    bench.stroke(0, {from, from + QPoint(40, 40)});
    QVERIFY(bench.document().solvers().frame(1)->statistics.passes > 0);
  }

  void aHostileLayoutLeavesAUsableWindow_data() {
    QTest::addColumn<QByteArray>("docks");
    const auto entry = [](const char* more) {
      return QByteArray(R"([{"id": "meshDock", "area": "left", "visible": true)") + more + "}]";
    };
    QTest::newRow("a number") << QByteArray("7");
    QTest::newRow("numbers") << QByteArray("[1, null, \"meshDock\", [[]], {}]");
    QTest::newRow("unknown") << QByteArray(
        R"([{"id": "nobody", "area": "left"}, {"id": "meshDock", "area": "middle"}])");
    QTest::newRow("not a dock") << QByteArray(R"([{"id": "mainToolBar", "area": "left"}, {"id": "", "area": "left"}])");
    QTest::newRow("twice") << QByteArray(
        R"([{"id": "meshDock", "area": "left"}, {"id": "meshDock", "area": "right"}])");
    QTest::newRow("tabs of itself") << entry(R"(, "tabs": "meshDock", "front": true)");
    QTest::newRow("tabs of nobody") << entry(R"(, "tabs": "nobody", "front": true)");
    QTest::newRow("huge") << entry(R"(, "size": [1e300, 1e300])");
    QTest::newRow("negative") << entry(R"(, "size": [-5, -1e9])");
    QTest::newRow("huge and floating") << entry(R"(, "floating": true, "size": [1e9, 1e9], "position": [0, 0])");
    QTest::newRow("far away") << entry(R"(, "floating": true, "size": [200, 200], "position": [1e300, -1e300])");
    QTest::newRow("wrong types") << entry(R"(, "floating": "yes", "size": "big", "position": [1], "tabs": 3)");
    QByteArray many("[");
    for (int i = 0; i < 20'000; ++i) {
      many += R"({"id": "meshDock", "area": "left", "visible": true},)";
    }
    QTest::newRow("many") << many + "{}]";
  }

  void aHostileLayoutLeavesAUsableWindow() {
    QFETCH(const QByteArray, docks);
    Workbench bench;
    const QString path = saved(bench);
    QFile file(path);
    QVERIFY(file.open(QIODevice::ReadOnly));
    QByteArray text = file.readAll();
    file.close();
    text = text.left(text.lastIndexOf("\"ui\"")) + R"("ui": {"docks": )" + docks + "}}\n";
    QVERIFY(file.open(QIODevice::WriteOnly));
    file.write(text);
    file.close();
    const QSize size = bench.window.size();
    bench.open(path);
    QVERIFY2(!bench.window.messages().isVisible(), qPrintable(bench.window.messages().sentence()));
    QCOMPARE(bench.window.size(), size);
    const QRect screen = bench.window.screen()->geometry();
    for (const auto* dock : bench.window.findChildren<QDockWidget*>()) {
      QVERIFY2(!dock->isFloating() || screen.contains(dock->geometry()),
               qPrintable(QStringLiteral("%1, %2").arg(dock->geometry().x()).arg(dock->geometry().y())));
    }
    const QPoint from = bench.place(0, 31);
    bench.stroke(0, {from, from + QPoint(40, 40)});
    QVERIFY(bench.document().solvers().frame(1)->statistics.passes > 0);
  }

  void aHostileCameraLooksAtTheObject() {
    Workbench bench(generate({MeshKind::tetra, {4, 3, 3}, 1, {}}));
    const QString path = saved(bench);
    QJsonObject session = objectIn(path);
    const QJsonObject camera{{QStringLiteral("yaw"), 1e300},
                             {QStringLiteral("pitch"), -1e300},
                             {QStringLiteral("height"), 1e300},
                             {QStringLiteral("centre"), QJsonArray{1e300, QStringLiteral("x"), 0}}};
    session[QStringLiteral("ui")] = QJsonObject{{QStringLiteral("cameras"), QJsonArray{camera, 3, camera, camera}}};
    write(path, session);
    bench.open(path);
    const Camera::Pose pose = bench.view(0).camera()->pose();
    QVERIFY(std::abs(pose.yaw) <= 180 && std::abs(pose.pitch) <= 90 && std::isfinite(pose.height));
    const QMatrix4x4 seen = bench.view(0).camera()->toClip(bench.view(0).size()) * bench.view(0).camera()->toView();
    QVERIFY(std::all_of(seen.constData(), seen.constData() + 16, [](float one) { return std::isfinite(one); }));
    bench.trigger("fitView");
    bench.settle();
    QVERIFY(bench.view(0).rect().contains(bench.place(0, 0)));
  }

  void hostileFilesOpenOrGiveASentence_data() {
    QTest::addColumn<QString>("path");
    for (const QFileInfo& file : QDir(sourceFile("tests/cli/hostile")).entryInfoList(QDir::Files)) {
      QTest::newRow(qPrintable(file.fileName())) << file.filePath();
    }
  }

  void hostileFilesOpenOrGiveASentence() {
    QFETCH(const QString, path);
    QVERIFY(QFile::copy(sourceFile("meshes/sphere.obj"), folder_.filePath(QStringLiteral("grid.obj"))) ||
            QFile::exists(folder_.filePath(QStringLiteral("grid.obj"))));
    const QString copy = folder_.filePath(QFileInfo(path).fileName());
    QVERIFY(QFile::copy(path, copy));
    Workbench bench;
    bench.open(copy);
    const QString sentence = bench.window.messages().isVisible() ? bench.window.messages().sentence() : QString();
    QVERIFY2(sentence.isEmpty() || sentence.startsWith(copy), qPrintable(sentence));
    QCOMPARE(sentence.isEmpty(), bench.window.windowTitle().startsWith(QFileInfo(copy).fileName()));
    const QPoint middle = bench.view(0).rect().center();
    bench.stroke(0, {middle, middle + QPoint(20, 10)});
    QVERIFY(bench.window.isVisible());
  }

  /// A lesson whose texts are markup, in a session and a mesh whose names are markup.
  void textsFromOutsideArePlain() {
    Workbench bench;
    QJsonObject session = objectIn(saved(bench));
    const QString path = folder_.filePath(QString(markup).remove(QLatin1Char('/')) + QStringLiteral(".chainmail"));
    session[QStringLiteral("name")] = markup;
    session[QStringLiteral("lesson")] = lessonOf(markup);
    write(path, session);
    bench.open(path);
    QVERIFY(bench.window.messages().sentence().contains(QStringLiteral("<img")));  // a colour that nobody knows
    checkLabels(bench);
    checkTip(widgetOf(bench, "lessonTitle"));
    session.remove(QStringLiteral("lesson"));
    write(path, session);
    bench.open(path);
    checkTip(widgetOf(bench, "undo"));
    checkLabels(bench);
    bench.open(folder_.filePath(QStringLiteral("<img src=x>.obj")));  // there is no such file, which a message says
    QVERIFY(bench.window.messages().sentence().contains(QStringLiteral("<img")));
    checkLabels(bench);
  }

  void questionsShowPlainText() {
    QMessageBox box(QMessageBox::Question, markup, markup, QMessageBox::Ok);
    box.setInformativeText(markup);
    box.show();
    QVERIFY(QTest::qWaitForWindowExposed(&box));
    int labels = 0;
    for (const auto* label : box.findChildren<QLabel*>()) {
      labels += label->text() == markup ? 1 : 0;
      QVERIFY(label->textFormat() == Qt::PlainText);
    }
    QCOMPARE(labels, 2);
  }

  /// The titles of plots contain names of objects and algorithms.
  void aPlotEscapesItsTexts() {
    const QString path = folder_.filePath(QStringLiteral("plot.svg"));
    report::Plot plot;
    plot.title = markup.toStdString();
    plot.panels.emplace_back().title = markup.toStdString();
    savePlot(plot, path);
    QFile file(path);
    QVERIFY(file.open(QIODevice::ReadOnly));
    QXmlStreamReader xml(&file);
    bool named = false;
    while (!xml.atEnd()) {
      xml.readNext();
      QVERIFY(!xml.isStartElement() || (xml.name() != QLatin1String("img") && xml.name() != QLatin1String("b")));
      named = named || (xml.isCharacters() && xml.text().contains(QStringLiteral("<img")));
    }
    QVERIFY2(!xml.hasError(), qPrintable(xml.errorString()));
    QVERIFY(named);
  }

 private:
  static QJsonObject lessonOf(const QString& colour) {
    const QJsonObject step{{QStringLiteral("title"), markup},
                           {QStringLiteral("text"), markup},
                           {QStringLiteral("until"), 0},
                           {QStringLiteral("colour"), colour},
                           {QStringLiteral("show"), QStringLiteral("links")}};
    return {{QStringLiteral("title"), markup}, {QStringLiteral("steps"), QJsonArray{step}}};
  }

  /// Saves the session and returns its path.
  QString saved(Workbench& bench) {
    const QString path = folder_.filePath(QStringLiteral("a.chainmail"));
    bench.window.sessions().savePath(path);
    bench.settle();
    return path;
  }

  /// Returns the widget of this name, or the button of the tool bar for the action of this name.
  static QWidget* widgetOf(Workbench& bench, const char* name) {
    if (auto* action = bench.window.findChild<QAction*>(QLatin1String(name))) {
      return bench.find<QToolBar>("mainToolBar")->widgetForAction(action);
    }
    return bench.window.findChild<QWidget*>(QLatin1String(name));
  }

  /// The tool tip of the widget shows markup as text.
  static void checkTip(QWidget* widget) {
    QVERIFY(widget != nullptr && widget->toolTip().contains(QStringLiteral("<img")));
    const QLabel* tip = shownTip(*widget);
    QVERIFY(tip != nullptr && tip->text().contains(QStringLiteral("<img")));
    QVERIFY(tip->textFormat() == Qt::PlainText);
  }

  /// No label may find out by itself that a text is rich, and none of those with rich text shows markup of a file.
  static void checkLabels(Workbench& bench) {
    int shown = 0;
    for (const auto* label : bench.window.findChildren<QLabel*>()) {
      if (label->isVisible()) {
        QVERIFY2(label->textFormat() != Qt::AutoText, qPrintable(label->objectName()));
        shown += label->text().contains(QStringLiteral("img")) ? 1 : 0;
      }
      QVERIFY2(label->textFormat() != Qt::RichText || !label->text().contains(QStringLiteral("<img")),
               qPrintable(label->objectName() + QStringLiteral(": ") + label->text()));
    }
    QVERIFY(shown >= 2);
  }

  QTemporaryDir folder_;
};

CHAINMAIL_WINDOW_TEST(WindowForeign)

}  // namespace chainmail::window_foreign

#include "window_foreign.moc"
