#include "window/theme_menu.h"

#include <QActionGroup>
#include <QDBusConnection>
#include <QDBusMessage>
#include <QDBusPendingCallWatcher>
#include <QDBusPendingReply>
#include <QDBusVariant>

namespace chainmail {
namespace {

// The XDG desktop portal, which gives access to the settings of the desktop.
constexpr QLatin1String service("org.freedesktop.portal.Desktop");
constexpr QLatin1String path("/org/freedesktop/portal/desktop");
constexpr QLatin1String interface("org.freedesktop.portal.Settings");
constexpr QLatin1String space("org.freedesktop.appearance");
constexpr QLatin1String key("color-scheme");
constexpr unsigned schemeDark = 1, schemeLight = 2;  // 0: no preference

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
  askSystem();
}

void ThemeMenu::choose(Theme theme) {
  remember(theme);
  applyGround(rememberedGround());
}

void ThemeMenu::askSystem() {
  if (qEnvironmentVariableIsEmpty("DBUS_SESSION_BUS_ADDRESS")) {
    return;  // a request would start a D-Bus daemon
  }
  auto bus = QDBusConnection::sessionBus();
  bus.connect(service, path, interface, QStringLiteral("SettingChanged"), this,
              SLOT(settingChanged(QString, QString, QDBusVariant)));
  auto question = QDBusMessage::createMethodCall(service, path, interface, QStringLiteral("Read"));
  question << QString(space) << QString(key);
  auto* answer = new QDBusPendingCallWatcher(bus.asyncCall(question), this);
  connect(answer, &QDBusPendingCallWatcher::finished, this, [this, answer] {
    const QDBusPendingReply<QDBusVariant> reply = *answer;
    answer->deleteLater();
    if (!reply.isError()) {
      // 'Read' wraps its reply in two variants.
      const QVariant outer = reply.value().variant();
      const bool wrapped = outer.canConvert<QDBusVariant>();
      heardOfSystem((wrapped ? outer.value<QDBusVariant>().variant() : outer).toUInt());
    }
  });
}

void ThemeMenu::settingChanged(const QString& changedSpace, const QString& changedKey, const QDBusVariant& value) {
  if (changedSpace == space && changedKey == key) {
    heardOfSystem(value.variant().toUInt());
  }
}

void ThemeMenu::heardOfSystem(unsigned scheme) {
  const bool known = scheme == schemeDark || scheme == schemeLight;
  system_->setEnabled(known);
  system_->setToolTip(known ? system_->statusTip() : unknownTip());
  if (!known) {
    return;
  }
  rememberSystem(scheme == schemeDark ? colours::Ground::dark : colours::Ground::light);
  if (rememberedTheme() == Theme::system) {
    system_->setChecked(true);
    applyGround(rememberedGround());
  }
}

}  // namespace chainmail
