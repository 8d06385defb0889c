#pragma once

#include <QDockWidget>
#include <map>

class QMainWindow;
class QToolButton;

namespace chainmail {

/// Folds docks to their titles, by an arrow at the left of each title. The choice is remembered. Only docks in the
/// columns at the left and at the right fold, one that shares its place as a tab not: docks beside each other have one
/// height.
class DockFolds : public QObject {
  Q_OBJECT

 public:
  explicit DockFolds(QMainWindow& window) : window_(window) {}

  void follow(QDockWidget& dock);
  void unfoldAll();

 protected:
  bool eventFilter(QObject* watched, QEvent* event) override;

 private:
  struct Fold {
    QToolButton* arrow;
    bool wanted = false;  // by the user
    bool folded = false;
    int height = 0;  // before it was folded (pixels); 0: it was not seen since
  };

  bool canFold(const QDockWidget& dock) const;
  void choose(QDockWidget& dock, bool folded);
  void adapt();
  void adapt(QDockWidget& dock, Fold& fold);

  QMainWindow& window_;
  std::map<QDockWidget*, Fold> folds_;
};

/// Shows a dock, unfolded and in front of its tabs.
void bringUp(QDockWidget& dock);

}  // namespace chainmail
