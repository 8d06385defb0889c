// Tests themes, icons, messages and the first start in a real window.

#include <QAbstractButton>
#include <QLabel>
#include <QTest>
#include <QToolButton>
#include <cmath>

#include "common/icons.h"
#include "common/plot_pictures.h"
#include "common/theme.h"
#include "document/edits.h"
#include "document/panel_colour.h"
#include "drawing/colour_map.h"
#include "panels/panel_state.h"
#include "window.h"
#include "window/bars.h"

namespace chainmail::window_comfort {

using colours::Ground;

namespace {

/// Returns the relative luminance (WCAG 2.1).
double luminance(const QColor& colour) {
  const auto linear = [](double share) {
    return share <= 0.04045 ? share / 12.92 : std::pow((share + 0.055) / 1.055, 2.4);
  };
  return 0.2126 * linear(colour.redF()) + 0.7152 * linear(colour.greenF()) + 0.0722 * linear(colour.blueF());
}

double contrastOf(const QColor& one, const QColor& other) {
  const auto [low, high] = std::minmax({luminance(one), luminance(other)});
  return (high + 0.05) / (low + 0.05);
}

/// Returns the colours of all algorithms, in the shades for up to four panels, on the current ground.
std::vector<QColor> coloursOfPanels() {
  std::vector<QColor> all;
  for (const AlgorithmInfo& one : every_algorithm()) {
    for (int copy = 0; copy < Document::maxPanels; ++copy) {
      all.emplace_back(algorithmColour(one.algorithm, copy));
    }
  }
  return all;
}

constexpr double ofText = 4.5, ofMarks = 3;  // contrast ratios for level AA of WCAG 2.1 (1.4.3, 1.4.11)

}  // namespace

class WindowComfort : public QObject {
  Q_OBJECT

 private slots:
  void init() { failOnWarnings(); }
  void cleanup() {
    remember(Ground::dark);
    applyGround(Ground::dark);
  }

  void textAndMarksStandOut() {
    using Role = QPalette::ColorRole;
    const std::pair<Role, Role> texts[]{
        {QPalette::WindowText, QPalette::Window},         {QPalette::Text, QPalette::Base},
        {QPalette::Text, QPalette::AlternateBase},        {QPalette::PlaceholderText, QPalette::Base},
        {QPalette::ButtonText, QPalette::Button},         {QPalette::ToolTipText, QPalette::ToolTipBase},
        {QPalette::HighlightedText, QPalette::Highlight}, {QPalette::Link, QPalette::Window}};
    for (const Ground ground : {Ground::dark, Ground::light}) {
      applyGround(ground);
      QCOMPARE(colours::ground(), ground);
      const QPalette palette = QApplication::palette();
      for (const auto& [text, behind] : texts) {
        QVERIFY2(contrastOf(palette.color(text), palette.color(behind)) >= ofText,
                 qPrintable(QStringLiteral("%1 on %2").arg(palette.color(text).name(), palette.color(behind).name())));
      }
      for (const Role text : {QPalette::WindowText, QPalette::Text, QPalette::ButtonText}) {
        const QColor disabled = palette.color(QPalette::Disabled, text);
        for (const Role behind : {QPalette::Window, QPalette::Base, QPalette::Button}) {
          QVERIFY2(contrastOf(disabled, palette.color(behind)) >= ofText, qPrintable(disabled.name()));
        }
      }
      // The figures of a panel have the panel's colour.
      for (const QColor& colour : coloursOfPanels()) {
        QVERIFY2(contrastOf(colour, palette.color(QPalette::Window)) >= ofText, qPrintable(colour.name()));
      }
      for (const QColor mark :
           {QColor(colours::marked), QColor(colours::pinned), QColor(colours::selected), QColor(colours::lit),
            QColor(colours::inside), QColor(colours::outside), colour_map::at(0), colour_map::at(1)}) {
        QVERIFY2(contrastOf(mark, colours::background) >= ofMarks, qPrintable(mark.name()));
      }
      for (const auto& one : algorithms()) {
        const QImage mark = plotMark(one.algorithm, false, 16, 1, palette).toImage();
        QVERIFY(contrastOf(mark.pixelColor(8, 8), palette.color(QPalette::Window)) >= ofMarks);
      }
    }
  }

