#pragma once

#include <QDockWidget>
#include <QMainWindow>
#include <map>
#include <vector>

namespace chainmail {

/// The sizes of docks that the user shows and hides. A column at the side returns to its former width when a wide dock
/// leaves it. Docks at the bottom are as tall as the size hint of the tallest of them.
class DockSizes : public QObject {
  Q_OBJECT

 public:
  explicit DockSizes(QMainWindow& window) : window_(window) {}
  void follow(QDockWidget& dock);

 protected:
  bool eventFilter(QObject* watched, QEvent* event) override;

 private:
  void noteWidth(QDockWidget& dock);
  void adapt(QDockWidget& dock, bool shown);
  void restoreWidth(Qt::DockWidgetArea area, int width);
  void fitBottom();
  QList<QDockWidget*> visibleIn(Qt::DockWidgetArea area) const;

  QMainWindow& window_;
  std::vector<QDockWidget*> docks_;
  std::map<const QDockWidget*, int> widthWithout_;  // of the column of a hidden dock (pixels)
};

}  // namespace chainmail
