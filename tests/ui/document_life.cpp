// A document that goes through a long random life is always the same as a new one that was made from its session.

#include <QEventLoop>
#include <QTest>
#include <QTimer>
#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <map>
#include <memory>
#include <ostream>
#include <sstream>

#include "core/invariants.h"
#include "document/document.h"
#include "document/edits.h"
#include "document/element_facts.h"
#include "document/session_draft.h"
#include "mesh/generate.h"
#include "mesh/split_along.h"
#include "program.h"
#include "property.h"

namespace chainmail::test_document_life {

using namespace chainmail::test;

namespace {

/// What a person may do. Each kind draws what it needs from the numbers of an Action.
enum class Kind {
  drag,
  drag_many,
  drag_and_keep,
  cancel_drag,
  cut,
  split,
  pin,
  unpin,
  soften,
  soften_links,
  reset_softness,
  change_energy,
  turn_regions,
  set_relaxation,
  relax,
  change_material,
  change_algorithm,
  add_panel,
  remove_panel,
  replace_mesh,
  reset,
  load_moves,
  go_to,
  select,
  reload,
  restart,
  undo,
  redo,
  count
};

struct Action {
  Kind kind = Kind::drag;
  std::uint32_t which = 0, how = 0;
  int x = 0, y = 0;  // eighths of a mesh unit
};

std::ostream& operator<<(std::ostream& out, const Action& action) {
  return out << "{Kind(" << int(action.kind) << "), " << action.which << ", " << action.how << ", " << action.x << ", "
             << action.y << "}";
}

rc::Gen<Action> any_action() {
  return rc::gen::build<Action>(
      // Small inputs are short lives, not lives without undo, which is one of the last kinds.
      rc::gen::set(&Action::kind, rc::gen::resize(rc::kNominalSize, rc::gen::map(rc::gen::inRange(0, int(Kind::count)),
                                                                                 [](int i) { return Kind(i); }))),
      rc::gen::set(&Action::which, rc::gen::inRange<std::uint32_t>(0, 1000)),
      rc::gen::set(&Action::how, rc::gen::inRange<std::uint32_t>(0, 1000)),
      rc::gen::set(&Action::x, rc::gen::inRange(-12, 13)), rc::gen::set(&Action::y, rc::gen::inRange(-12, 13)));
}

std::vector<MeshPointer> meshes() {
  static const std::vector<MeshPointer> all{jittered_triangles(4, 4, 2), generate({MeshKind::grid, {5, 4, 1}, 1, {}}),
                                            generate({MeshKind::cloth, {4, 4, 1}, 0.7, {}}),
                                            generate({MeshKind::tetra, {3, 2, 2}, 1, {}}),
                                            generate({MeshKind::line, {6, 1, 1}, 1, {}})};
  return all;
}

/// Waits until the solvers have done everything, or, with `frames`, until their last frames have also arrived.
bool has_done_all(Document& document, bool frames = false) {
  constexpr int patience = 60'000, again = 2;  // ms
  const QDeadlineTimer end(patience);
  const auto has = [&] { return frames ? document.solvers().settled() : document.solvers().idle(); };
  while (!has() && !end.hasExpired()) {
    QEventLoop loop;
    QObject::connect(&document.solvers(), &PanelSolvers::frameReady, &loop, &QEventLoop::quit);
    QObject::connect(&document.solvers(), &PanelSolvers::becameIdle, &loop, &QEventLoop::quit);
    QTimer::singleShot(again, &loop, &QEventLoop::quit);
    loop.exec();
  }
  return has();
}

/// Everything of a document that a person could see or save.
struct DocumentState {
  std::string object;  // as a session, without positions and moves
  std::string done;    // the same with the moves that are done
  std::string moves;   // the same with all moves
  QStringList facts;
  std::vector<Algorithm> algorithms;
  std::vector<std::vector<float>> positions;  // one for each panel
};

/// Moves without releases: a document that holds something releases it before the next step.
std::string text_of(Session session, std::span<const Command> moves, std::size_t done) {
  const auto releases = [](const Command& command) { return std::holds_alternative<commands::Release>(command); };
  session.moves_done = done - std::size_t(std::ranges::count_if(moves.first(done), releases));
  session.moves.assign(moves.begin(), moves.end());
  std::erase_if(session.moves, releases);
  for (Session::Panel& panel : session.panels) {
    panel.positions = {};
  }
  std::ostringstream text;
  write_session(text, session);
  return text.str();
}

/// The state of a panel's solver.
struct SolverState {
  bool agrees = false;  // with the values of the document
  std::vector<float> positions;
};

SolverState state_of(Document& document, int panel) {
  std::promise<SolverState> answer;
  document.solvers().ask(panel, [&](const Simulation& now) {
    SolverState state;
    state.agrees = now.mesh_pointer() == document.mesh() && now.softness() == *document.wholeSoftness() &&
                   now.elastic() == document.elastic() && now.relaxation() == document.relaxation() &&
                   now.statistics().algorithm == document.algorithm(panel) &&
                   std::ranges::equal(now.body().pins(), document.pins()) &&
                   now.body().cuts().links() == document.cuts().links();
    state.positions.resize(now.mesh().rest.size());
    now.body().copy_positions(0, state.positions);
    answer.set_value(std::move(state));
  });
  return answer.get_future().get();
}

/// The commands with which a document records an object that came without moves.
struct Prefix {
  std::size_t length = 0;
  const Softness* softness = nullptr;  // of the first one

