#pragma once

#include <QAction>
#include <QMainWindow>
#include <QPointer>
#include <QStringList>
#include <vector>

namespace chainmail {

/// As long as it lives, nothing of a window acts but one dock and the actions named: what it disabled it enables again.
class WindowRest {
 public:
  WindowRest(QMainWindow& window, const QWidget& dock, const QStringList& actions);
  ~WindowRest();
  WindowRest(const WindowRest&) = delete;
  WindowRest& operator=(const WindowRest&) = delete;

 private:
  void rest(QWidget* widget);

  QMainWindow& window_;
  std::vector<QPointer<QWidget>> widgets_;
  std::vector<QPointer<QAction>> actions_;
};

}  // namespace chainmail
