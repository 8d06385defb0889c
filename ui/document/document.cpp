#include "document/document.h"

#include <QDeadlineTimer>
#include <QThread>
#include <algorithm>
#include <exception>
#include <iterator>
#include <memory>

#include "body/split_state.h"
#include "common/announce.h"
#include "common/application.h"
#include "common/held_memory.h"
#include "common/panel_names.h"
#include "common/text.h"
#include "files/session/session.h"
#include "mesh/error.h"

namespace chainmail {
namespace {

// An undo step may store all positions: 16 MB per panel for a million elements.
constexpr int undoSteps = 30;

/// Replaces the values that differ between `from` and `to`, and the algorithms of these panels.
void replaceValues(Contents& present, const Contents& from, const Contents& to, const std::vector<int>& panels) {
  const auto replace = [&](auto Contents::*value) {
    if (from.*value != to.*value) {
      present.*value = to.*value;
    }
  };
  replace(&Contents::object);
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

/// Throws Error if there is too little memory to work with a mesh, which exists already: to show it, to move it, to
/// undo and to save it automatically. Without this check, the graphics driver would crash before the first work is
/// saved. The figures are measured ones, with a margin: 220 bytes for an element of a grid with two panels.
void requireMemoryFor(const Mesh& mesh) {
  constexpr std::size_t forDrawing = 64 * 1024 * 1024, perElement = 200, perLink = 40;
  HeldMemory trial;
  if (!trial.hold(forDrawing + perElement * mesh.element_count() + perLink * mesh.links.size())) {
    throw Error("memory", "there is not enough to work with this object", "close other programs or use a smaller mesh");
  }
}

/// True if the object of a session is as recorded moves expect it at their beginning.
bool startsFromRest(const Session& session) {
  return session.moves_done == 0 && session.cuts.empty() && session.pins.empty() && *session.softness == Softness() &&
         !session.relaxation.on &&
         std::ranges::all_of(session.panels, [](const auto& panel) { return panel.positions.is_at_rest(); });
}

/// True for a change of the object. A handle must be released before it, or the change may be refused.
bool changesObject(const Command& command) {
  return std::holds_alternative<commands::Cut>(command) || std::holds_alternative<commands::Uncut>(command) ||
         std::holds_alternative<commands::Pin>(command) || std::holds_alternative<commands::Unpin>(command) ||
         std::holds_alternative<commands::Split>(command) || std::holds_alternative<commands::Reset>(command) ||
         std::holds_alternative<commands::SetSoftness>(command);
}

}  // namespace

/// A change on the undo stack. The solvers save the state of the object before the step. Undo and redo exchange the
/// saved state with the current one. So every position is restored exactly (bit for bit), also after drags and
/// relaxation.
class Document::Edit : public QUndoCommand {
 public:
  /// `state` identifies the saved state; none if the step will be merged into the previous one. `kept` is true if the
  /// solvers have saved it already.
  Edit(Document& document, Change change, std::optional<commands::StateId> state, bool kept = false)
      : QUndoCommand(change.text),
        document_(document),
        before_(document.contents_),
        change_(std::move(change)),
        state_(state),
        kept_(kept) {}

  ~Edit() override {
    try {
      if (state_) {
        document_.post(commands::DropState{*state_});
      }
    } catch (...) {
      // No memory for the command: the solvers keep a state that nobody needs.
    }
  }

  void redo() override {
    if (done_) {
      exchange(before_, change_.after, true);
      return;
    }
    done_ = true;
    if (state_ && !kept_) {
      document_.post(commands::KeepState{*state_});
    }
    try {
      document_.carryOut(change_, before_);
    } catch (...) {  // no memory for a command: the solvers return to the state before
      if (state_) {
        document_.post(commands::RestoreState{*state_});
      }
      throw;
    }
    change_.carryOut = {};
    show(before_, change_.after, true);
  }

  void undo() override { exchange(change_.after, before_, false); }

  int id() const override { return change_.gesture == 0 ? -1 : change_.gesture; }

  bool mergeWith(const QUndoCommand* later) override {
    const auto* other = dynamic_cast<const Edit*>(later);
    if (other == nullptr || other->text() != text()) {
      return false;
    }
    change_.after = other->change_.after;
    return true;
  }

