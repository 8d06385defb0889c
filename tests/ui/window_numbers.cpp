// Tests that every number that the window shows of an object is that of its positions: each place (sentence, large
// number, figures, tooltip, legend, heads, docks, plot, status bar, label over the view, report) after each way in
// which an object changes. The test computes the numbers itself.

#include <QComboBox>
#include <QDockWidget>
#include <QFile>
#include <QLabel>
#include <QRegularExpression>
#include <QTableWidget>
#include <algorithm>
#include <cmath>
#include <memory>
#include <numeric>

#include "core/families.h"
#include "files/results/results_json.h"
#include "io/pictures.h"
#include "panels/legend.h"
#include "panels/panel_state.h"
#include "report_bench.h"
#include "session_bench.h"

namespace chainmail::window_numbers {

namespace {

constexpr ElementId columns = 7, rows = 5;

/// Returns a plate of triangles that is turned in its plane, so that its axes are not those of the world.
MeshPointer plate() {
  MeshParts parts;
  for (ElementId e = 0; e < columns * rows; ++e) {
    const double x = e % columns, y = e / columns;
    parts.rest.emplace_back(0.8 * x - 0.6 * y, 0.6 * x + 0.8 * y, 0);
  }
  for (ElementId a = 0; a + columns + 1 < columns * rows; ++a) {
    if (a % columns + 1 < columns) {
      test::add_triangle(parts, a, a + 1, a + columns + 1);
      test::add_triangle(parts, a, a + columns + 1, a + columns);
    }
  }
  return build_mesh(std::move(parts));
}

/// The ends of the measured distance: the pin, and beside the handle.
constexpr ElementId first = 0;
ElementId second(const Mesh& mesh) { return std::min<ElementId>(columns * rows, mesh.element_count()) - 2; }

/// Moves the last element away from the first one. Sequential algorithms violate the links at the pin.
void pullFromAPin(Workbench& bench) {
  edits::setPinned(bench.document(), {0}, true);
  drag(bench.document(), bench.document().mesh()->element_count() - 1, {3, 1.5, 0});
  bench.settle();
}

/// Returns the links that join the first three columns to the others.
std::vector<LinkId> seam(const Mesh& mesh) {
  std::vector<LinkId> links;
  for (LinkId link = 0; link < mesh.link_count(); ++link) {
    const auto [a, b] = mesh.links[link];
    if ((a % columns < 3) != (b % columns < 3)) {
      links.push_back(link);
    }
  }
  return links;
}

/// Splits a triangle into three.
void splitAFace(Document& document) {
  const auto [a, b, c] = document.mesh()->triangles[7];
  const ElementId p = document.mesh()->element_count();
  std::array corners{a, b, c};
  std::ranges::sort(corners);
  edits::split(document,
               make_split(document.mesh(), {{{corners, {0.25, 0.5}}}, {7}, {{a, b, p}, {b, c, p}, {c, a, p}}, {}, {}}));
}

/// A way in which an object changes.
struct Condition {
  const char* name;
  void (*reach)(Workbench& bench);
};

constexpr std::array conditions{
    Condition{"at rest", [](Workbench&) {}},
    Condition{"dragged",
              [](Workbench& bench) {
                drag(bench.document(), columns * rows - 1, {-2, 1, 0});
              }},
    Condition{"pinned", pullFromAPin},
    Condition{"pinned, and the algorithm of a panel stops at pins",
              [](Workbench& bench) {
                edits::setAlgorithm(bench.document(), 1, Algorithm::exact);
                pullFromAPin(bench);
              }},
    Condition{"cut after the drag",
              [](Workbench& bench) {
                pullFromAPin(bench);
                edits::cut(bench.document(), seam(*bench.document().mesh()));
              }},
    Condition{"cut before the drag",
              [](Workbench& bench) {
                edits::cut(bench.document(), {1, 30, 40});
                pullFromAPin(bench);
              }},
    Condition{"split",
              [](Workbench& bench) {
                pullFromAPin(bench);
                splitAFace(bench.document());
                drag(bench.document(), columns * rows, {1, 2, 0});
              }},
    Condition{"turned axes",
              [](Workbench& bench) {
                edits::setRegionAxes(bench.document(), AxesKind::object);
                pullFromAPin(bench);
              }},
    Condition{"softness of a link, after the drag",
              [](Workbench& bench) {
                pullFromAPin(bench);
                edits::setSoftnessOf(bench.document(), {0, 5}, LinkSoftness{0.99, 1.01, 0.01});
              }},
    Condition{"not settled",
              [](Workbench& bench) {
                pullFromAPin(bench);
                edits::setRelaxation(bench.document(), {true, 0.1, RelaxationScheme::mean});
                bench.awaitFrames();
                edits::setRelaxation(bench.document(), {false, 0.1, RelaxationScheme::mean});
              }},
    Condition{"unlinked",
              [](Workbench& bench) {
                for (const char* link : {"linkCameras", "linkColours", "linkMarks"}) {
                  bench.trigger(link);
                }
                pullFromAPin(bench);
              }},
    Condition{"a third panel",
              [](Workbench& bench) {
                bench.trigger("addPanel");
                bench.settle();
                pullFromAPin(bench);
              }},
    Condition{"undone",
              [](Workbench& bench) {
                pullFromAPin(bench);
                bench.document().undo();
              }},
    Condition{"another object",
              [](Workbench& bench) {
                pullFromAPin(bench);
                edits::replaceMesh(bench.document(), generate({MeshKind::cloth, {6, 5, 1}, 0.7, 3}),
                                   QStringLiteral("other"), QStringLiteral("build"));
              }},
    Condition{"another object, dragged", [](Workbench& bench) {
                edits::replaceMesh(bench.document(), generate({MeshKind::cloth, {6, 5, 1}, 0.7, 3}),
                                   QStringLiteral("other"), QStringLiteral("build"));
                bench.settle();
                pullFromAPin(bench);
              }}};

QString exactly(double value) { return QLocale().toString(value, 'g', 6); }

/// Returns coordinates such as 'x 3, y 2.5'.
QString coordinatesOf(const Mesh& mesh, const Point& point, const QString& prefix = {}) {
  QStringList all;
  for (int k = 0; k < mesh.space_dimension; ++k) {
    const auto axis = std::size_t(mesh.axes[std::size_t(k)]);
    all << prefix + QLatin1Char("xyz"[axis]) + QLatin1Char(' ') + exactly(point[Eigen::Index(axis)]);
  }
  return all.join(QStringLiteral(", "));
}

/// True if a rounded number is this value. Solvers measure before positions are rounded for the screen.
bool is(const QString& shown, double value, double rounding) {
  bool isNumber = false;
  const double number = QLocale().toDouble(shown, &isNumber);
  return isNumber && std::abs(number - value) <= rounding * std::abs(value) + 1e-5;
}
constexpr double twoDigits = 0.051, threeDigits = 0.0051;

/// Returns what a pattern captures in a text; an empty list if it does not match.
QStringList captured(const QString& text, const QString& pattern) {
  return QRegularExpression(pattern).match(text).capturedTexts().mid(1);
}

QString plain(const QString& rich) {
  return QString(rich).remove(QStringLiteral("<b>")).remove(QStringLiteral("</b>"));
}

QString share(double fraction) {
  return fraction > 0 && fraction < 0.01   ? QStringLiteral("< 1 %")
         : fraction < 1 && fraction > 0.99 ? QStringLiteral("> 99 %")
                                           : QStringLiteral("%1 %").arg(std::lround(100 * fraction));
}

}  // namespace

class WindowNumbers : public QObject {
  Q_OBJECT

