#pragma once

#include <QFrame>
#include <QLabel>
#include <QObject>
#include <functional>
#include <memory>
#include <vector>

#include "common/jobs.h"
#include "document/document.h"
#include "files/repair/repair.h"

class QHBoxLayout;
class QLineEdit;
class QPushButton;

namespace chainmail {

class Actions;
struct Defects;

/// A bar above the panels that names the defects of the object, with a button for each repair that applies.
class RepairBar : public QFrame {
  Q_OBJECT

 public:
  RepairBar();

  /// Shows the bar with these defects; `ifNone` is its text where there is none.
  void offer(const Defects& defects, const QString& ifNone = {});
  /// Elements as close as this are welded (mesh units).
  double weldDistance() const;
  /// Adds what Show has selected to the text.
  void showShown(const QString& what);

 signals:
  void showRequested();
  void weldRequested();
  void removeLooseRequested();
  void closeHolesRequested();
  void turnCellsRequested();
  void dismissed();

 private:
  QPushButton* addButton(const QString& text, const char* name, const QString& help, void (RepairBar::*request)());
  void addWeldDistance();
  void addClose();

  QHBoxLayout* row_;
  QLabel* text_;
  QLabel* shown_;
  QPushButton *show_, *weld_, *loose_, *holes_, *cells_;
  QLineEdit* distance_;
};

/// Offers to repair the object, and repairs it in the background. Each repair is one undo step.
class MeshRepair : public QObject {
  Q_OBJECT

 public:
  MeshRepair(Document& document, Jobs& jobs, QObject* parent);

  /// Returns the bar, which is visible while the object has known defects.
  RepairBar& bar() { return *bar_; }
  void fill(Actions& actions);
  /// Remembers the defects of a mesh that becomes the object next.
  void remember(const MeshPointer& mesh, Defects defects);

 private:
  using Repair = std::function<Repaired(const Mesh&, const Progress&)>;
  /// Returns the name of the undo step.
  using Named = std::function<QString(const Repaired&)>;

  /// A mesh that was checked. The undo stack may bring it back.
  struct Checked {
    std::weak_ptr<const Mesh> mesh;
    std::shared_ptr<const Defects> defects;
    bool dismissed = false;
  };

  Checked* ofTheObject();
  void follow();
  void check();
  void dismiss();
  void showNext();
  void start(const QString& doing, const Named& step, const Repair& repair);
  void weld();
  void removeLoose();
  void closeHoles();
  void turnCells();

  Document& document_;
  Jobs& jobs_;
  RepairBar* bar_;
  std::vector<Checked> checked_;
  std::size_t next_ = 0;  // index of the defect that Show selects next
};

}  // namespace chainmail