  void themeChangesAtOnceAndIsRemembered() {
    Workbench bench;
    const auto seen = [&](int panel) { return bench.view(panel).grabFramebuffer().pixelColor(3, 3); };
    QCOMPARE(seen(0), colours::background.on(Ground::dark));
    bench.trigger("themeLight");
    bench.settle();
    QCOMPARE(seen(0), colours::background.on(Ground::light));
    QCOMPARE(seen(1), colours::background.on(Ground::light));
    QVERIFY(
        bench.find<QLabel>("rateName0")->text().contains(panelColour(bench.document(), 0).on(Ground::light).name()));
    QCOMPARE(rememberedGround(), Ground::light);
    bench.trigger("themeDark");
    bench.settle();
    QCOMPARE(seen(0), colours::background.on(Ground::dark));
    QCOMPARE(rememberedGround(), Ground::dark);
  }

  /// Otherwise the next click would hit something else.
  void aMessageMovesNothing() {
    Workbench bench;
    const auto place = [&bench] { return QRect(bench.view(0).mapTo(&bench.window, QPoint()), bench.view(0).size()); };
    const QRect before = place();
    MessageBar& bar = bench.window.messages();
    bar.say(QStringLiteral("A long sentence that says what failed and what to do. ").repeated(8));
    bench.settle();
    QCOMPARE(place(), before);
    const auto* text = bench.find<QLabel>("message");
    const auto whole = [&] { return QRect(bench.window.area().mapFromGlobal(bar.mapToGlobal(QPoint())), bar.size()); };
    const auto isWhole = [&] {
      return bar.isVisible() && bench.window.area().rect().contains(whole()) &&
             text->height() >= text->heightForWidth(text->width());
    };
    QVERIFY(isWhole());
    bench.window.resize(bench.window.size() - QSize(0, 60));
    bench.settle();
    QVERIFY(isWhole());
    // Where it was, the views get the mouse again.
    const QPoint there = whole().center();
    QVERIFY(!bench.window.area().isAncestorOf(bench.window.childAt(bench.window.area().mapTo(&bench.window, there))));
    bar.clear();
    bench.settle();
    QVERIFY(bench.window.area().isAncestorOf(bench.window.childAt(bench.window.area().mapTo(&bench.window, there))));
  }

  void messagesWaitAndAreDismissedOneByOne() {
    Workbench bench;
    MessageBar& bar = bench.window.messages();
    bar.note(QStringLiteral("first"));
    bar.say(QStringLiteral("second"));
    bar.warn(QStringLiteral("third"));
    bar.say(QStringLiteral("second"));  // a repeated message becomes the newest and is not counted again
    QCOMPARE(bar.count(), 3);
    QCOMPARE(bar.sentence(), QStringLiteral("second"));
    QCOMPARE(bar.severity(), Severity::error);
    QCOMPARE(bench.find<QLabel>("messagesWaiting")->text(), QStringLiteral("1 of 3"));
    QTest::keyClick(&bench.view(0), Qt::Key_Escape);
    QCOMPARE(bar.sentence(), QStringLiteral("third"));
    QCOMPARE(bar.severity(), Severity::warning);
    QTest::mouseClick(bench.find<QToolButton>("dismiss"), Qt::LeftButton);
    QCOMPARE(bar.sentence(), QStringLiteral("first"));
    QCOMPARE(bar.severity(), Severity::info);
    QVERIFY(!bench.find<QToolButton>("dismissAll")->isVisible());
    bar.dismiss();
    QVERIFY(!bar.isVisible());
    bar.say(QStringLiteral("fourth"));
    bar.say(QStringLiteral("fifth"));
    QVERIFY(bench.find<QToolButton>("dismissAll")->isVisible());
    QTest::mouseClick(bench.find<QToolButton>("dismissAll"), Qt::LeftButton);
    QVERIFY(!bar.isVisible());
    QCOMPARE(bar.count(), 0);
  }