 private slots:
  void initTestCase() {
    QSettings().clear();
    bench_ = std::make_unique<Workbench>(plate());
    bench_->trigger("colourBy-violation");
    bench_->trigger("showFigures");
    auto* quantity = bench_->find<QComboBox>("rateQuantity");
    quantity->setCurrentIndex(quantity->findData(QStringLiteral("violation-max")));
    emit quantity->activated(quantity->currentIndex());
    for (const char* dock : {"elementDock", "meshDock"}) {
      bench_->find<QDockWidget>(dock)->show();
    }
  }
  void init() { failOnWarnings(); }

  /// Brings the window back to its first state.
  void cleanup() {
    Document& document = bench_->document();
    QTest::keyClick(&bench_->window, Qt::Key_Escape);  // the measured distance
    bench_->trigger("toolDrag");
    document.selection().set({});
    document.highlight().set({});
    for (const char* link : {"linkCameras", "linkColours", "linkMarks"}) {
      if (!bench_->find<QAction>(link)->isChecked()) {
        bench_->trigger(link);
      }
    }
    while (document.panels() > 2) {
      document.removePanel();
    }
    while (document.undoStack().canUndo()) {
      document.undo();
    }
    bench_->trigger("fitView");
    bench_->settle();
  }
  void cleanupTestCase() { bench_.reset(); }