  explicit Prefix(const MoveHistory& history) : length(history.length()), softness(first_softness(history)) {}
  Prefix() = default;

  static const Softness* first_softness(const MoveHistory& history) {
    const auto* first = history.length() == 0 ? nullptr : std::get_if<commands::SetSoftness>(&history.at(0));
    return first == nullptr ? nullptr : first->softness.get();
  }
  /// Returns how many of these commands are still there.
  std::size_t in(const MoveHistory& history) const {
    return length > 0 && history.length() >= length && first_softness(history) == softness ? length : 0;
  }
};

DocumentState observed(Document& document, const Prefix& prefix = {}) {
  RC_ASSERT(has_done_all(document));
  const Session session = SessionDraft(document, "{}").finished({});
  const std::size_t skip = prefix.in(document.moves().history());
  const auto moves = std::span(session.moves).subspan(skip);
  const std::size_t done = session.moves_done - skip;
  DocumentState state{
      text_of(session, {}, 0), text_of(session, moves.first(done), done), text_of(session, moves, done), {}, {}, {}};
  state.facts << QStringLiteral("parts %1").arg(document.parts())
              << QStringLiteral("unsplit %1").arg(document.unsplitMesh()->link_count())
              << QStringLiteral("files ") + document.files().session()
              << QStringLiteral("last drag %1").arg(document.moves().lastDrag().size())
              << QStringLiteral("selected %1, %2")
                     .arg(document.selection().elements().size())
                     .arg(document.selection().links().size());
  for (int panel = 0; panel < document.panels(); ++panel) {
    SolverState solver = state_of(document, panel);
    RC_ASSERT(solver.agrees);
    state.algorithms.push_back(document.algorithm(panel));
    state.positions.push_back(std::move(solver.positions));
    state.facts << QStringLiteral("lacks pins %1").arg(lacksPins(document, panel));
  }
  return state;
}

/// How far positions of two documents may differ (mesh units): those of ChainMail are the same to the bit. Methods that
/// iterate start from the answer before, or end within a tolerance; Exact rounds a repaired state.
float tolerance_of(Algorithm algorithm) {
  return info(algorithm).elastic ? 1e-3F : algorithm == Algorithm::exact ? 1e-5F : 0;
}

/// Describes the first position that differs; empty if there is none.
std::string difference(const DocumentState& lived, const DocumentState& fresh, bool to_the_bit) {
  for (std::size_t panel = 0; panel < lived.positions.size(); ++panel) {
    const auto &a = lived.positions[panel], &b = fresh.positions[panel];
    const float tolerance = to_the_bit ? 0 : tolerance_of(lived.algorithms[panel]);
    for (std::size_t i = 0; i < std::max(a.size(), b.size()); ++i) {
      if (a.size() != b.size() || !(std::abs(a[i] - b[i]) <= tolerance * (1 + std::abs(a[i])))) {
        return "panel " + std::to_string(panel) + ", coordinate " + std::to_string(i) + ": " +
               std::to_string(i < a.size() ? a[i] : 0) + " and " + std::to_string(i < b.size() ? b[i] : 0);
      }
    }
  }
  return {};
}

/// True for settings with which the last handle answers again. A session does not hold that handle.
bool answers_again(Kind kind) {
  return kind == Kind::change_algorithm || kind == Kind::soften || kind == Kind::soften_links ||
         kind == Kind::reset_softness || kind == Kind::turn_regions || kind == Kind::change_energy ||
         kind == Kind::change_material;
}

/// What the solver of a panel has.
struct PanelFacts {
  explicit PanelFacts(const Simulation& now) : object(now), statistics(now.statistics()) {}

