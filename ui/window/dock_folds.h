#pragma once

#include <QDockWidget>
#include <QTimer>
#include <map>

class QMainWindow;
class QToolButton;

namespace chainmail {

/// Folds docks whose content is a DockScroll to their titles, by an arrow at the left of each title. The choice is
/// remembered. Docks that share a height cannot fold: those at the top and at the bottom, and those behind each other's
/// tabs.
class DockFolds : public QObject {
  Q_OBJECT

 public:
  explicit DockFolds(QMainWindow& window);

  void follow(QDockWidget& dock);
  void unfoldAll();

 protected:
  bool eventFilter(QObject* watched, QEvent* event) override;

 private:
  struct Fold {
    QToolButton* arrow;  // checked if the user wants only the title
    int height = 0;      // before it was folded (pixels)
  };

  bool canFold(const QDockWidget& dock) const;
  void adapt(QDockWidget& dock, Fold& fold);

  QMainWindow& window_;
  QTimer later_;  // adapts all docks once after several changes
  std::map<QDockWidget*, Fold> folds_;
};

/// Shows a dock, unfolded and in front of its tabs.
void bringUp(QDockWidget& dock);

}  // namespace chainmail