  void everyNumberIsThatOfThePositions_data() {
    QTest::addColumn<std::size_t>("condition");
    for (std::size_t i = 0; i < conditions.size(); ++i) {
      QTest::newRow(conditions[i].name) << i;
    }
  }
  void everyNumberIsThatOfThePositions() {
    QFETCH(std::size_t, condition);
    conditions[condition].reach(*bench_);
    bench_->settleFigures();
    bench_->document().highlight().set({});
    const auto places = {&WindowNumbers::violationsOfPanels, &WindowNumbers::plottedViolations, &WindowNumbers::counts,
                         &WindowNumbers::everyElement, &WindowNumbers::measuredDistance};
    for (const auto place : places) {
      (this->*place)();
      if (QTest::currentTestFailed()) {
        return;
      }
    }
  }

  /// The report repeats the last drag on the object as it is: with its pins, cuts and axes.
  void aReportOfTheLastDragHasTheViolationsOfThePanels() {
    ReportBench bench(plate());
    edits::setRegionAxes(bench.document(), AxesKind::object);
    edits::cut(bench.document(), {1, 30, 40});
    pullFromAPin(bench);
    bench.check("reportDrags", {myLastDrag});
    bench.choose("reportSweeps", 0);
    bench.run();
    const QTemporaryDir folder;
    bench.results().saveTo(folder.path());
    const report::Results saved = read_results(folder.filePath(QStringLiteral("report.json")).toStdString());
    for (int panel = 0; panel < 2; ++panel) {
      const double expected = violationOf(bench, panel).max;
      QVERIFY(expected > 0.1);
      const Algorithm algorithm = bench.document().algorithm(panel);
      const auto row = std::ranges::find_if(
          saved.rows, [&](const report::Row& one) { return one.contestant.algorithm == algorithm; });
      QVERIFY(row != saved.rows.end());
      const double inJson = row->find(report::figures::violation_max)->number;
      QVERIFY2(std::abs(inJson - expected) < 1e-4 * expected, qPrintable(QString::number(inJson)));
      const QString name = text(info(algorithm).label).remove(QStringLiteral(" ChainMail"));
      QVERIFY2(is(bench.cell(name, violationColumn), expected, threeDigits),
               qPrintable(name + QLatin1Char(' ') + bench.cell(name, violationColumn)));
    }
  }

 private:
  /// The violation of a link: the distance from its valid region (Li and Brodlie 2003), in rest lengths.
  static double violationOf(Workbench& bench, int panel, LinkId link) {
    const Mesh& mesh = *bench.document().mesh();
    const auto [a, b] = mesh.links[link];
    const LinkSoftness& softness = bench.document().wholeSoftness()->of(link);
    const Eigen::Matrix3d intoAxes = bench.document().wholeSoftness()->axes.matrix().transpose();
    const Point rest = intoAxes * (mesh.rest_position(b) - mesh.rest_position(a));
    const Point now = intoAxes * (bench.position(panel, b) - bench.position(panel, a));
    double square = 0;
    for (int k = 0; k < 3; ++k) {
      const double lean = softness.shear * (rest.cwiseAbs().sum() - std::abs(rest[k]));
      const auto [low, high] = std::minmax({softness.compression * rest[k], softness.stretch * rest[k]});
      const double outside = std::max({low - lean - now[k], now[k] - high - lean, 0.0});
      square += outside * outside;
    }
    return std::sqrt(square) / rest.norm();
  }

