#pragma once

#include <QObject>

class QDBusVariant;

namespace chainmail {

/// The theme of the desktop, from the XDG settings portal, if there is one. Built without D-Bus, it never hears of any.
class DesktopTheme : public QObject {
  Q_OBJECT

 public:
  enum Scheme : unsigned { unknown = 0, dark = 1, light = 2 };  // the portal's numbers

  using QObject::QObject;
  /// Asks for the theme, and follows its changes.
  void ask();

 signals:
  void heard(unsigned scheme);

 private slots:
  void settingChanged(const QString& space, const QString& key, const QDBusVariant& value);
};

}  // namespace chainmail
