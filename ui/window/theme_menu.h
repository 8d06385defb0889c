#pragma once

#include <QMenu>
#include <QObject>

#include "common/theme.h"
#include "window/desktop_theme.h"

namespace chainmail {

/// The View menu's choice of theme: dark, light, or the desktop's. The desktop's is offered when the desktop
/// reports it.
class ThemeMenu : public QObject {
  Q_OBJECT

 public:
  explicit ThemeMenu(QObject* parent) : QObject(parent) {}
  void fill(QMenu& menu);

 private:
  void choose(Theme theme);
  void heardOfSystem(unsigned scheme);

  DesktopTheme desktop_;
  QAction* system_ = nullptr;
};

}  // namespace chainmail
