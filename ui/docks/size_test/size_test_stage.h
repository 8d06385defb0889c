#pragma once

#include <QWidget>
#include <set>

#include "common/jobs.h"
#include "docks/size_test/size_test_panel.h"
#include "drawing/mesh_levels.h"

namespace chainmail {

/// Runs a size test in its own panels, which replace the panels of the window while it runs.
///
/// The order of events is that of report::RampRace. All panels that attempt a size make the same drags at the same
/// time.
class SizeTestStage : public QWidget {
  Q_OBJECT

 public:
  SizeTestStage(const SizeTestOptions& options, const std::vector<SizeTestContestant>& contestants);

  void start();
  /// Ends the test at once. Emits no further signal.
  void halt();
  /// True when no solver computes. Only then does the destructor not wait.
  bool idle() const;

 signals:
  void measured(const chainmail::SizeTestRow& row);
  /// Emitted with the completed share of the sizes, from 0 to 1, and the current size.
  void progressed(double share, const QString& text);
  void ended();
  void failed(const QString& sentence);

 private:
  void build();
  void attempt();
  void receiveEnd();
  void judge();
  std::vector<SizeTestPanel*> attempting() const;
  QString sizeInWords() const;
  void showProgress();
  void stopFor(const QString& sentence);

  SizeTestOptions options_;
  report::RampRace race_;  // its contestants are the panels, in their order
  MeshPointer mesh_;
  std::shared_ptr<MeshLevels> levels_ = std::make_shared<MeshLevels>();
  std::vector<SizeTestPanel*> panels_;
  bool halted_ = false;
  Jobs jobs_;  // builds the grids
};

}  // namespace chainmail