  ObjectFacts object;
  Statistics statistics;
};

PanelFacts facts_of(Document& document, int panel) {
  std::promise<PanelFacts> answer;
  document.solvers().ask(panel, [&](const Simulation& now) { answer.set_value(PanelFacts(now)); });
  return answer.get_future().get();
}

/// A move of a handle in a drag.
struct Motion {
  std::vector<ElementId> elements;
  Point by = Point::Zero();
  double degrees = 0;  // about z
};

/// Returns what cannot be right with an object in a panel. `motion`: of the drag that was just done, if it was one.
std::string flaw_of(const Document& document, int panel, const ObjectFacts& facts, const Motion* motion) {
  const AlgorithmInfo& algorithm = info(document.algorithm(panel));
  constexpr double rounding = 1e-3;  // of positions in single precision (mesh units)
  if (facts.mesh != document.mesh() || !std::ranges::equal(facts.pins, document.pins())) {
    return facts.mesh == document.mesh() ? "pins" : "mesh";
  }
  if (document.parts() != LinkedParts(*facts.mesh, facts.cuts).count()) {
    return "parts";
  }
  // Turned axes of an object in space are not about z.
  const bool holds = motion != nullptr && algorithm.holds_links && !facts.softness->axes.is_turned();
  return holds && facts.largest_excess({motion->elements.begin(), motion->elements.end()}) > rounding
             ? "a link outside its region"
             : "";
}

/// Returns true if the elements of a drag are where its motion takes them.
bool has_arrived(const Motion& motion, const ObjectFacts& before, const ObjectFacts& after) {
  std::vector<ElementId> moved = motion.elements;
  std::erase_if(moved, [&](ElementId e) { return before.pins.contains(e); });
  Point pivot = Point::Zero();
  for (const ElementId e : moved) {
    pivot += before.positions[e] / double(moved.size());
  }
  return std::ranges::all_of(moved, [&](ElementId e) {
    const Point to = pivot + motion.by + turned_about_z(before.positions[e] - pivot, motion.degrees);
    return (after.positions[e] - to).norm() <= 1e-4;
  });
}

/// A document, and what it looked like after each step that it can undo.
class Life {
 public:
  explicit Life(const MeshPointer& mesh = meshes()[0])
      : document_(std::make_unique<Document>(mesh, QStringLiteral("first"))) {
    remember(observed(*document_));
  }

  /// The frames show what the solvers have.
  void look() {
    RC_ASSERT(has_done_all(*document_, true));
    for (int panel = 0; panel < document_->panels(); ++panel) {
      RC_ASSERT(document_->solvers().frame(panel) != nullptr);
      RC_ASSERT(document_->solvers().frame(panel)->positions == state_of(*document_, panel).positions);
    }
  }

