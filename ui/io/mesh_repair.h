#pragma once

#include <QMenu>
#include <QObject>
#include <functional>
#include <memory>
#include <vector>

#include "common/jobs.h"
#include "document/document.h"
#include "files/repair/repair.h"

namespace chainmail {

class RepairBar;

/// Offers to repair the object, and repairs it in the background. Each repair is one undo step.
class MeshRepair : public QObject {
  Q_OBJECT

 public:
  MeshRepair(Document& document, Jobs& jobs, QObject* parent);

  /// Returns the bar, which is visible while the object has known defects.
  RepairBar& bar() { return *bar_; }
  void fill(QMenu& menu);
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