  void firstStartShowsAnExampleThatLeavesNothingBehind() {
    QSettings().remove(QStringLiteral("hintsSeen"));
    Workbench bench;
    const ElementId moved = bench.document().mesh()->element_count() * 4 / 5;
    const std::array rest{bench.position(0, moved), bench.position(1, moved)};
    bench.window.welcome();
    MessageBar& bar = bench.window.messages();
    QVERIFY(bar.isVisible() && bar.sentence().startsWith(QStringLiteral("Drag an element")));
    // It lies over the views, but neither over what is dragged nor over a sentence.
    QCoreApplication::processEvents();
    const QRect ofBar(bar.mapToGlobal(QPoint()), bar.size());
    for (int panel = 0; panel < 2; ++panel) {
      const auto* sentence = bench.find<QWidget>(qPrintable(QStringLiteral("violation%1").arg(panel)));
      QVERIFY(!ofBar.contains(bench.view(panel).mapToGlobal(bench.place(panel, moved))));
      QVERIFY(!ofBar.intersects(QRect(sentence->mapToGlobal(QPoint()), sentence->size())));
    }
    QTRY_VERIFY(bench.position(0, moved) != rest[0] && bench.position(1, moved) != rest[1]);
    const QPoint at = bench.place(0, moved);
    QTest::mousePress(&bench.view(0), Qt::LeftButton, {}, at);
    QTest::mouseRelease(&bench.view(0), Qt::LeftButton, {}, at);
    QTRY_VERIFY(bench.position(0, moved) == rest[0] && bench.position(1, moved) == rest[1]);
    QCOMPARE(bench.document().undoStack().count(), 0);
    QVERIFY(bench.document().moves().lastDrag().empty());
    QVERIFY(bar.isVisible());  // the user may still read it
    QTest::keyClick(&bench.view(0), Qt::Key_Escape);
    QVERIFY(!bar.isVisible());
  }

  /// What the user grabs while the example runs is at rest for the solvers, so that undo returns to that.
  void aDragThatEndsTheExampleBeginsAtRest() {
    QSettings().remove(QStringLiteral("hintsSeen"));
    Workbench bench;
    const ElementId moved = bench.document().mesh()->element_count() * 4 / 5;
    const std::array rest{bench.position(0, moved), bench.position(1, moved)};
    bench.window.welcome();
    QTRY_VERIFY(bench.position(0, moved) != rest[0] && bench.position(1, moved) != rest[1]);
    const QPoint from = bench.place(0, 31);
    bench.stroke(0, {from, from + QPoint(120, -80)});
    QCOMPARE(bench.document().undoStack().count(), 1);
    bench.document().undo();
    QTRY_VERIFY(bench.position(0, moved) == rest[0] && bench.position(1, moved) == rest[1]);
  }

  void keyEndsTheExampleTooAndTheSecondStartShowsNone() {
    QSettings().remove(QStringLiteral("hintsSeen"));
    const auto first = std::make_unique<Workbench>();
    const ElementId moved = first->document().mesh()->element_count() * 4 / 5;
    const Point rest = first->position(0, moved);
    first->window.welcome();
    QTRY_VERIFY(first->position(0, moved) != rest);
    QTest::keyClick(&first->view(0), Qt::Key_Z, Qt::ControlModifier);
    first->settle();
    QTRY_COMPARE(first->position(0, moved), rest);
    QVERIFY(!first->document().undoStack().canRedo());
    Workbench second;
    second.window.welcome();
    second.settle();
    QVERIFY(!second.window.messages().isVisible());
    QCOMPARE(second.position(0, moved), rest);
  }

