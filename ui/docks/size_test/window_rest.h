#pragma once

#include <QAction>
#include <QMainWindow>
#include <QPointer>
#include <QStringList>
#include <vector>

namespace chainmail {

/// Disables a window, except one dock and some actions. The destructor enables it again.
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
