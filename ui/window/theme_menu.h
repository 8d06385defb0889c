#pragma once

#include <QMenu>
#include <QObject>

#include "common/theme.h"

class QDBusPendingCallWatcher;
class QDBusVariant;

namespace chainmail {

/// The View menu's choice of theme. It also hears from the desktop (its settings portal, where there is one) what
/// the system looks like, and follows it where that was chosen.
class ThemeMenu : public QObject {
  Q_OBJECT

 public:
  explicit ThemeMenu(QObject* parent) : QObject(parent) {}
  void fill(QMenu& menu);

 private slots:
  void settingChanged(const QString& space, const QString& key, const QDBusVariant& value);

 private:
  void choose(Theme theme);
  void askSystem();
  void heardOfSystem(unsigned scheme);

  QAction* system_ = nullptr;
};

}  // namespace chainmail