  /// Carries out an action. With `compares`, a document that is made from the session does so, too.
  void act(const Action& action, bool compares = true) {
    Prefix prefix;
    std::unique_ptr<Document> fresh;
    if (compares || action.kind == Kind::restart) {
      const DocumentState before = observed(*document_);
      fresh = renewed(prefix);
      check(observed(*fresh, prefix), before, "made from the session");
    }
    if (action.kind == Kind::undo || action.kind == Kind::redo) {
      return travel(action.kind == Kind::undo);
    }
    if (action.kind == Kind::restart) {
      document_ = std::move(fresh);
      states_.clear();
      return remember(observed(*document_));
    }
    forget_undone();
    const auto step = step_of(action);
    const Asked asked(*this, action);
    const QStringList said = carried_out(*document_, step, 0, compares);
    const DocumentState after = observed(*document_);
    asked.check();
    if (compares && action.kind != Kind::relax) {  // sweeps in idle time: their number differs
      RC_ASSERT(carried_out(*fresh, step, prefix.in(fresh->moves().history())).isEmpty() == said.isEmpty());
      check(observed(*fresh, prefix), after, "after the same step", !answers_again(action.kind));
    }
    if (action.kind == Kind::add_panel || action.kind == Kind::remove_panel) {
      states_.clear();
    }
    remember(after);
  }

  /// Undoes everything, and does it again.
  void travel_through() {
    document_->handle().end();
    const int done = document_->undoStack().index();
    while (document_->undoStack().canUndo()) {
      travel(true);
    }
    while (document_->undoStack().index() < done) {
      travel(false);
    }
  }

 private:
  using Step = std::function<void(Document&, std::size_t skip)>;

  static void check(const DocumentState& fresh, const DocumentState& lived, const char* when,
                    bool with_positions = true) {
    RC_LOG() << when << '\n';
    RC_ASSERT(fresh.object == lived.object);
    RC_ASSERT(fresh.moves == lived.moves);
    RC_ASSERT(fresh.facts == lived.facts);
    RC_ASSERT(fresh.algorithms == lived.algorithms);
    RC_ASSERT(!with_positions || difference(lived, fresh, false) == std::string());
  }

  /// Returns a document that was made from the session of this one, as the next start of the program makes it.
  std::unique_ptr<Document> renewed(Prefix& prefix) {
    std::ostringstream text;
    write_session(text, SessionDraft(*document_, "{}").finished({}));
    const auto session = std::make_shared<const Session>(parse_session(text.str(), "life.chainmail"));
    auto fresh = std::make_unique<Document>(session->mesh, QStringLiteral("second"));
    while (fresh->panels() < document_->panels()) {
      fresh->addPanel();
    }
    edits::restore(*fresh, session, document_->files().session(), QStringLiteral("open"));
    fresh->selection().set(document_->selection().elements());
    fresh->undoStack().clear();
    prefix = session->moves.empty() ? Prefix(fresh->moves().history()) : Prefix();
    return fresh;
  }

  /// Returns what the document said. With `frames`, that includes refusals by the solvers, which come with frames.
  static QStringList carried_out(Document& document, const Step& step, std::size_t skip, bool frames = true) {
    QStringList said;
    QObject context;
    const auto listen = [&](const QString& sentence) { said << sentence; };
    QObject::connect(&document, &Document::refused, &context, listen);
    QObject::connect(&document, &Document::noticed, &context, listen);
    QObject::connect(&document, &Document::unpinned, &context, [&](int panel) { said << QString::number(panel); });
    step(document, skip);
    RC_ASSERT(has_done_all(document, frames));
    return said;
  }

  void travel(bool back) {
    QUndoStack& stack = document_->undoStack();
    back ? document_->undo() : document_->redo();
    const DocumentState now = observed(*document_);
    if (const auto known = states_.find(stack.command(stack.index() - 1)); known != states_.end()) {
      RC_LOG() << (back ? "undone" : "done again") << '\n';
      RC_ASSERT(now.object == known->second.object);
      RC_ASSERT(now.done == known->second.done);
      RC_ASSERT(now.facts.filter(QStringLiteral("files")) == known->second.facts.filter(QStringLiteral("files")));
      RC_ASSERT(difference(now, known->second, true) == std::string());
    }
  }

  /// A new step deletes those that were undone.
  void forget_undone() {
    const QUndoStack& stack = document_->undoStack();
    for (int i = stack.index(); i < stack.count(); ++i) {
      states_.erase(stack.command(i));
    }
  }