  struct Violations {
    double max = 0, rms = 0, fraction = 0;
  };
  static Violations violationOf(Workbench& bench, int panel) {
    Violations all;
    int links = 0;
    for (LinkId link = 0; link < bench.document().mesh()->link_count(); ++link) {
      if (!bench.document().cuts().is_cut(link)) {
        const double one = violationOf(bench, panel, link);
        all.max = std::max(all.max, one);
        all.rms += one * one;
        all.fraction += one > 1e-4 ? 1 : 0;
        ++links;
      }
    }
    return {all.max, std::sqrt(all.rms / links), all.fraction / links};
  }

  void violationsOfPanels() {
    double largest = 0;
    for (int panel = 0; panel < bench_->document().panels(); ++panel) {
      largest = std::max(largest, violationOf(*bench_, panel).max);
    }
    for (int panel = 0; panel < bench_->document().panels() && !QTest::currentTestFailed(); ++panel) {
      const Violations own = violationOf(*bench_, panel);
      inWords(panel, own);
      inFigures(panel, own);
      const double highest = bench_->window.colouring().sharesScale() ? largest : own.max;
      const Legend& legend = bench_->window.panel(panel).legend();
      QTRY_VERIFY2(highest < 1e-3 || is(legend.highest(), highest, threeDigits), qPrintable(legend.highest()));
    }
  }

  void inWords(int panel, const Violations& own) {
    const auto& line = *bench_->find<ViolationLine>(qPrintable(QStringLiteral("violation%1").arg(panel)));
    QCOMPARE(line.findChild<QLabel*>(QStringLiteral("number"))->text(), share(own.fraction));  // in lecture mode
    const QStringList said =
        captured(line.sentence(), QStringLiteral("^(.+ %) of links violated, worst (\\S+) × rest length$"));
    // What relaxation to the material has not reached is said in its place.
    const bool isOfRelaxation = QTest::currentDataTag() == QLatin1String("not settled") &&
                                line.sentence().startsWith(QStringLiteral("relaxation "));
    if (own.fraction == 0 || isOfRelaxation) {
      QVERIFY2(said.isEmpty(), qPrintable(line.sentence()));
    } else {
      QVERIFY2(said.size() == 2 && said[0] == share(own.fraction) && is(said[1], own.max, twoDigits),
               qPrintable(line.sentence()));
    }
    isSaid(line.toolTip(), own);
  }

  /// Narrow panels show only the first figures. What a solver reports takes their place.
  void inFigures(int panel, const Violations& own) {
    if (!bench_->document().solvers().statistics(panel).remark.empty()) {
      return;
    }
    const QString figures = plain(bench_->find<QLabel>(qPrintable(QStringLiteral("statistics%1").arg(panel)))->text());
    const QStringList largest = captured(figures, QStringLiteral("max (\\S+)"));
    QVERIFY2(largest.size() == 1 && is(largest[0], own.max, threeDigits), qPrintable(figures));
    if (figures.endsWith(QLatin1Char('%'))) {
      isSaid(figures, own);
    }
  }

  static void isSaid(const QString& text, const Violations& own) {
    const QStringList said = captured(text, QStringLiteral("max (\\S+) · RMS (\\S+) · (\\S+) %"));
    QVERIFY2(said.size() == 3 && is(said[0], own.max, threeDigits) && is(said[1], own.rms, threeDigits) &&
                 std::abs(QLocale().toDouble(said[2]) - 100 * own.fraction) <= 0.0501,
             qPrintable(text));
  }

