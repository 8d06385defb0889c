#include "common/theme.h"

#include <QApplication>
#include <QPalette>
#include <QSettings>

namespace chainmail {
namespace {

using colours::Colour;
using colours::Ground;

QString themeKey() { return QStringLiteral("theme"); }
QString lightName() { return QStringLiteral("light"); }

struct Role {
  QPalette::ColorRole role;
  Colour colour;
};

constexpr Colour boxGround(0xff6e7783, 0xffffffff), boxEdge(0xff6e7783, 0xff9aa1ab),
    listBoxEdge(0xffb4bcc8, 0xff9aa1ab);
constexpr Colour faintText(0xff98a0ab, 0xff59616c);

constexpr std::array roles{Role{QPalette::Window, {0xff242930, 0xffeceef1}},
                           Role{QPalette::WindowText, {0xffe4e7eb, 0xff1a1e24}},
                           Role{QPalette::Base, {0xff1b1f25, 0xffffffff}},
                           Role{QPalette::AlternateBase, {0xff242930, 0xfff3f5f7}},
                           Role{QPalette::ToolTipBase, {0xff1b1f25, 0xffffffff}},
                           Role{QPalette::ToolTipText, {0xffe4e7eb, 0xff1a1e24}},
                           Role{QPalette::PlaceholderText, faintText},
                           Role{QPalette::Text, {0xffe4e7eb, 0xff1a1e24}},
                           Role{QPalette::Button, {0xff30363f, 0xffe2e5e9}},
                           Role{QPalette::ButtonText, {0xffe4e7eb, 0xff1a1e24}},
                           Role{QPalette::BrightText, {0xffffffff, 0xffffffff}},
                           Role{QPalette::Light, {0xff464e59, 0xffffffff}},
                           Role{QPalette::Midlight, {0xff3a414b, 0xffd4d8de}},
                           Role{QPalette::Mid, {0xff3a414b, 0xffc2c7ce}},
                           Role{QPalette::Dark, {0xff14171c, 0xff9aa1ab}},
                           Role{QPalette::Shadow, {0xff0c0e11, 0xff6b727c}},
                           Role{QPalette::Highlight, {0xff2a78ad, 0xffa9d2ee}},
                           Role{QPalette::HighlightedText, {0xffffffff, 0xff1a1e24}},
                           Role{QPalette::Link, {0xff56b4e9, 0xff0068a8}},
                           Role{QPalette::LinkVisited, {0xffc9a0e8, 0xff6b3fa0}}};

}  // namespace

QPalette paletteOn(Ground ground) {
  QPalette palette;
  for (const Role& one : roles) {
    palette.setColor(one.role, one.colour.on(ground));
  }
  for (const auto role : {QPalette::WindowText, QPalette::Text, QPalette::ButtonText}) {
    palette.setColor(QPalette::Disabled, role, faintText.on(ground));
  }
  return palette;
}

Ground rememberedGround() {
  return QSettings().value(themeKey()).toString() == lightName() ? Ground::light : Ground::dark;
}

void remember(Ground ground) {
  QSettings().setValue(themeKey(), ground == Ground::dark ? QStringLiteral("dark") : lightName());
}

void applyGround(Ground ground) {
  QApplication::setPalette(paletteOn(ground));
  // Fusion draws an empty check box with the edge of all frames, which is too faint.
  QPalette boxes = paletteOn(ground);
  boxes.setColor(QPalette::Base, boxGround.on(ground));
  boxes.setColor(QPalette::Window, boxEdge.on(ground));
  QApplication::setPalette(boxes, "QCheckBox");
  // In lists, the edge of check boxes has the Window colour; their background is that of the text.
  QPalette lists = paletteOn(ground);
  lists.setColor(QPalette::Window, listBoxEdge.on(ground));
  QApplication::setPalette(lists, "QListWidget");
  // In menus, a checked item with an icon is drawn as a pressed button.
  QPalette menus = lists;
  menus.setColor(QPalette::Button, colours::checked.on(ground));
  QApplication::setPalette(menus, "QMenu");
}

}  // namespace chainmail
