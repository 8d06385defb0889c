#include "document/document.h"

#include <algorithm>
#include <iterator>
#include <utility>

#include "common/application.h"
#include "common/text.h"
#include "document/element_facts.h"
#include "files/session/session.h"
#include "mesh/error.h"

namespace chainmail {
namespace {

// An undo step may store all positions: 16 MB per panel for a million elements.
constexpr int undoSteps = 30;

/// Replaces the values that differ between `from` and `to`, and the algorithms of these panels.
void replaceValues(Contents& present, const Contents& from, const Contents& to, const std::vector<int>& panels) {
  const auto replace = [&](auto value) {
    if (from.*value != to.*value) {
      present.*value = to.*value;
    }
  };
  replace(&Contents::object);
  replace(&Contents::lesson);
  replace(&Contents::softness);
  replace(&Contents::relaxation);
  replace(&Contents::elastic);
  for (const int panel : panels) {
    present.algorithms[std::size_t(panel)] = to.algorithms[std::size_t(panel)];
  }
}

/// Emits the signals of the values that differ, and algorithmChanged for these panels. A listener that fails must not
/// leave the change half done.
void emitSignals(Document& document, const Contents& from, const Contents& to, const std::vector<int>& panels) {
  if (from.object != to.object) {
    Application::guarded([&] { emit document.meshChanged(); });
  }
  if (from.lesson != to.lesson) {
    Application::guarded([&] { emit document.lessonChanged(); });
  }
  if (from.softness != to.softness) {
    Application::guarded([&] { emit document.softnessChanged(); });
  }
  if (from.relaxation != to.relaxation) {
    Application::guarded([&] { emit document.relaxationChanged(); });
  }
  if (from.elastic != to.elastic) {
    Application::guarded([&] { emit document.elasticChanged(); });
  }
  for (const int panel : panels) {
    Application::guarded([&] { emit document.algorithmChanged(panel); });
  }
}

template <class T>
std::vector<T> minus(const std::vector<T>& all, const std::vector<T>& some) {
  std::vector<T> left;
  std::ranges::set_difference(all, some, std::back_inserter(left));
  return left;
}

/// True for a change of the object. A handle must be released before it, or the change may be refused.
bool changesObject(const Command& command) {
  using namespace commands;
  return is_one_of<Cut, Uncut, Pin, Unpin, commands::Split, Reset, SetSoftness>(command);
}

}  // namespace

Document::Document(MeshPointer mesh, const QString& name)
    : selection_(contents_), solvers_(contents_), handle_(*this), moves_(*this) {
  contents_.softness = std::make_shared<const Softness>(standard_softness());
  contents_.object = std::make_shared<DocumentObject>(ObjectState{std::move(mesh)}, name);
  contents_.algorithms = {Algorithm::generalized, Algorithm::natural_queue};
  connect(&solvers_, &PanelSolvers::refused, this, &Document::reportRefusal);
  connect(&solvers_, &PanelSolvers::sent, &moves_, &MovePlayer::changed);
  for (int panel = 0; panel < minPanels; ++panel) {
    addSolver(algorithm(panel));
  }
  post(commands::SetSoftness{contents_.softness});
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
  forgetRefusals();
  const auto state = stateFor(change.gesture, change.text);
  auto edit = std::make_unique<Edit>(*this, std::move(change), state);
  undoStack_.push(edit.get());  // may throw before it takes the edit over
  static_cast<void>(edit.release());
}

/// Adds a drag, which the solvers have carried out, as one undo step. They have saved the state `before`.
void Document::addDone(Change change, commands::StateId before) {
  undoStack_.push(new Edit(*this, std::move(change), before, true));
}

/// Returns the id of a new state; none if the step will be merged into the last one, which has a saved state already.
std::optional<commands::StateId> Document::stateFor(int gesture, const QString& text) {
  const QUndoCommand* last = undoStack_.command(undoStack_.index() - 1);
  const bool merges = gesture != 0 && last != nullptr && last->id() == gesture && last->text() == text &&
                      undoStack_.index() != undoStack_.cleanIndex();
  return merges ? std::nullopt : std::optional(newState());
}

/// Posts the commands of a change when it is done for the first time. Later, undo and redo restore saved states.
void Document::carryOut(const Change& change, const Contents& before) {
  const Contents& after = change.after;
  const bool follows = change.split || change.followsMoves;  // the solvers get the object from these commands
  const bool isOther = after.object != before.object && !follows;
  if (change.split) {
    post(commands::Split{change.split});
  }
  if (isOther) {
    post(commands::ReplaceMesh{after.object->mesh});  // keeps only the global softness
  }
  const bool softnessIsThere =
      isOther ? *after.softness == kept_for(*after.object->mesh, *before.softness) : after.softness == before.softness;
  if (!softnessIsThere && !follows) {
    post(commands::SetSoftness{after.softness});
  }
  const auto links = isOther ? after.object->cuts.links() : change.cut;
  const auto& pinned = isOther ? after.object->pins : change.pin;
  if (!links.empty()) {
    post(commands::Cut{links});
  }
  if (!pinned.empty()) {
    post(commands::Pin{pinned});
  }
  if (!change.unpin.empty()) {
    post(commands::Unpin{change.unpin});
  }
  postSettings(before, after, SolversHave::thisObject);
  if (change.resets) {
    post(commands::Reset{});
  }
  if (change.carryOut) {
    change.carryOut();
  }
}

/// Posts the settings that a saved state does not contain. While the solvers have another object, Natural Queue runs
/// instead of an algorithm that may not work on it. Exact is not replaced: it works on any mesh and stores positions in
/// its own way.
void Document::postSettings(const Contents& from, const Contents& to, SolversHave have) {
  if (to.relaxation != from.relaxation) {
    post(to.relaxation);
  }
  if (to.elastic != from.elastic) {
    post(commands::SetElastic{to.elastic});
  }
  for (const int panel : panelsToSwitch(from, to)) {
    const Algorithm target = to.algorithms[std::size_t(panel)];
    if (target != from.algorithms[std::size_t(panel)]) {
      postAlgorithm(
          panel, have == SolversHave::anotherObject && target != Algorithm::exact ? Algorithm::natural_queue : target);
    }
  }
}

/// Returns the panels that still exist and need another algorithm. If the object changes, it checks all panels, because
/// some algorithms do not work on every mesh.
std::vector<int> Document::panelsToSwitch(const Contents& from, const Contents& to) const {
  std::vector<int> result;
  for (int panel = 0; panel < std::min({from.panels, to.panels, panels()}); ++panel) {
    const Algorithm before = from.algorithms[std::size_t(panel)], after = to.algorithms[std::size_t(panel)];
    if ((from.object != to.object || before != after) && algorithm(panel) != after) {
      result.push_back(panel);
    }
  }
  return result;
}

/// Sets the contents to the values of a step that was done or undone, and emits the signals of values that differ.
void Document::show(Change& change, const Contents& from, const Contents& to, bool done) {
  const std::vector<int> panels = panelsToSwitch(from, to);
  const bool isOther = from.object != to.object;
  if (isOther) {  // first, because listeners still read elements of the old mesh
    highlight_.set({});
    selection_.set({});
  }
  replaceValues(contents_, from, to, panels);
  for (const int panel : isOther ? panels : std::vector<int>()) {
    postAlgorithm(panel, algorithm(panel));
  }
  if (change.sessionFile) {
    files_.exchangeSession(*change.sessionFile);
  }
  emitSignals(*this, from, to, panels);
  showParts(change, done);
  if (isOther && done) {
    replaceUnfitAlgorithms();
  }
}

/// Applies cuts and pins of a change to the contents, or reverts them if `done` is false.
void Document::showParts(const Change& change, bool done) {
  if (!change.cut.empty()) {
    showCuts(change.cut, done);
  }
  if (!change.pin.empty()) {
    showPins(change.pin, done);
  }
  if (!change.unpin.empty()) {
    showPins(change.unpin, !done);
  }
  if (change.followsMoves) {
    highlight_.set({});
    showMoves();
  }
}

void Document::showCuts(const std::vector<LinkId>& links, bool cut) {
  DocumentObject& object = *contents_.object;
  cut ? object.parts.cut(object.cuts, links) : object.parts.uncut(object.cuts, links);
  Application::guarded([&] { emit cutsChanged(links, cut); });
  selection_.followCuts();
}

void Document::showPins(const std::vector<ElementId>& elements, bool pinned) {
  auto& pins = contents_.object->pins;
  pins = combined(pins, elements, pinned ? SelectionMode::add : SelectionMode::remove);
  Application::guarded([this] { emit pinsChanged(); });
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

// Commands to the solvers, and their refusals.

void Document::continueRelaxation() {
  moves_.endFilm();
  commands::SetRelaxation again = relaxation();
  again.anew = true;
  post(again);
}

void Document::post(const Command& command) {
  CommandLog& log = solvers_.log();
  // The recorded commands may end within a drag, as in a session that was saved while dragging.
  if (!handle_.isActive() && changesObject(command) && log.history().holds()) {
    log.post(commands::Release{});
  }
  log.post(command);
  if (log.waits()) {
    log.sample();
  }
  moves_.noteSent(command);
}

/// Emits each refusal only once, because every move of a drag is refused for the same reason.
void Document::reportRefusal(int panel, const QString& sentence) {
  if (std::exchange(lastRefusal_[std::size_t(panel)], sentence) == sentence) {
    return;
  }
  if (lacksPins(*this, panel)) {
    emit unpinned(panel);
  } else {
    emit refused(sentence);
  }
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
  const auto used = std::span(contents_.algorithms).first(std::size_t(panels()));
  const auto free = std::ranges::find_if(
      all, [&](Algorithm one) { return std::ranges::find(used, one) == used.end() && fits(one, *mesh()); });
  return free == all.end() ? Algorithm::natural_queue : *free;
}

void Document::postAlgorithm(int panel, Algorithm algorithm) {
  moves_.noteDeparture();
  solvers_.post(panel, commands::SetAlgorithm{algorithm});
}

/// Sets Natural Queue for panels whose algorithm does not work on the new mesh. Their solvers have already switched.
void Document::replaceUnfitAlgorithms() {
  QStringList where;
  QString from;
  for (int panel = 0; panel < panels(); ++panel) {
    if (!fits(algorithm(panel), *mesh())) {
      from = chainmail::text(info(algorithm(panel)).label);
      contents_.algorithms[std::size_t(panel)] = Algorithm::natural_queue;
      where << panelName(panel);
      Application::guarded([&] { emit algorithmChanged(panel); });
    }
  }
  if (!where.isEmpty()) {
    emit noticed(
        QStringLiteral("%1 does not work on this mesh: panel %2 now runs %3")
            .arg(from, where.join(QStringLiteral(" and ")), chainmail::text(info(Algorithm::natural_queue).label)));
  }
}

/// Sets cuts, pins and softness to their state at the current position in the recorded commands.
void Document::showMoves() {
  const ObjectState object = moves_.history().object();
  const std::vector<LinkId> cut = cuts().links();
  if (cut != object.cuts) {
    showCuts(minus(cut, object.cuts), false);
    showCuts(minus(object.cuts, cut), true);
  }
  if (pins() != object.pins) {
    contents_.object->pins = object.pins;
    emit pinsChanged();
  }
  if (*wholeSoftness() != *object.softness) {
    contents_.softness = object.softness;
    emit softnessChanged();
  }
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
