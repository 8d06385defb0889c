#include "window/theme_menu.h"

#include <QActionGroup>

namespace chainmail {
namespace {

QString unknownTip() { return QStringLiteral("Not available: this desktop does not report its theme"); }

}  // namespace

void ThemeMenu::fill(QMenu& menu) {
  auto* themes = menu.addMenu(QStringLiteral("&Theme"));
  themes->setToolTipsVisible(true);
  auto* group = new QActionGroup(this);
  const auto add = [&](const char* name, const QString& text, Theme theme, const QString& tip) {
    auto* action = group->addAction(text);
    action->setObjectName(QLatin1String(name));
    action->setCheckable(true);
    action->setChecked(rememberedTheme() == theme);
    action->setStatusTip(tip);
    connect(action, &QAction::triggered, this, [this, theme] { choose(theme); });
    themes->addAction(action);
    return action;
  };
  auto* dark =
      add("themeDark", QStringLiteral("&Dark"), Theme::dark, QStringLiteral("Light text on a dark background"));
  add("themeLight", QStringLiteral("&Light"), Theme::light, QStringLiteral("Dark text on a light background"));
  system_ = add("themeSystem", QStringLiteral("Follow &system"), Theme::system,
                QStringLiteral("Follows the theme of the desktop"));
  system_->setEnabled(false);  // until the desktop replies
  system_->setToolTip(unknownTip());
  if (rememberedTheme() == Theme::system && rememberedGround() == colours::Ground::dark) {
    dark->setChecked(true);
  }
  connect(&desktop_, &DesktopTheme::heard, this, &ThemeMenu::heardOfSystem);
  desktop_.ask();
}

void ThemeMenu::choose(Theme theme) {
  remember(theme);
  applyGround(rememberedGround());
}

void ThemeMenu::heardOfSystem(unsigned scheme) {
  const bool known = scheme == DesktopTheme::dark || scheme == DesktopTheme::light;
  system_->setEnabled(known);
  system_->setToolTip(known ? system_->statusTip() : unknownTip());
  if (!known) {
    return;
  }
  rememberSystem(scheme == DesktopTheme::dark ? colours::Ground::dark : colours::Ground::light);
  if (rememberedTheme() == Theme::system) {
    system_->setChecked(true);
    applyGround(rememberedGround());
  }
}

}  // namespace chainmail
