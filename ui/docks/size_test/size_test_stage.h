#pragma once

#include <QWidget>
#include <set>

#include "common/jobs.h"
#include "docks/size_test/size_test_panel.h"
#include "drawing/mesh_levels.h"

namespace chainmail {

/// Carries a size test out in panels of its own, which take the place of the window's while it runs.
///
/// At each size all that are in the race make the same drags. One is out when the slowest hundredth of its passes
/// exceeds the budget, and does so again with fresh drags: it stops there, and the others go on.
class SizeTestStage : public QWidget {
  Q_OBJECT

 public:
  SizeTestStage(const SizeTestOptions& options, const std::vector<SizeTestContestant>& contestants);

  void start();
  /// Ends the test at once; nothing is told from here on.
  void halt();
  /// Whether no solver is at work: only then the end of this object waits for nothing.
  bool idle() const;

 signals:
  void measured(const chainmail::SizeTestRow& row);
  /// How much of the sizes is done, from 0 to 1, and what is going on.
  void progressed(double share, const QString& text);
  void ended();
  void failed(const QString& sentence);

 private:
  void build();
  void attempt(int number, const std::vector<SizeTestPanel*>& panels);
  void receiveEnd();
  void judge();
  void goOn();
  void showProgress();
  void stopFor(const QString& sentence);

  SizeTestOptions options_;
  std::vector<std::uint32_t> widths_;
  std::size_t size_ = 0;  // which of them
  MeshPointer mesh_;
  std::shared_ptr<MeshLevels> levels_ = std::make_shared<MeshLevels>();
  std::vector<SizeTestPanel*> panels_;  // all
  std::vector<SizeTestPanel*> racing_;
  std::vector<SizeTestPanel*> running_;  // of this attempt
  std::vector<SizeTestRow> rows_;        // of this size
  int attempt_ = 0;
  bool halted_ = false;
  Jobs jobs_;  // builds the grids
};

}  // namespace chainmail