  /// The last point of each line of the rate dock.
  void plottedViolations() {
    for (int panel = 0; panel < bench_->document().panels(); ++panel) {
      const double expected = violationOf(*bench_, panel).max;
      const auto isPlotted = [&] {
        std::array last{-1.0, 0.0};
        for (const report::PlotCurve& curve : bench_->find<PlotWidget>("ratePlot")->plot().panels.front().curves) {
          if (curve.series == std::size_t(panel) && !curve.points.empty()) {
            last = std::max(last, curve.points.back());
          }
        }
        return std::abs(last[1] - expected) <= 1e-5 + 1e-4 * expected;
      };
      QTRY_VERIFY2(isPlotted(), qPrintable(QString::number(panel)));
    }
  }

  /// Counts of the object, in the Mesh dock and in the heads of the panels.
  void counts() {
    const Document& document = bench_->document();
    const int parts = partsNow();
    const std::size_t cuts = document.cuts().count(), pins = document.pins().size();
    const QString about = bench_->find<QLabel>("meshDescription")->text();
    QString expected = QStringLiteral("%1 elements, %2 links").arg(document.mesh()->element_count()).arg(linksNow());
    expected += cuts > 0 ? QStringLiteral(", %1 cut").arg(cuts) : QString();
    expected += parts > 1 ? QStringLiteral(", %1 parts").arg(parts) : QString();
    QCOMPARE(about.section(QStringLiteral("<br>"), 1, 1), expected);
    for (int panel = 0; panel < document.panels(); ++panel) {
      const QStringList states = bench_->find<QLabel>(qPrintable(QStringLiteral("state%1").arg(panel)))
                                     ->text()
                                     .split(QStringLiteral(" · "), Qt::SkipEmptyParts) +
                                 bench_->window.panel(panel).findChild<StateChips*>()->states();
      QCOMPARE(states.filter(QStringLiteral("parts")).join(QString()),
               parts > 1 ? QStringLiteral("%1 parts").arg(parts) : QString());
      QCOMPARE(states.filter(QStringLiteral("pinned")).join(QString()),
               pins > 0 ? QStringLiteral("%1 pinned").arg(pins) : QString());
    }
  }

  std::size_t linksNow() const {
    std::size_t ends = 0;
    for (ElementId e = 0; e < bench_->document().mesh()->element_count(); ++e) {
      ends += bench_->document().mesh()->neighbours_of(e).size();
    }
    return ends / 2;
  }

  /// Gives the ends of each uncut link the lower number of both until nothing changes.
  int partsNow() const {
    const Mesh& mesh = *bench_->document().mesh();
    std::vector<ElementId> part(mesh.element_count());
    std::iota(part.begin(), part.end(), ElementId{0});
    for (bool changed = true; changed;) {
      changed = false;
      for (LinkId link = 0; link < mesh.link_count(); ++link) {
        auto &a = part[mesh.links[link][0]], &b = part[mesh.links[link][1]];
        if (!bench_->document().cuts().is_cut(link) && a != b) {
          a = b = std::min(a, b);
          changed = true;
        }
      }
    }
    std::ranges::sort(part);
    return int(std::unique(part.begin(), part.end()) - part.begin());
  }

  void everyElement() {
    for (ElementId e = 0; e < bench_->document().mesh()->element_count() && !QTest::currentTestFailed(); ++e) {
      inTheStatusBar(e);
      inTheElementDock(e);
    }
    bench_->document().highlight().set({});
  }

  /// True if the status bar leaves out a panel after the first two.
  static bool hasNoRoom(const QString& text, int panel) {
    return panel > 1 && !text.contains(panelName(panel) + QStringLiteral(": "));
  }

  void inTheStatusBar(ElementId element) {
    const Mesh& mesh = *bench_->document().mesh();
    bench_->document().highlight().set({element, false, {}});
    const QString text = plain(bench_->find<QLabel>("readout")->text());
    for (int panel = 0; panel < bench_->document().panels(); ++panel) {
      double violation = 0;
      for (const ElementId other : mesh.neighbours_of(element)) {
        const LinkId link = *find_link(mesh, element, other);
        violation =
            bench_->document().cuts().is_cut(link) ? violation : std::max(violation, violationOf(*bench_, panel, link));
      }
      const QString at =
          panelName(panel) + QStringLiteral(": ") + coordinatesOf(mesh, bench_->position(panel, element));
      const QStringList said = captured(text, at + QStringLiteral(", violation (\\S+)"));
      QVERIFY2((said.size() == 1 && is(said[0], violation, threeDigits)) || hasNoRoom(text, panel),
               qPrintable(at + QLatin1Char('\n') + text));
    }
  }