  /// With a coloured mark, the action would look as if it could be chosen.
  void disabledIconsHaveOneColour() {
    const QColor faint = QApplication::palette().color(QPalette::Disabled, QPalette::ButtonText);
    const auto isFaint = [&](const QColor& at) {  // rounded where lines cross
      return std::abs(at.red() - faint.red()) <= 4 && std::abs(at.green() - faint.green()) <= 4 &&
             std::abs(at.blue() - faint.blue()) <= 4;
    };
    for (const QString& name : iconNames()) {
      const QImage drawn = icon(qPrintable(name)).pixmap(32, QIcon::Disabled).toImage();
      for (int i = 0; i < drawn.width() * drawn.height(); ++i) {
        const QColor at = drawn.pixelColor(i % drawn.width(), i / drawn.width());
        if (at.alpha() == 255) {
          QVERIFY2(isFaint(at), qPrintable(name + QLatin1Char(' ') + at.name()));
        }
      }
    }
  }

  // Also runs at several scales (CMakeLists.txt).
  void noWordIsCutOffAndIconsHaveTheScreensPixels() {
    Workbench bench;
    bench.window.messages().say(QStringLiteral("a sentence"));
    bench.settle();
    for (const QWidget* widget : bench.window.findChildren<QWidget*>()) {
      const auto* label = qobject_cast<const QLabel*>(widget);
      const auto* button = qobject_cast<const QAbstractButton*>(widget);
      const QString words = label != nullptr ? label->text() : button != nullptr ? button->text() : QString();
      const bool wraps = label != nullptr && label->wordWrap();
      const bool gives = widget->sizePolicy().horizontalPolicy() == QSizePolicy::Ignored;
      if (widget->isVisible() && !words.isEmpty() && !wraps && !gives) {
        const QSize wanted = widget->minimumSizeHint();
        QVERIFY2(widget->width() >= wanted.width() && widget->height() >= wanted.height(), qPrintable(words));
      }
    }
    const double ratio = bench.window.devicePixelRatioF();
    const auto* button = bench.find<QToolButton>("dismiss");
    const QPixmap drawn = button->icon().pixmap(QSize(16, 16), ratio);
    QCOMPARE(drawn.size(), QSize(16, 16) * ratio);
    QCOMPARE(bench.view(0).grabFramebuffer().size(), bench.view(0).size() * ratio);
  }

  void oneElementIsADotAndIsCountedAsOne() {
    MeshParts parts;
    parts.rest = {Point(0, 0, 0)};
    Workbench bench(build_mesh(parts));
    const QString about = bench.find<QLabel>("meshDescription")->text();
    QVERIFY2(about.contains(QStringLiteral("1 element, 0 links")), qPrintable(about));
    bench.settle();
    const QPoint at = bench.place(0, 0);
    QVERIFY(bench.view(0).rect().contains(at));
    const QColor dot = bench.view(0).grabFramebuffer().pixelColor(at), ground = colours::background;
    QVERIFY2(std::abs(dot.red() - ground.red()) + std::abs(dot.green() - ground.green()) > 80, qPrintable(dot.name()));
  }

  void oneLinkIsCountedAsOne() {
    Workbench bench(generate({MeshKind::line, {2, 1, 1}, 1, {}}));
    const QString about = bench.find<QLabel>("meshDescription")->text();
    QVERIFY2(about.contains(QStringLiteral("2 elements, 1 link")) && !about.contains(QStringLiteral("1 links")),
             qPrintable(about));
    const QPoint from = bench.place(0, 1);
    bench.stroke(0, {from, from + QPoint(100, 0)});
    bench.settleFigures();
    const QString figures = bench.window.panel(0).findChild<ViolationLine*>()->toolTip();
    QVERIFY2(figures.contains(QStringLiteral("1 link checked")), qPrintable(figures));
  }
};

CHAINMAIL_WINDOW_TEST(WindowComfort)

}  // namespace chainmail::window_comfort

#include "window_comfort.moc"
