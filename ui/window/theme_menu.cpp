#include "window/theme_menu.h"

#include <QActionGroup>

#include "common/theme.h"

namespace chainmail {

void addThemes(QMenu& menu) {
  auto* themes = menu.addMenu(QStringLiteral("&Theme"));
  auto* group = new QActionGroup(themes);
  const auto add = [&](const char* name, const QString& text, colours::Ground ground, const QString& tip) {
    auto* action = group->addAction(text);
    action->setObjectName(QLatin1String(name));
    action->setCheckable(true);
    action->setChecked(rememberedGround() == ground);
    action->setStatusTip(tip);
    QObject::connect(action, &QAction::triggered, action, [ground] {
      remember(ground);
      applyGround(ground);
    });
    themes->addAction(action);
  };
  add("themeDark", QStringLiteral("&Dark"), colours::Ground::dark, QStringLiteral("Light text on a dark background"));
  add("themeLight", QStringLiteral("&Light"), colours::Ground::light,
      QStringLiteral("Dark text on a light background"));
}

}  // namespace chainmail
