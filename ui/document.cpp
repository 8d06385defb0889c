#include "document.h"

#include <algorithm>

#include "edits.h"
#include "mesh/error.h"
#include "panel_names.h"
#include "text.h"

namespace chainmail {
namespace {

constexpr int samplingMilliseconds = 16;
// Some steps keep all positions, 16 MB a panel at a million elements.
constexpr int undoSteps = 30;

}  // namespace

Document::Document(MeshPointer mesh, const QString& name) : mesh_(std::move(mesh)), name_(name), cuts_(mesh_) {
  log_ = std::make_unique<CommandLog>(std::vector<SolverThread*>());
  for (int panel = 0; panel < fewestPanels; ++panel) {
    takeOn(std::make_unique<SolverThread>(mesh_, algorithms_[panel], announcer(panel)));
  }
  undoStack_.setUndoLimit(undoSteps);
  sampler_.setTimerType(Qt::PreciseTimer);
  sampler_.setInterval(samplingMilliseconds);
  connect(&sampler_, &QTimer::timeout, this, [this] {
    if (!log_->waits()) {
      sampler_.stop();
    }
    log_->sample();
    emit tapeChanged();
  });
  // Elements of another mesh are other elements.
  connect(this, &Document::meshChanged, this, &Document::forgetDrags);
}

Document::~Document() {
  undoStack_.blockSignals(true);  // who listened is half gone
  undoStack_.clear();
}

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

bool Document::idle() const {
  return !log_->waits() && std::all_of(solvers_.begin(), solvers_.end(), [](auto& one) { return one->idle(); });
}

bool Document::settled() const {
  return !log_->waits() && std::all_of(solvers_.begin(), solvers_.end(), [](auto& one) { return one->settled(); }) &&
         std::none_of(announced_.begin(), announced_.end(), [](auto& one) { return one.load(); });
}

void Document::receiveFrame(int panel) {
  announced_[panel] = false;
  if (panel >= panels()) {
    return;  // it is gone since
  }
  frames_[panel] = &solvers_[panel]->latest_frame();
  if (const std::string error = solvers_[panel]->take_error(); !error.empty()) {
    emit refused(QString::fromStdString(error));
  }
  emit frameReady(panel);
}

void Document::grab(ElementId element) {
  endDrag();
  if (isPinned(element)) {
    log_->replay(commands::Grab{element});  // refused, and no move
    return;
  }
  noteRelaxation();
  recorder_.grab(element);
  beforeDrag_ = newState();
  dragged_ = element;
  post(commands::KeepState{*beforeDrag_});
  post(commands::Grab{element});
}

void Document::drag(const Point& target) {
  recorder_.drag(target);
  post(commands::Drag{target});
}

void Document::post(const Command& command) {
  log_->post(command);
  replayed_ = replayed_ && (std::holds_alternative<commands::KeepState>(command) ||
                            std::holds_alternative<commands::DropState>(command));
  emit tapeChanged();
  // The first sampled command of a while goes at once, later ones 60 times a second.
  if (log_->waits() && !sampler_.isActive()) {
    log_->sample();
    sampler_.start();
  }
}

void Document::forgetDrags() {
  recorder_.forget();
  emit lastDragChanged();
}

void Document::release() {
  post(commands::Release{});
  endDrag();
}

/// What the hand did so far becomes a step of undo; a press without a move is none.
void Document::endDrag() {
  const bool moved = recorder_.release();
  if (const auto state = std::exchange(beforeDrag_, {})) {
    if (moved) {
      undoStack_.push(new DragEdit(*this, dragged_, *state));
    } else {
      post(commands::DropState{*state});
    }
  }
  if (moved) {
    emit lastDragChanged();
  }
}

void Document::push(QUndoCommand* edit) {
  endDrag();
  undoStack_.push(edit);
}

void Document::undo() {
  endDrag();
  undoStack_.undo();
}

void Document::redo() {
  endDrag();
  undoStack_.redo();
}

/// None where the step of this gesture will be merged into the last one, which has kept the state before.
std::optional<commands::StateId> Document::stateFor(int gesture, const QString& text) {
  const QUndoCommand* last = undoStack_.command(undoStack_.index() - 1);
  const bool goesOn = gesture != 0 && last != nullptr && last->id() == gesture && last->text() == text &&
                      undoStack_.index() != undoStack_.cleanIndex();
  return goesOn ? std::nullopt : std::optional(newState());
}

void Document::setSoftness(const LinkSoftness& global, const QString& text, int gesture) {
  if (global != softness_->global) {
    pushSoftness({global, softness_->links}, text, gesture);
  }
}

void Document::setSoftnessOf(const std::vector<LinkId>& links, const std::optional<LinkSoftness>& own) {
  Softness softness = *softness_;
  for (const LinkId link : links) {
    if (own) {
      softness.links.insert_or_assign(link, *own);
    } else {
      softness.links.erase(link);
    }
  }
  if (softness.links != softness_->links) {
    pushSoftness(std::move(softness), counted(QStringLiteral("stiffness of"), links.size(), QStringLiteral("link")), 0);
  }
}

void Document::resetSoftness() {
  if (*softness_ != Softness()) {
    pushSoftness({}, QStringLiteral("reset stiffness"), 0);
  }
}

void Document::pushSoftness(Softness softness, const QString& text, int gesture) {
  push(new SoftnessEdit(*this, std::make_shared<const Softness>(std::move(softness)), text, gesture));
}

bool Document::isPinned(ElementId element) const { return std::binary_search(pins_.begin(), pins_.end(), element); }

void Document::setPinned(const std::vector<ElementId>& elements, bool pinned) {
  if (!elements.empty()) {
    push(new PinEdit(*this, elements, pinned));
  }
}

void Document::cut(const std::vector<LinkId>& links) {
  if (!links.empty()) {
    push(new CutEdit(*this, links));
  }
}

void Document::resetObject() { push(new ResetEdit(*this)); }

void Document::replaceMesh(const MeshPointer& mesh, const QString& name, const QString& text) {
  push(new MeshEdit(*this, mesh, name, text));
}

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

void Document::setRelaxation(const commands::SetRelaxation& relaxation, int gesture) {
  if (relaxation != relaxation_) {
    const QString text = relaxation.on == relaxation_.on ? QStringLiteral("relaxation's settings")
                         : relaxation.on                 ? QStringLiteral("relaxation on")
                                                         : QStringLiteral("relaxation off");
    push(new RelaxationEdit(*this, relaxation, text, gesture));
  }
}

void Document::showRelaxation(const commands::SetRelaxation& relaxation) {
  relaxation_ = relaxation;
  emit relaxationChanged();
}

void Document::setHighlight(const Highlight& highlight) {
  if (highlight != highlight_) {
    highlight_ = highlight;
    emit highlightChanged();
  }
}

void Document::select(std::vector<ElementId> elements) {
  if (elements != selection_.elements) {
    selection_.links = linksAmong(*mesh_, cuts_, elements);
    selection_.elements = std::move(elements);
    emit selectionChanged();
  }
}

void Document::showCuts(const std::vector<LinkId>& links, bool cut) {
  for (const LinkId link : links) {
    cut ? cuts_.cut(link) : cuts_.uncut(link);
  }
  emit cutsChanged();
  if (!selection_.empty()) {
    selection_.links = linksAmong(*mesh_, cuts_, selection_.elements);
    emit selectionChanged();
  }
}

void Document::showPins(const std::vector<ElementId>& elements, bool pinned) {
  pins_ = combined(pins_, elements, pinned ? SelectionMode::add : SelectionMode::remove);
  emit pinsChanged();
}

void Document::showSoftness(std::shared_ptr<const Softness> softness) {
  softness_ = std::move(softness);
  emit softnessChanged();
}

}  // namespace chainmail
