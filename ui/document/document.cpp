#include "document/document.h"

#include <QDeadlineTimer>
#include <QThread>
#include <algorithm>

#include "common/text.h"
#include "document/edits.h"

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
  abandonMoves();                 // of all before the first is waited for
  undoStack_.blockSignals(true);  // who listened is half gone
  undoStack_.clear();
}

void Document::abandonMoves(std::chrono::milliseconds patience) {
  log_->flush();
  for (const QDeadlineTimer end(patience); !idle() && !end.hasExpired();) {
    QThread::msleep(1);
  }
  for (const auto& solver : solvers_) {
    solver->abandon();
  }
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
    tellRefusal(panel, QString::fromStdString(error));
  }
  emit frameReady(panel);
}

/// Every move of a hand is refused alike: it is said once.
void Document::tellRefusal(int panel, const QString& sentence) {
  if (std::exchange(told_[panel], sentence) == sentence) {
    return;
  }
  if (lacksPins(panel)) {
    emit unpinned(panel);
  } else {
    emit refused(sentence);
  }
}

void Document::grab(ElementId element) {
  endDrag();
  if (isPinned(element)) {
    log_->replay(commands::Grab{element});  // refused, and no move
    return;
  }
  takeInHand(element, QStringLiteral("drag of element %1").arg(element));
  post(commands::Grab{element});
}

void Document::grabControlPoint(std::uint32_t point) {
  endDrag();
  takeInHand({}, QStringLiteral("move of control point %1").arg(point));
  hand_->controlPoint = point;
}

void Document::takeInHand(std::optional<ElementId> element, const QString& text) {
  noteRelaxation();
  told_ = {};
  hand_ = Hand{element, 0, text, newState()};
  post(commands::KeepState{hand_->before});
}

void Document::dragControlPoint(const Point& target) {
  if (hand_) {
    hand_->moved = true;
    post(commands::MoveControlPoint{hand_->controlPoint, target});
  }
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
  if (!hand_ || hand_->element) {
    post(commands::Release{});
  }
  endDrag();
}

/// What the hand did so far becomes a step of undo; a press without a move is none.
void Document::endDrag() {
  if (const auto hand = std::exchange(hand_, {})) {
    if (hand->moved) {
      undoStack_.push(new DragEdit(*this, hand->text, hand->before));
    } else {
      post(commands::DropState{hand->before});
    }
  }
}

void Document::push(QUndoCommand* edit) {
  endDrag();
  told_ = {};
  undoStack_.push(edit);
}

void Document::undo() {
  endDrag();
  cutSweeps();
  undoStack_.undo();
}

void Document::redo() {
  endDrag();
  cutSweeps();
  undoStack_.redo();
}

/// None where the step of this gesture will be merged into the last one, which has kept the state before.
std::optional<commands::StateId> Document::stateFor(int gesture, const QString& text) {
  const QUndoCommand* last = undoStack_.command(undoStack_.index() - 1);
  const bool goesOn = gesture != 0 && last != nullptr && last->id() == gesture && last->text() == text &&
                      undoStack_.index() != undoStack_.cleanIndex();
  return goesOn ? std::nullopt : std::optional(newState());
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

void Document::resetObject() {
  cutSweeps();
  push(new ResetEdit(*this));
}

void Document::replaceMesh(const MeshPointer& mesh, const QString& name, const QString& text,
                           std::map<LinkId, LinkSoftness> own) {
  push(new MeshEdit(*this, mesh, name, text, std::move(own)));
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

}  // namespace chainmail
