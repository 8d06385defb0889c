#include "window/desktop_theme.h"

#ifdef CHAINMAIL_HAS_DBUS

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

}  // namespace

void DesktopTheme::ask() {
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
      emit heard((wrapped ? outer.value<QDBusVariant>().variant() : outer).toUInt());
    }
  });
}

void DesktopTheme::settingChanged(const QString& changedSpace, const QString& changedKey, const QDBusVariant& value) {
  if (changedSpace == space && changedKey == key) {
    emit heard(value.variant().toUInt());
  }
}

}  // namespace chainmail

#else

namespace chainmail {

void DesktopTheme::ask() {}

void DesktopTheme::settingChanged(const QString& /*space*/, const QString& /*key*/, const QDBusVariant& /*value*/) {}

}  // namespace chainmail

#endif