  void remember(const DocumentState& state) {
    const QUndoStack& stack = document_->undoStack();
    std::map<const QUndoCommand*, DocumentState> kept;
    for (int i = 0; i < stack.index(); ++i) {
      const QUndoCommand* command = i == 0 ? nullptr : stack.command(i - 1);
      if (states_.contains(command) && (command != nullptr || stack.count() < stack.undoLimit())) {
        kept[command] = states_[command];
      }
    }
    const QUndoCommand* present = stack.command(stack.index() - 1);
    if (document_->handle().held().empty()) {
      kept[present] = state;
    } else if (states_.contains(present)) {
      kept[present] = states_[present];  // undo ends the drag, and leads to what was there before it
    }
    states_ = std::move(kept);
  }

  /// What an action asks for, by its own numbers.
  class Asked {
   public:
    Asked(const Life& life, const Action& action);
    /// Call this after the action.
    void check() const;

   private:
    void check_panel(int panel) const;

    Document& document_;
    Action action_;
    Motion motion_;
    std::vector<PanelFacts> before_;  // one for each panel
  };

  Step step_of(const Action& action) const;
  Motion motion_of(const Action& action) const;
  Step drag_of(const Action& action) const;
  // Each returns the step of an action of its kinds, and none for others.
  Step handle_step(const Action& action) const;
  Step object_step(const Action& action) const;
  Step softness_step(const Action& action) const;
  Step setting_step(const Action& action) const;
  Step panel_step(const Action& action) const;
  Step move_step(const Action& action) const;

