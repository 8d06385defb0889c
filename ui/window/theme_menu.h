#pragma once

#include <QMenu>
#include <QObject>

#include "common/theme.h"

class QDBusPendingCallWatcher;
class QDBusVariant;

namespace chainmail {

/// The View menu's choice of theme: dark, light, or the desktop's. Reads the desktop's theme from the XDG settings
/// portal, if there is one, and follows its changes.
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
