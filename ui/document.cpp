#include "document.h"

#include <algorithm>

#include "edits.h"
#include "text.h"

namespace chainmail {
namespace {

constexpr int samplingMilliseconds = 16;
// Some steps keep all positions, 16 MB a panel at a million elements.
constexpr int undoSteps = 30;

}  // namespace

Document::Document(MeshPointer mesh, const QString& name)
    : mesh_(std::move(mesh)), name_(name), cuts_(mesh_), parts_(mesh_) {
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
  connect(&undoStack_, &QUndoStack::indexChanged, this, &Document::lastDragChanged);
}

Document::~Document() {
  undoStack_.blockSignals(true);  // who listened is half gone
  undoStack_.clear();
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
  hand_ = Hand{element, newState()};
  post(commands::KeepState{hand_->before});
  post(commands::Grab{element});
}

void Document::drag(const Point& target) {
  if (hand_) {
    hand_->moved = true;
  }
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

void Document::forgetMoves() {
  log_->tape().load({});
  emit tapeChanged();
  emit lastDragChanged();
}

void Document::release() {
  post(commands::Release{});
  endDrag();
}

/// What the hand did so far becomes a step of undo; a press without a move is none.
void Document::endDrag() {
  if (const auto hand = std::exchange(hand_, {})) {
    if (hand->moved) {
      undoStack_.push(new DragEdit(*this, hand->element, hand->before));
    } else {
      post(commands::DropState{hand->before});
    }
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

void Document::replaceMesh(const MeshPointer& mesh, const QString& name, const QString& text,
                           std::map<LinkId, LinkSoftness> own) {
  push(new MeshEdit(*this, mesh, name, text, std::move(own)));
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

/// Before another mesh is there: who is told of this still asks for elements of the present one.
void Document::letGoOfElements() {
  setHighlight({});
  select({});
}

void Document::showCuts(const std::vector<LinkId>& links, bool cut) {
  cut ? parts_.cut(cuts_, links) : parts_.uncut(cuts_, links);
  emit cutsChanged(links, cut);
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