  std::unique_ptr<Document> document_;
  std::map<const QUndoCommand*, DocumentState> states_;  // by the last step that was done; null: before the first one
};

Motion Life::motion_of(const Action& action) const {
  const Mesh& mesh = *document_->mesh();
  const ElementId count = mesh.element_count(), element = action.which % count;
  Motion motion{{element}};
  if (action.kind == Kind::drag_many) {
    motion.elements.push_back((element + 1 + action.how % 3) % count);
  }
  motion.by[mesh.axes[0]] = action.x / 8.0;
  if (mesh.space_dimension > 1) {
    motion.by[mesh.axes[1]] = action.y / 8.0;
  }
  const bool turns = motion.elements.size() > 1 && mesh.space_dimension > 1 && action.how % 3 == 0;
  motion.degrees = turns ? 15 : 0;
  return motion;
}

Life::Step Life::drag_of(const Action& action) const {
  const Motion motion = motion_of(action);
  const Point by = motion.by;
  const Rotation rotation = motion.degrees != 0 ? Rotation{Point(0, 0, 1), motion.degrees} : Rotation();
  const Kind kind = action.kind;
  return [=](Document& document, std::size_t) {
    document.handle().grab(motion.elements);
    document.handle().dragBy(by / 2);
    RC_ASSERT(has_done_all(document));
    document.handle().dragBy(by, rotation);
    RC_ASSERT(has_done_all(document));
    if (kind == Kind::cancel_drag) {
      document.handle().cancel();
    } else if (kind != Kind::drag_and_keep) {
      document.handle().release();
    }
  };
}

Life::Step Life::handle_step(const Action& action) const {
  const ElementId element = action.which % document_->mesh()->element_count();
  switch (action.kind) {
    case Kind::drag:
    case Kind::drag_and_keep:
    case Kind::cancel_drag:
    case Kind::drag_many:
      return drag_of(action);
    case Kind::select:
      return [=](Document& d, std::size_t) { d.selection().set({element}); };
    default:
      return {};
  }
}

void cut(Document& document, std::vector<LinkId> links) {
  std::ranges::sort(links);
  links.erase(std::unique(links.begin(), links.end()), links.end());
  std::erase_if(links, [&document](LinkId one) { return document.cuts().is_cut(one); });
  edits::cut(document, links);
}

/// Splits a triangle into three, or divides the cells of a volume by a plane through an element and z.
void split(Document& document, std::uint32_t which) {
  const Mesh& mesh = *document.mesh();
  if (mesh.has_cells()) {
    std::vector<ViewPlace> places;
    for (ElementId e = 0; e < mesh.element_count(); ++e) {
      places.push_back({mesh.rest_position(e).head<2>()});
    }
    const Eigen::Vector2d middle = places[which % mesh.element_count()].at, along(std::cos(which), std::sin(which));
    const double length = 100 * mesh.mean_link_length;
    const std::vector<Eigen::Vector2d> stroke{middle - length * along, middle + 0.3 * along};
    SplitEdit edit = split_along(mesh, places, stroke);
    if (!edit.empty()) {
      edits::split(document, make_split(document.mesh(), std::move(edit)));
    }
  } else if (can_split(mesh)) {
    const std::uint32_t triangle = which % std::uint32_t(mesh.triangles.size());
    const auto [a, b, c] = mesh.triangles[triangle];
    const ElementId p = mesh.element_count();
    std::array corners{a, b, c};
    std::ranges::sort(corners);
    edits::split(
        document,
        make_split(document.mesh(), {{{corners, {0.25, 0.5}}}, {triangle}, {{a, b, p}, {b, c, p}, {c, a, p}}, {}, {}}));
  }
}

Life::Step Life::object_step(const Action& action) const {
  const Mesh& mesh = *document_->mesh();
  const ElementId element = action.which % mesh.element_count();
  switch (action.kind) {
    case Kind::cut:
      return
          [one = action.which % mesh.link_count(), other = action.how % mesh.link_count()](Document& d, std::size_t) {
            cut(d, {one, other});
          };
    case Kind::split:
      return [=](Document& d, std::size_t) { split(d, action.which); };
    case Kind::pin:
    case Kind::unpin:
      return [=, pin = action.kind == Kind::pin](Document& d, std::size_t) {
        if (isPinned(d, element) != pin) {
          edits::setPinned(d, {element}, pin);
        }
      };
    case Kind::replace_mesh:
      return
          [other = meshes()[action.which % meshes().size()], rework = action.how % 2 == 0](Document& d, std::size_t) {
            rework ? edits::reworkMesh(d, other, d.name(), QStringLiteral("repair"))
                   : edits::replaceMesh(d, other, QStringLiteral("other"), QStringLiteral("build"));
          };
    case Kind::reset:
      return [](Document& d, std::size_t) { edits::resetObject(d); };
    default:
      return {};
  }
}

Life::Step Life::softness_step(const Action& action) const {
  const LinkId count = document_->mesh()->link_count(), link = action.which % count, other = action.how % count;
  const LinkSoftness soft{1 - action.which % 5 / 8.0, 1 + action.how % 8 / 4.0, action.which % 3 / 10.0,
                          action.how % 2 / 2.0,       1.0 + action.how % 3,     0};
  switch (action.kind) {
    case Kind::soften:
      return [=](Document& d, std::size_t) { edits::setSoftness(d, soft, QStringLiteral("softness")); };
    case Kind::soften_links:
      return [=, own = action.how % 4 != 0](Document& d, std::size_t) {
        edits::setSoftnessOf(d, {std::min(link, other), std::max(link, other)},
                             own ? std::optional(soft) : std::nullopt);
      };
    case Kind::reset_softness:
      return [](Document& d, std::size_t) { edits::resetSoftness(d); };
    case Kind::change_energy:
      return [=](Document& d, std::size_t) { edits::setEnergy(d, EnergyKind(action.which % 3)); };
    case Kind::turn_regions:
      return [=](Document& d, std::size_t) {
        edits::setRegionAxes(d, action.which % 2 == 0 ? AxesKind::object : AxesKind::axes);
      };
    default:
      return {};
  }
}

/// Lets idle time relax the object for a moment. This is one step: if undo left relaxation on, the number of sweeps
/// after later steps would differ.
void relax(Document& document) {
  constexpr int patience = 1000;  // ms
  auto relaxation = document.relaxation();
  document.undoStack().beginMacro(QStringLiteral("relax"));
  relaxation.on = true;
  edits::setRelaxation(document, relaxation);
  const auto has_relaxed = [&document] {
    return document.solvers().settled() ||
           (document.solvers().frame(0) != nullptr && document.solvers().frame(0)->statistics.sweeps > 0);
  };
  (void)QTest::qWaitFor(has_relaxed, patience);
  relaxation.on = false;
  edits::setRelaxation(document, relaxation);
  document.undoStack().endMacro();
}

Life::Step Life::setting_step(const Action& action) const {
  switch (action.kind) {
    case Kind::set_relaxation:
      return [=](Document& d, std::size_t) {
        edits::setRelaxation(d, {false, 0.25 + action.how % 3 / 4.0, relaxation_schemes[action.which % 3].scheme});
      };
    case Kind::relax:
      return [](Document& d, std::size_t) { relax(d); };
    case Kind::change_material:
      return [=](Document& d, std::size_t) {
        edits::setElastic(d, {{1.0 + action.which, 0.25}, {3, 3, 3}}, QStringLiteral("material"));
      };
    default:
      return {};
  }
}

Life::Step Life::panel_step(const Action& action) const {
  switch (action.kind) {
    case Kind::change_algorithm:
      return [panel = int(action.how) % document_->panels(),
              algorithm = algorithms()[action.which % algorithms().size()].algorithm](Document& d, std::size_t) {
        edits::setAlgorithm(d, panel, algorithm);
      };
    case Kind::add_panel:
      return [](Document& d, std::size_t) { d.addPanel(); };
    case Kind::remove_panel:
      return [](Document& d, std::size_t) { d.removePanel(); };
    default:
      return {};
  }
}

Life::Step Life::move_step(const Action& action) const {
  switch (action.kind) {
    case Kind::load_moves:
      return [](Document& d, std::size_t skip) {
        auto moves = d.moves().history().commands();
        moves.erase(moves.begin(), moves.begin() + std::ptrdiff_t(skip));
        d.moves().load(std::make_shared<const std::vector<Command>>(std::move(moves)), QStringLiteral("load"));
      };
    case Kind::go_to:
      return [at = action.which % (document_->moves().history().length() + 1)](Document& d, std::size_t skip) {
        d.moves().goTo(at + skip);
      };
    case Kind::reload:
      return [session = std::make_shared<const Session>(SessionDraft(*document_, "{}").finished({}))](Document& d,
                                                                                                      std::size_t) {
        edits::restore(d, session, QStringLiteral("again.chainmail"), QStringLiteral("open"));
      };
    default:
      return {};
  }
}

Life::Step Life::step_of(const Action& action) const {
  for (const auto kinds : {&Life::handle_step, &Life::object_step, &Life::softness_step, &Life::setting_step,
                           &Life::panel_step, &Life::move_step}) {
    if (Step step = (this->*kinds)(action)) {
      return step;
    }
  }
  RC_FAIL("a kind without a step");
}

Life::Asked::Asked(const Life& life, const Action& action)
    : document_(*life.document_), action_(action), motion_(life.motion_of(action)) {
  for (int panel = 0; panel < document_.panels(); ++panel) {
    before_.push_back(facts_of(document_, panel));
  }
}

void Life::Asked::check() const {
  const int before = int(before_.size()), step = action_.kind == Kind::add_panel      ? 1
                                                 : action_.kind == Kind::remove_panel ? -1
                                                                                      : 0;
  if (action_.kind != Kind::reload) {
    RC_ASSERT(document_.panels() == std::clamp(before + step, Document::minPanels, Document::maxPanels));
  }
  if (action_.kind == Kind::select) {
    RC_ASSERT(document_.selection().elements() ==
              std::vector<ElementId>{action_.which % document_.mesh()->element_count()});
  }
  if (action_.kind == Kind::replace_mesh) {
    RC_ASSERT(document_.mesh() == meshes()[action_.which % meshes().size()]);
  }
  if (action_.kind == Kind::pin || action_.kind == Kind::unpin) {
    RC_ASSERT(isPinned(document_, action_.which % document_.mesh()->element_count()) == (action_.kind == Kind::pin));
  }
  for (int panel = 0; panel < std::min(before, document_.panels()); ++panel) {
    check_panel(panel);
  }
}

void Life::Asked::check_panel(int panel) const {
  const PanelFacts &was = before_[std::size_t(panel)], now = facts_of(document_, panel);
  const ObjectFacts &before = was.object, &after = now.object;
  const bool drags =
      action_.kind == Kind::drag || action_.kind == Kind::drag_many || action_.kind == Kind::drag_and_keep;
  // Exact may stop on the way, and says so only while it holds the handle. A new panel takes over positions that its
  // links may not allow; the first pass mends them, also between the elements of the handle.
  const bool may_stop = action_.kind == Kind::drag_and_keep
                            ? now.statistics.last_pass.stopped
                            : info(document_.algorithm(panel)).holds_links &&
                                  (!before.pins.empty() || motion_.degrees != 0 ||
                                   (was.statistics.passes == 0 && before.largest_excess({}) > 0));
  // A drag is two passes, unless it is refused.
  const bool has_answer = drags && now.statistics.passes == was.statistics.passes + 2 && now.statistics.remark.empty();
  RC_LOG() << "panel " << panel << ", " << info(document_.algorithm(panel)).name << ", " << action_ << '\n';
  RC_ASSERT(flaw_of(document_, panel, after, has_answer ? &motion_ : nullptr) == std::string());
  if (has_answer && !may_stop) {  // RC_ASSERT computes both sides of an "or"
    RC_ASSERT(has_arrived(motion_, before, after));
  }
  if (action_.kind == Kind::cut) {
    std::set<Ends> cuts = before.cuts;
    for (const std::uint32_t link : {action_.which, action_.how}) {
      cuts.insert(before.mesh->links[link % before.mesh->link_count()]);
    }
    RC_ASSERT(after.cuts == cuts);
  }
  if (action_.kind == Kind::split && can_split(*before.mesh) && !before.mesh->has_cells()) {
    RC_ASSERT(after.mesh->element_count() == before.mesh->element_count() + 1);
    RC_ASSERT(after.mesh->link_count() == before.mesh->link_count() + 3);
  }
  const bool only_looks = action_.kind == Kind::cut || action_.kind == Kind::pin || action_.kind == Kind::select ||
                          action_.kind == Kind::set_relaxation || action_.kind == Kind::unpin;
  for (ElementId e = 0; only_looks && e < before.positions.size(); ++e) {
    RC_ASSERT(after.positions[e] == before.positions[e]);
  }
}

/// Returns the kinds in an order in which each comes after each, also after itself.
std::vector<Kind> each_after_each() {
  std::vector<Kind> order;
  for (int i = 0; i < int(Kind::count); ++i) {
    order.push_back(Kind(i));
    for (int k = i + 1; k < int(Kind::count); ++k) {
      order.insert(order.end(), {Kind(i), Kind(k)});
    }
  }
  order.push_back(order.front());
  return order;
}

}  // namespace

class DocumentLifeTest : public QObject {
  Q_OBJECT

