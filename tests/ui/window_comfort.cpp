// What makes the window pleasant to be in: themes.

#include <QTest>
#include <cmath>

#include "colour_map.h"
#include "report_looks.h"
#include "theme.h"
#include "window.h"

using namespace chainmail;
using colours::Ground;

namespace {

/// Relative luminance (WCAG 2.1).
double luminance(const QColor& colour) {
  const auto linear = [](double share) {
    return share <= 0.04045 ? share / 12.92 : std::pow((share + 0.055) / 1.055, 2.4);
  };
  return 0.2126 * linear(colour.redF()) + 0.7152 * linear(colour.greenF()) + 0.0722 * linear(colour.blueF());
}

double contrast(const QColor& one, const QColor& other) {
  const auto [low, high] = std::minmax({luminance(one), luminance(other)});
  return (high + 0.05) / (low + 0.05);
}

constexpr double ofText = 4.5, ofMarks = 3;  // what WCAG 2.1 asks for at level AA (1.4.3, 1.4.11)

}  // namespace

class WindowComfort : public QObject {
  Q_OBJECT

 private slots:
  void init() { failOnWarnings(); }
  void cleanup() {
    remember(Theme::dark);
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
        QVERIFY2(contrast(palette.color(text), palette.color(behind)) >= ofText,
                 qPrintable(QStringLiteral("%1 on %2").arg(palette.color(text).name(), palette.color(behind).name())));
      }
      // Panels' figures are written in their colours.
      for (const QColor colour :
           {QColor(colours::left), QColor(colours::right), QColor(colours::third), QColor(colours::fourth)}) {
        QVERIFY(contrast(colour, palette.color(QPalette::Window)) >= ofText);
      }
      for (const QColor mark :
           {QColor(colours::left), QColor(colours::right), QColor(colours::third), QColor(colours::fourth),
            QColor(colours::marked), QColor(colours::pinned), QColor(colours::selected), QColor(colours::lit),
            QColor(colours::inside), QColor(colours::outside), colour_map::at(0), colour_map::at(1)}) {
        QVERIFY2(contrast(mark, colours::background) >= ofMarks, qPrintable(mark.name()));
      }
      for (const auto& one : algorithms()) {
        QVERIFY(contrast(reportColour(one.algorithm), palette.color(QPalette::Window)) >= ofMarks);
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
    QVERIFY(bench.find<QLabel>("rateName0")->text().contains(colours::left.on(Ground::light).name()));
    QCOMPARE(rememberedTheme(), Theme::light);
    QCOMPARE(rememberedGround(), Ground::light);
    bench.trigger("themeDark");
    bench.settle();
    QCOMPARE(seen(0), colours::background.on(Ground::dark));
    QCOMPARE(rememberedTheme(), Theme::dark);
  }

  void systemsLookIsFollowedWhereItIsKnown() {
    remember(Theme::system);
    QCOMPARE(rememberedGround(), Ground::dark);  // unknown
    rememberSystem(Ground::light);
    QCOMPARE(rememberedGround(), Ground::light);
    remember(Theme::dark);
    QCOMPARE(rememberedGround(), Ground::dark);
    rememberSystem(Ground::dark);
  }
};

int main(int argc, char** argv) { return runWindowTest<WindowComfort>(argc, argv); }
#include "window_comfort.moc"
