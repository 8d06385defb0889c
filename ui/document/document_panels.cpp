// A document's panels: a solver and an algorithm each.

#include <algorithm>

#include "common/panel_names.h"
#include "common/text.h"
#include "document/document.h"
#include "document/edits.h"
#include "mesh/error.h"

namespace chainmail {

std::function<void()> Document::announcer(int panel) {
  return [this, panel] {
    if (!announced_[panel].exchange(true)) {
      QMetaObject::invokeMethod(
          this, [this, panel] { receiveFrame(panel); }, Qt::QueuedConnection);
    }
  };
}

void Document::takeOn(std::unique_ptr<SolverThread> solver) {
  log_->add(*solver);
  solver->record_passes(recordsPasses_);
  frames_[panels()] = &solver->latest_frame();
  solvers_.push_back(std::move(solver));
}

void Document::addPanel() {
  if (panels() < mostPanels) {
    const int panel = panels();
    algorithms_[panel] = unusedAlgorithm();
    log_->flush();
    takeOn(std::make_unique<SolverThread>(*solvers_.front(), algorithms_[panel], announcer(panel)));
    emit panelsChanged();
  }
}

void Document::removePanel() {
  if (panels() > fewestPanels) {
    const int panel = panels() - 1;
    emit panelLeaves(panel);
    log_->remove(*solvers_.back());
    solvers_.pop_back();
    emit panelsChanged();
  }
}

/// Exact before all others: it is what they approximate; and no two that end alike before the rest.
Algorithm Document::unusedAlgorithm() const {
  std::vector<Algorithm> all{Algorithm::exact, Algorithm::enhanced};
  for (const auto& info : algorithms()) {
    all.push_back(info.algorithm);
  }
  const auto used = std::span(algorithms_).first(std::size_t(panels()));
  const auto free = std::ranges::find_if(
      all, [&](Algorithm one) { return std::ranges::find(used, one) == used.end() && fits(one, *mesh_); });
  return free == all.end() ? Algorithm::natural_queue : *free;
}

bool Document::lacksPins(int panel) const { return pins_.empty() && info(algorithms_[panel]).needs_pins; }

void Document::setAlgorithm(int panel, Algorithm algorithm) {
  try {
    check(algorithm, *mesh_);
  } catch (const Error& error) {
    emit refused(QString::fromStdString(error.what()));
    emit algorithmChanged(panel);  // who asked shows what still runs
    return;
  }
  if (algorithms_[panel] != algorithm) {
    push(new AlgorithmEdit(*this, panel, algorithm));
  }
}

void Document::runAlgorithm(int panel, Algorithm algorithm) {
  if (panel >= panels()) {
    return;  // it was removed since
  }
  dropKeptOnTheWay();
  replayed_ = false;
  algorithms_[panel] = algorithm;
  log_->post_to(*solvers_[panel], commands::SetAlgorithm{algorithm});
}

/// What ran before a mesh on which not all of it works.
void Document::runAlgorithms(const std::vector<Algorithm>& algorithms) {
  for (int panel = 0; panel < std::min(panels(), int(algorithms.size())); ++panel) {
    if (algorithms_[panel] != algorithms[panel]) {
      runAlgorithm(panel, algorithms[panel]);
      emit algorithmChanged(panel);
    }
  }
}

/// The solvers have gone on by Natural Queue where an algorithm does not work on the new mesh: so do the figures.
void Document::followFallback() {
  QStringList where;
  QString from;
  for (int panel = 0; panel < panels(); ++panel) {
    if (!fits(algorithms_[panel], *mesh_)) {
      from = chainmail::text(info(algorithms_[panel]).label);
      algorithms_[panel] = Algorithm::natural_queue;
      where << panelName(panel);
      emit algorithmChanged(panel);
    }
  }
  if (!where.isEmpty()) {
    emit noticed(
        QStringLiteral("%1 does not work on this mesh: %2 goes on in panel %3")
            .arg(from, chainmail::text(info(Algorithm::natural_queue).label), where.join(QStringLiteral(" and "))));
  }
}

}  // namespace chainmail