 private slots:
  void it_is_always_what_its_session_holds();
  void after_any_two_steps_it_is_what_they_say();
};

void DocumentLifeTest::it_is_always_what_its_session_holds() {
  const auto holds = [] {
    Life life;
    for (const Action& action : *rc::gen::container<std::vector<Action>>(any_action())) {
      life.act(action);
    }
    life.look();
  };
  constexpr int lives = 10;  // twice, of 50 steps on average
  QVERIFY(check_property("a document is always what its session holds", holds, lives));
}

void DocumentLifeTest::after_any_two_steps_it_is_what_they_say() {
  const auto order = each_after_each();
  QCOMPARE(order.size(), std::size_t(Kind::count) * std::size_t(Kind::count) + 1);
  for (const std::uint32_t object : {0U, 3U}) {  // a surface and a solid
    QVERIFY(check_once("every step may come after every other", [&] {
      Life life(meshes()[object]);
      for (std::uint32_t i = 0; i < order.size(); ++i) {
        const std::uint32_t which = order[i] == Kind::replace_mesh ? object : 7 * i % 1000;
        life.act({order[i], which, 11 * i % 1000, int(5 * i % 25) - 12, int(9 * i % 25) - 12}, false);
      }
      life.travel_through();
    }));
  }
}

CHAINMAIL_TEST(DocumentLifeTest)

}  // namespace chainmail::test_document_life

#include "document_life.moc"
