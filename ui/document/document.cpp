#include "document/document.h"

#include <algorithm>
#include <iterator>
#include <utility>

#include "common/application.h"
#include "common/text.h"
#include "files/session/session.h"

namespace chainmail {
namespace {

// An undo step may store all positions: 16 MB per panel for a million elements.
constexpr int undoSteps = 30;

}  // namespace

Document::Document(MeshPointer mesh, const QString& name)
    : selection_(contents_),
      solvers_(contents_, [this](const Command& command) { moves_.noteSent(command); }),
      executor_(*this, contents_),
      handle_(*this, executor_),
      moves_(*this, executor_) {
  contents_.softness = std::make_shared<const Softness>(standard_softness());
  contents_.relaxation.local = true;  // files that do not say so mean false
  contents_.object = std::make_shared<DocumentObject>(ObjectState{std::move(mesh)}, name);
  contents_.algorithms = {Algorithm::generalized, Algorithm::natural_queue};
  connect(&solvers_, &PanelSolvers::refused, this,
          [this](int panel, const QString& sentence) { executor_.reportRefusal(panel, sentence); });
  connect(&solvers_, &PanelSolvers::sent, &moves_, &MovePlayer::changed);
  for (int panel = 0; panel < minPanels; ++panel) {
    addSolver(algorithm(panel));
  }
  executor_.post(commands::SetSoftness{contents_.softness});
  executor_.post(contents_.relaxation);
  undoStack_.setUndoLimit(undoSteps);
  connect(&undoStack_, &QUndoStack::indexChanged, &moves_, &MovePlayer::lastDragChanged);
}

Document::~Document() {
  solvers_.abandonMoves();        // for all solvers, before the first one is destroyed and waits for its thread
  undoStack_.blockSignals(true);  // listeners may be deleted already
  undoStack_.clear();
}

// Edits: each change becomes one undo step.

Change Document::change(const QString& text, int gesture) {
  moves_.endFilm();
  Change result;
  result.text = text;
  result.after = contents_;
  result.gesture = gesture;
  return result;
}

void Document::apply(Change change) {
  handle_.end();
  executor_.forgetRefusals();
  const auto state = stateFor(change.gesture, change.text);
  auto edit = std::make_unique<Edit>(executor_, std::move(change), state);
  undoStack_.push(edit.get());  // may throw before it takes the edit over
  static_cast<void>(edit.release());
}

/// Returns the id of a new state; none if the step will be merged into the last one, which has a saved state already.
std::optional<commands::StateId> Document::stateFor(int gesture, const QString& text) {
  const QUndoCommand* last = undoStack_.command(undoStack_.index() - 1);
  const bool merges = gesture != 0 && last != nullptr && last->id() == gesture && last->text() == text &&
                      undoStack_.index() != undoStack_.cleanIndex();
  return merges ? std::nullopt : std::optional(executor_.newState());
}

bool Document::keepsWork() {
  handle_.end();
  return !isModified() || !keeper_ || keeper_();
}

void Document::undo() {
  moves_.endFilm();
  handle_.end();
  moves_.endSweeps();
  undoStack_.undo();
}

void Document::redo() {
  moves_.endFilm();
  handle_.end();
  moves_.endSweeps();
  undoStack_.redo();
}

void Document::continueRelaxation() {
  moves_.endFilm();
  commands::SetRelaxation again = relaxation();
  again.anew = true;
  executor_.post(again);
}

// Panels: each has a solver and an algorithm.

void Document::addSolver(Algorithm algorithm) {
  solvers_.add(algorithm);
  contents_.panels = panels();
}

void Document::addPanel() {
  if (panels() < maxPanels) {
    moves_.endFilm();
    const Algorithm algorithm = unusedAlgorithm();
    addSolver(algorithm);  // may find no memory or no thread, so it comes before any change
    contents_.algorithms[std::size_t(panels()) - 1] = algorithm;
    moves_.noteDeparture();  // the new panel has not replayed anything
    emit panelsChanged();
  }
}

void Document::removePanel() {
  if (panels() > minPanels) {
    moves_.endFilm();
    emit panelLeaves(panels() - 1);
    solvers_.removeLast();
    contents_.panels = panels();
    emit panelsChanged();
  }
}

/// Returns an algorithm that works on the mesh and that no panel runs yet. Exact comes first, because the others
/// approximate it, then Enhanced. Returns Natural Queue if all are in use.
Algorithm Document::unusedAlgorithm() const {
  std::vector<Algorithm> all{Algorithm::exact, Algorithm::enhanced};
  for (const auto& info : algorithms()) {
    all.push_back(info.algorithm);
  }
  const auto used = contents_.running();
  const auto free = std::ranges::find_if(
      all, [&](Algorithm one) { return std::ranges::find(used, one) == used.end() && fits(one, *mesh()); });
  return free == all.end() ? Algorithm::natural_queue : *free;
}

void DocumentFiles::setSession(const QString& file) {
  if (file != session_) {
    session_ = file;
    emit sessionChanged();
  }
}

void DocumentFiles::exchangeSession(QString& file) {
  std::swap(session_, file);
  Application::guarded([this] { emit sessionChanged(); });
}

}  // namespace chainmail