  void inTheElementDock(ElementId element) {
    const Mesh& mesh = *bench_->document().mesh();
    bench_->document().selection().set({element});
    const auto cell = [this](const char* table, int row, int column) {
      return bench_->find<QTableWidget>(table)->item(row, column)->text();
    };
    for (int row = 0; row <= bench_->document().panels(); ++row) {
      const Point at = row == 0 ? mesh.rest_position(element) : bench_->position(row - 1, element);
      for (int k = 0; k < mesh.space_dimension; ++k) {
        QCOMPARE(cell("elementPositions", row, k + 1), exactly(at[mesh.axes[std::size_t(k)]]));
      }
    }
    QCOMPARE(std::size_t(bench_->find<QTableWidget>("elementNeighbours")->rowCount()),
             mesh.neighbours_of(element).size());
    for (int row = 0; row < bench_->find<QTableWidget>("elementNeighbours")->rowCount(); ++row) {
      const LinkId link = *find_link(mesh, element, cell("elementNeighbours", row, 0).toUInt());
      double violation = 0;
      for (int panel = 0; panel < bench_->document().panels(); ++panel) {
        violation = std::max(violation, violationOf(*bench_, panel, link));
      }
      const QString shown = cell("elementNeighbours", row, 4);
      QVERIFY2(
          bench_->document().cuts().is_cut(link) ? shown == QStringLiteral("cut") : is(shown, violation, threeDigits),
          qPrintable(shown));
    }
  }

  /// In the status bar for all panels, and as a label over the view of each panel.
  void measuredDistance() {
    const Mesh& mesh = *bench_->document().mesh();
    const ElementId end = second(mesh);
    bench_->trigger("toolMeasure");
    bench_->click(0, first);
    bench_->click(0, end);
    bench_->document().highlight().set({});
    const double rest = (mesh.rest_position(end) - mesh.rest_position(first)).norm();
    const QString text = plain(bench_->find<QLabel>("readout")->text());
    const QString begin = QStringLiteral("From element %1 to %2, at rest %3").arg(first).arg(end).arg(exactly(rest));
    QVERIFY2(text.startsWith(begin), qPrintable(text));
    for (int panel = 0; panel < bench_->document().panels(); ++panel) {
      const Point apart = bench_->position(panel, end) - bench_->position(panel, first);
      const QString now = exactly(apart.norm()), ratio = QLocale().toString(apart.norm() / rest, 'f', 3);
      const QString expected = QStringLiteral("%1: %2 (× %3; %4)")
                                   .arg(panelName(panel), now, ratio, coordinatesOf(mesh, apart, QStringLiteral("d")));
      QVERIFY2(text.contains(expected) || hasNoRoom(text, panel), qPrintable(expected + QLatin1Char('\n') + text));
      const QString label = now + QStringLiteral(" (rest ") + exactly(rest);
      QVERIFY2(drawn(panel).contains(label), qPrintable(label));
    }
  }

  /// Returns a panel as vector graphics, which contain the texts over its view.
  QString drawn(int panel) const {
    const QTemporaryDir folder;
    QFile file(folder.filePath(QStringLiteral("panel.svg")));
    writeDrawing(file.fileName(), drawingOf(bench_->window.panel(panel), false));
    return file.open(QIODevice::ReadOnly) ? QString::fromUtf8(file.readAll()) : QString();
  }

  std::unique_ptr<Workbench> bench_;
};

CHAINMAIL_WINDOW_TEST(WindowNumbers)

}  // namespace chainmail::window_numbers

#include "window_numbers.moc"