 private:
  void exchange(const Contents& from, const Contents& to, bool done) {
    const commands::StateId now = document_.newState();
    document_.post(commands::KeepState{now});
    document_.postSettings(from, to, from.object != to.object);
    document_.post(commands::RestoreState{*state_});
    document_.post(commands::DropState{*state_});
    state_ = now;
    show(from, to, done);
  }

  /// The step must reach the stack, or leave it, whatever fails here.
  void show(const Contents& from, const Contents& to, bool done) {
    Application::guarded([&] { document_.show(change_, from, to, done); });
  }

  Document& document_;
  Contents before_;
  Change change_;
  std::optional<commands::StateId> state_;
  bool kept_;
  bool done_ = false;  // true after the first redo()
};

Document::Document(MeshPointer mesh, const QString& name) {
  contents_.object = std::make_shared<DocumentObject>(std::move(mesh), name);
  contents_.algorithms = {Algorithm::generalized, Algorithm::natural_queue};
  log_ = std::make_unique<CommandLog>(std::vector<SolverThread*>());
  for (int panel = 0; panel < minPanels; ++panel) {
    addSolver(std::make_unique<SolverThread>(this->mesh(), algorithm(panel), frameAnnouncer(panel), idleAnnouncer()));
  }
  undoStack_.setUndoLimit(undoSteps);
  connect(&undoStack_, &QUndoStack::indexChanged, this, &Document::lastDragChanged);
}

Document::~Document() {
  abandonMoves();                 // for all solvers, before the first one is destroyed and waits for its thread
  undoStack_.blockSignals(true);  // listeners may be deleted already
  undoStack_.clear();
}

// Edits: each change becomes one undo step.

Change Document::change(const QString& text, int gesture) const {
  Change result;
  result.text = text;
  result.after = contents_;
  result.gesture = gesture;
  return result;
}

void Document::apply(Change change) {
  endDrag();
  lastRefusal_ = {};
  const auto state = stateFor(change.gesture, change.text);
  auto edit = std::make_unique<Edit>(*this, std::move(change), state);
  undoStack_.push(edit.get());  // may throw before it takes the edit over
  static_cast<void>(edit.release());
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
  const bool follows = change.split || change.followsTape;  // the solvers get the object from these commands
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
  postSettings(before, after, false);
  if (change.carryOut) {
    change.carryOut();
  }
}

/// Posts the settings that a saved state does not contain. The solvers still have the previous mesh if `neutral` is
/// true. Then Natural Queue runs instead of an algorithm that may not work on that mesh. Exact is not replaced: it
/// works on any mesh and stores positions in its own way.
void Document::postSettings(const Contents& from, const Contents& to, bool neutral) {
  if (to.relaxation != from.relaxation) {
    post(to.relaxation);
  }
  if (to.elastic != from.elastic) {
    post(commands::SetElastic{to.elastic});
  }
  for (const int panel : panelsToSwitch(from, to)) {
    const Algorithm target = to.algorithms[std::size_t(panel)];
    if (target != from.algorithms[std::size_t(panel)]) {
      postAlgorithm(panel, neutral && target != Algorithm::exact ? Algorithm::natural_queue : target);
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
    setHighlight({});
    select({});
  }
  replaceValues(contents_, from, to, panels);
  for (const int panel : isOther ? panels : std::vector<int>()) {
    postAlgorithm(panel, algorithm(panel));
  }
  if (change.sessionFile) {
    std::swap(*change.sessionFile, sessionFile_);
    Application::guarded([this] { emit sessionFileChanged(); });
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
  if (change.followsTape) {
    setHighlight({});
    showMoves();
  }
}

void Document::showCuts(const std::vector<LinkId>& links, bool cut) {
  DocumentObject& object = *contents_.object;
  cut ? object.parts.cut(object.cuts, links) : object.parts.uncut(object.cuts, links);
  Application::guarded([&] { emit cutsChanged(links, cut); });
  if (!selection_.empty()) {
    selection_.links = linksAmong(*object.mesh, object.cuts, selection_.elements);
    Application::guarded([this] { emit selectionChanged(); });
  }
}

void Document::showPins(const std::vector<ElementId>& elements, bool pinned) {
  auto& pins = contents_.object->pins;
  pins = combined(pins, elements, pinned ? SelectionMode::add : SelectionMode::remove);
  Application::guarded([this] { emit pinsChanged(); });
}

void Document::undo() {
  endDrag();
  endSweeps();
  undoStack_.undo();
}

void Document::redo() {
  endDrag();
  endSweeps();
  undoStack_.redo();
}

// The edits themselves.

void Document::setSoftness(const LinkSoftness& global, const QString& text, int gesture) {
  if (global != softness()) {
    Change edit = change(text, gesture);
    edit.after.softness = std::make_shared<const Softness>(
        Softness{global, wholeSoftness()->links, wholeSoftness()->energy, wholeSoftness()->axes});
    apply(std::move(edit));
  }
}

void Document::setFrame(AxesKind kind) {
  const RegionAxes axes = kind == AxesKind::object ? principal_axes(*mesh()).axes : RegionAxes();
  if (kind != AxesKind::given && axes != wholeSoftness()->axes) {
    Softness softness = *wholeSoftness();
    softness.axes = axes;
    Change edit = change(kind == AxesKind::object ? QStringLiteral("regions along the object's axes")
                                                  : QStringLiteral("regions along the axes"));
    edit.after.softness = std::make_shared<const Softness>(std::move(softness));
    apply(std::move(edit));
  }
}

void Document::setEnergy(EnergyKind kind) {
  if (kind != wholeSoftness()->energy) {
    Softness softness = *wholeSoftness();
    set_energy(softness, kind);
    Change edit = change(QString::fromStdString(std::string(info(kind).name)) + QStringLiteral(" energy"));
    edit.after.softness = std::make_shared<const Softness>(std::move(softness));
    apply(std::move(edit));
  }
}

void Document::setSoftnessOf(const std::vector<LinkId>& links, const std::optional<LinkSoftness>& own) {
  Softness softness = *wholeSoftness();
  own ? softness.links.set(links, *own) : softness.links.erase(links);
  if (softness.links != wholeSoftness()->links) {
    Change edit = change(counted(QStringLiteral("softness of"), links.size(), QStringLiteral("link")));
    edit.after.softness = std::make_shared<const Softness>(std::move(softness));
    apply(std::move(edit));
  }
}

void Document::resetSoftness() {
  if (*wholeSoftness() != Softness()) {
    Change edit = change(QStringLiteral("reset softness"));
    edit.after.softness = std::make_shared<const Softness>();
    apply(std::move(edit));
  }
}

void Document::setRelaxation(const commands::SetRelaxation& relaxation, int gesture) {
  const commands::SetRelaxation& present = contents_.relaxation;
  if (relaxation != present) {
    Change edit = change(relaxation.on == present.on ? QStringLiteral("relaxation settings")
                         : relaxation.on             ? QStringLiteral("relaxation on")
                                                     : QStringLiteral("relaxation off"),
                         gesture);
    edit.after.relaxation = relaxation;
    apply(std::move(edit));
  }
}

void Document::setSoftnessAndRelaxation(const LinkSoftness& global, const commands::SetRelaxation& relaxation,
                                        const QString& text) {
  if (global != softness() || relaxation != contents_.relaxation) {
    Change edit = change(text);
    if (global != softness()) {
      edit.after.softness = std::make_shared<const Softness>(
          Softness{global, wholeSoftness()->links, wholeSoftness()->energy, wholeSoftness()->axes});
    }
    edit.after.relaxation = relaxation;
    apply(std::move(edit));
  }
}

void Document::setElastic(const ElasticOptions& options, const QString& text, int gesture) {
  if (options != elastic()) {
    Change edit = change(text, gesture);
    edit.after.elastic = options;
    apply(std::move(edit));
  }
}

void Document::setAlgorithm(int panel, Algorithm algorithm) {
  try {
    check(algorithm, *mesh());
  } catch (const Error& error) {
    emit refused(QString::fromStdString(error.what()));
    emit algorithmChanged(panel);  // so that selectors show the running algorithm again
    return;
  }
  if (this->algorithm(panel) != algorithm) {
    Change edit = change(chainmail::text(info(algorithm).label));
    edit.after.algorithms[std::size_t(panel)] = algorithm;
    apply(std::move(edit));
  }
}

bool Document::isPinned(ElementId element) const { return std::ranges::binary_search(pins(), element); }

void Document::setPinned(const std::vector<ElementId>& elements, bool pinned) {
  if (!elements.empty()) {
    Change edit = change(
        counted(pinned ? QStringLiteral("pin") : QStringLiteral("unpin"), elements.size(), QStringLiteral("element")));
    (pinned ? edit.pin : edit.unpin) = elements;
    apply(std::move(edit));
  }
}

void Document::cut(const std::vector<LinkId>& links) {
  if (!links.empty()) {
    Change edit = change(counted(QStringLiteral("cut"), links.size(), QStringLiteral("link")));
    edit.cut = links;
    apply(std::move(edit));
  }
}

void Document::split(const SplitPointer& split, const std::vector<LinkId>& cut) {
  Change edit = change(QStringLiteral("cut along a stroke"));
  std::vector<LinkId> all = cuts_after(*split, cuts().links());
  std::ranges::set_difference(cuts_after(*split, cut), all, std::back_inserter(edit.cut));
  const auto old = all.insert(all.end(), edit.cut.begin(), edit.cut.end());
  std::inplace_merge(all.begin(), old, all.end());
  edit.after.object = objectOf(split->after, all, pins_after(*split, pins()));
  edit.after.softness = softness_after(*split, wholeSoftness());
  edit.split = split;
  apply(std::move(edit));
}

/// Returns the present object with another mesh, before or after splits.
std::shared_ptr<DocumentObject> Document::objectOf(const MeshPointer& mesh, const std::vector<LinkId>& cuts,
                                                   std::vector<ElementId> pins) const {
  auto object = std::make_shared<DocumentObject>(mesh, name());
  object->unsplit = unsplitMesh();
  object->file = meshFile();
  object->lesson = lesson();
  object->before = contents_.object->before;
  object->parts.cut(object->cuts, cuts);
  object->pins = std::move(pins);
  return object;
}

void Document::resetObject() {
  endSweeps();
  Change edit = change(QStringLiteral("reset object"));
  edit.carryOut = [this] { post(commands::Reset{}); };
  apply(std::move(edit));
}

/// Returns the user's settings: during a lesson, those from before it.
std::shared_ptr<const SettingsBefore> Document::ownSettings() const {
  if (contents_.object->before) {
    return contents_.object->before;
  }
  const auto& algorithms = contents_.algorithms;
  return std::make_shared<const SettingsBefore>(
      SettingsBefore{contents_.softness, contents_.relaxation, contents_.elastic,
                     std::vector(algorithms.begin(), algorithms.begin() + panels())});
}

/// The object after a lesson gets the user's settings, not those of the lesson.
void Document::takeOwnSettings(Contents& after) const {
  const auto own = ownSettings();
  after.softness = own->softness;
  after.relaxation = own->relaxation;
  after.elastic = own->elastic;
  for (std::size_t panel = 0; panel < std::min(own->algorithms.size(), solvers_.size()); ++panel) {
    after.algorithms[panel] = own->algorithms[panel];
  }
}

Change Document::meshChange(const MeshPointer& mesh, const QString& name, const QString& text, OwnSoftness own) const {
  requireMemoryFor(*mesh);
  Change edit = change(text);
  takeOwnSettings(edit.after);
  edit.after.object = std::make_shared<DocumentObject>(mesh, name);
  Softness carried = kept_for(*mesh, *edit.after.softness);
  carried.links = std::move(own);
  if (carried != *edit.after.softness) {
    edit.after.softness = std::make_shared<const Softness>(std::move(carried));
  }
  return edit;
}

void Document::replaceMesh(const MeshPointer& mesh, const QString& name, const QString& text, OwnSoftness own) {
  Change edit = meshChange(mesh, name, text, std::move(own));
  edit.sessionFile = QString();
  apply(std::move(edit));
}

void Document::reworkMesh(const MeshPointer& mesh, const QString& name, const QString& text, OwnSoftness own) {
  Change edit = meshChange(mesh, name, text, std::move(own));
  edit.after.object->file = meshFile();
  apply(std::move(edit));
}

void Document::restore(const std::shared_ptr<const Session>& session, const QString& file, const QString& text) {
  requireMemoryFor(*session->mesh);
  Change edit = change(text);
  auto object = std::make_shared<DocumentObject>(session->mesh, QString::fromStdString(session->name));
  object->parts.cut(object->cuts, session->cuts);
  object->pins = session->pins;
  if (!session->lesson.steps.empty()) {
    object->lesson = session;
    object->before = ownSettings();
  }
  object->unsplit = first_mesh(*session);
  edit.after.object = std::move(object);
  edit.after.softness = session->softness;
  edit.after.relaxation = session->relaxation;
  edit.after.elastic = session->elastic;
  for (std::size_t panel = 0; panel < solvers_.size(); ++panel) {
    Algorithm& algorithm = edit.after.algorithms[panel];
    algorithm = panel < session->panels.size()    ? session->panels[panel].algorithm
                : fits(algorithm, *session->mesh) ? algorithm
                                                  : Algorithm::natural_queue;
  }
  edit.sessionFile = file;
  edit.carryOut = [this, session] { placeSession(session); };
  apply(std::move(edit));
}

/// Loads the moves and the positions of a session. The solvers already have its object. A session without moves gets
/// recorded commands that start with the object at rest. The positions are posted last: relaxation sleeps after them,
/// so that no element moves.
void Document::placeSession(const std::shared_ptr<const Session>& session) {
  const std::vector<Command> object{commands::SetSoftness{session->softness}, commands::Cut{session->cuts},
                                    commands::Pin{session->pins}};
  const bool hasMoves = !session->moves.empty();
  log_->flush();  // to the history that is replaced below
  log_->history().load(hasMoves ? session->moves : object);
  log_->history().go_to(hasMoves ? session->moves_done : object.size());
  lessonTimeline_ = moveHistory().timeline();
  replayed_ = hasMoves && startsFromRest(*session);
  for (int panel = 0; panel < panels(); ++panel) {
    const auto& saved = session->panels;
    const auto& from = std::size_t(panel) < saved.size() ? saved[std::size_t(panel)] : saved.front();
    // The pointer shares the session instead of copying its numbers.
    log_->post_to(*solvers_[std::size_t(panel)],
                  commands::SetPositions{std::shared_ptr<const Snapshot>(session, &from.positions)});
  }
}

void Document::setSessionFile(const QString& file) {
  if (file != sessionFile_) {
    sessionFile_ = file;
    emit sessionFileChanged();
  }
}

void Document::setMeshFile(const QString& file) {
  contents_.object->file = file;
  emit meshFileChanged();
}

// The handle: its moves go directly to the solvers, and a drag becomes an undo step when it ends.

void Document::grab(std::vector<ElementId> elements) {
  endDrag();
  std::ranges::sort(elements);
  std::vector<ElementId> free;
  std::ranges::set_difference(elements, pins(), std::back_inserter(free));
  if (free.empty()) {
    lastRefusal_ = {};                                  // each attempt is answered
    log_->replay(commands::Grab{std::move(elements)});  // the solvers refuse it, and nothing is recorded
    return;
  }
  beginDrag(free, free.size() == 1 ? QStringLiteral("drag of element %1").arg(free.front())
                                   : counted(QStringLiteral("drag of"), free.size(), QStringLiteral("element")));
  post(commands::Grab{std::move(free)});
}

void Document::grabControlPoint(std::uint32_t point) {
  endDrag();
  beginDrag({}, QStringLiteral("move of control point %1").arg(point));
  handle_->controlPoint = point;
}

void Document::beginDrag(std::vector<ElementId> elements, const QString& text) {
  noteRelaxation();
  lastRefusal_ = {};
  handle_ = Handle{std::move(elements), 0, text, newState()};
  post(commands::KeepState{handle_->before});
}

void Document::drag(const Point& target) { postDrag({target}); }

void Document::dragBy(const Point& by, const Rotation& rotation) { postDrag({by, rotation, true}); }

/// A drag of nothing, for example after all elements of a grab were pinned, must not be recorded: no session with it
/// could be opened.
void Document::postDrag(const commands::Drag& drag) {
  if (handle_ && !handle_->elements.empty()) {
    handle_->moved = true;
    post(drag);
  }
}

void Document::dragControlPoint(const Point& target) {
  if (handle_) {
    handle_->moved = true;
    post(commands::MoveControlPoint{handle_->controlPoint, target});
  }
}

void Document::release() {
  if (!handle_) {
    post(commands::Release{});
  }
  endDrag();
}

void Document::cancelDrag() {
  const auto handle = std::exchange(handle_, {});
  if (!handle) {
    return;
  }
  if (!handle->elements.empty()) {
    post(commands::Release{});
  }
  if (handle->moved) {
    post(commands::RestoreState{handle->before});
  }
  post(commands::DropState{handle->before});
}

/// Ends the drag. It becomes an undo step if anything moved. The solvers release the handle, because the next change
/// may be refused for its elements.
void Document::endDrag() {
  if (const auto handle = std::exchange(handle_, {})) {
    if (!handle->elements.empty()) {
      post(commands::Release{});
    }
    if (handle->moved) {
      undoStack_.push(new Edit(*this, change(handle->text), handle->before, true));
    } else {
      post(commands::DropState{handle->before});
    }
  }
}

// The solvers: commands go there through one log, frames come back.

void Document::post(const Command& command) {
  // The recorded commands may end within a drag, as in a session that was saved while dragging.
  if (!handle_ && changesObject(command) && moveHistory().holds()) {
    log_->post(commands::Release{});
  }
  log_->post(command);
  replayed_ = replayed_ && (std::holds_alternative<commands::KeepState>(command) ||
                            std::holds_alternative<commands::DropState>(command));
  if (log_->waits()) {
    log_->sample();
  }
  Application::guarded([this] { emit movesChanged(); });
}

/// Called when a solver has become idle. Sends the newest move, which waits for the slowest solver, as soon as all are
/// idle.
void Document::receiveIdle() {
  idleAnnounced_ = false;
  if (log_->waits()) {
    log_->sample();
    if (!log_->waits()) {
      emit movesChanged();
    }
  }
  if (idle()) {
    emit becameIdle();
  }
}

void Document::receiveFrame(int panel) {
  frameAnnounced_[std::size_t(panel)] = false;
  if (panel >= panels()) {
    return;  // the panel was removed in the meantime
  }
  SolverThread& solver = *solvers_[std::size_t(panel)];
  frames_[std::size_t(panel)] = &solver.latest_frame();
  if (const std::string error = solver.take_error(); !error.empty()) {
    reportRefusal(panel, QString::fromStdString(error));
  }
  emit frameReady(panel);
}

/// Emits each refusal only once, because every move of a drag is refused for the same reason.
void Document::reportRefusal(int panel, const QString& sentence) {
  if (std::exchange(lastRefusal_[std::size_t(panel)], sentence) == sentence) {
    return;
  }
  if (lacksPins(panel)) {
    emit unpinned(panel);
  } else {
    emit refused(sentence);
  }
}

std::function<void()> Document::frameAnnouncer(int panel) {
  return [this, panel] {
    announceOnce(frameAnnounced_[std::size_t(panel)], this, [this, panel] { receiveFrame(panel); });
  };
}

std::function<void()> Document::idleAnnouncer() {
  return [this] { announceOnce(idleAnnounced_, this, &Document::receiveIdle); };
}

bool Document::idle() const {
  return !log_->waits() && std::ranges::all_of(solvers_, [](auto& one) { return one->idle(); });
}

bool Document::settled() const {
  for (std::size_t panel = 0; panel < solvers_.size(); ++panel) {
    const SolverThread& solver = *solvers_[panel];
    if (!solver.settled() || frames_[panel]->number != solver.newest_frame()) {
      return false;
    }
  }
  return !log_->waits() && std::ranges::none_of(frameAnnounced_, [](auto& one) { return one.load(); });
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

void Document::goOn() {
  for (const auto& solver : solvers_) {
    solver->go_on();
  }
}

void Document::ask(int panel, SolverThread::Question question) {
  log_->flush();
  solvers_[std::size_t(panel)]->ask(std::move(question));
}

std::future<Snapshot> Document::snapshot(int panel) {
  const auto promise = std::make_shared<std::promise<Snapshot>>();
  ask(panel, [promise, panel, mesh = mesh()](const Simulation& simulation) {
    try {
      if (simulation.mesh_pointer() != mesh) {
        throw Error("panel " + panelName(panel).toStdString(), "its solver could not take over the object",
                    "undo the last step");
      }
      promise->set_value(simulation.snapshot());
    } catch (...) {
      promise->set_exception(std::current_exception());
    }
  });
  return promise->get_future();
}

void Document::recordPasses(bool on) {
  recordsPasses_ = on;
  for (const auto& solver : solvers_) {
    solver->record_passes(on);
  }
}

// Panels: each has a solver, an algorithm and a frame.

void Document::addSolver(std::unique_ptr<SolverThread> solver) {
  log_->add(*solver);
  solver->record_passes(recordsPasses_);
  frames_[std::size_t(panels())] = &solver->latest_frame();
  solvers_.push_back(std::move(solver));
  contents_.panels = panels();
}

void Document::addPanel() {
  if (panels() < maxPanels) {
    const Algorithm algorithm = unusedAlgorithm();
    log_->flush();
    // May find no memory or no thread, so it comes before any change.
    auto solver =
        std::make_unique<SolverThread>(*solvers_.front(), algorithm, frameAnnouncer(panels()), idleAnnouncer());
    dropWaypoints();
    replayed_ = false;  // the new panel has not replayed anything
    contents_.algorithms[std::size_t(panels())] = algorithm;
    addSolver(std::move(solver));
    emit panelsChanged();
  }
}

void Document::removePanel() {
  if (panels() > minPanels) {
    emit panelLeaves(panels() - 1);
    log_->remove(*solvers_.back());
    solvers_.pop_back();
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

/// Free-form deformation is the only elastic method that needs no pins.
bool Document::lacksPins(int panel) const { return pins().empty() && info(algorithm(panel)).needs_pins; }

void Document::postAlgorithm(int panel, Algorithm algorithm) {
  dropWaypoints();
  replayed_ = false;
  log_->post_to(*solvers_[std::size_t(panel)], commands::SetAlgorithm{algorithm});
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

const Frame* Document::frame(int panel) const {
  if (panel >= panels()) {
    return nullptr;
  }
  const Frame* instead = instead_[std::size_t(panel)];
  const Frame* frame = instead != nullptr ? instead : frames_[std::size_t(panel)];
  return frame->mesh == mesh() ? frame : nullptr;
}

void Document::showInstead(int panel, const Frame* frame) {
  if (frame != nullptr || instead_[std::size_t(panel)] != nullptr) {
    instead_[std::size_t(panel)] = frame;
    emit frameReady(panel);
  }
}

// Highlight and selection.

void Document::setHighlight(const Highlight& highlight) {
  if (highlight != highlight_) {
    highlight_ = highlight;
    Application::guarded([this] { emit highlightChanged(); });
  }
}

void Document::prepareDrag(std::optional<ElementId> element) {
  for (const auto& solver : solvers_) {
    solver->prepare(element);
  }
}

int Document::preparedDrags() const {
  const auto of = [](const auto& solver) { return solver->prepared(); };
  return of(*std::ranges::min_element(solvers_, {}, of));
}

void Document::addToHighlight(std::span<const LinkId> links) {
  if (!links.empty()) {
    highlight_.links.insert(highlight_.links.end(), links.begin(), links.end());
    emit highlightChanged();
  }
}

void Document::select(std::vector<ElementId> elements) {
  if (elements != selection_.elements) {
    selection_.links = linksAmong(*mesh(), cuts(), elements);
    selection_.elements = std::move(elements);
    Application::guarded([this] { emit selectionChanged(); });
  }
}

}  // namespace chainmail
