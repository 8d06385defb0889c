#include "document/change_executor.h"

#include <algorithm>
#include <iterator>
#include <utility>

#include "common/application.h"
#include "common/text.h"
#include "document/document.h"
#include "document/element_facts.h"

namespace chainmail {
namespace {

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

/// Posts the commands of a change when it is done for the first time. Later, undo and redo restore saved states.
void ChangeExecutor::carryOut(const Change& change, const Contents& before) {
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
void ChangeExecutor::postSettings(const Contents& from, const Contents& to, SolversHave have) {
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
std::vector<int> ChangeExecutor::panelsToSwitch(const Contents& from, const Contents& to) const {
  std::vector<int> result;
  for (int panel = 0; panel < std::min({from.panels, to.panels, document_.panels()}); ++panel) {
    const Algorithm before = from.algorithms[std::size_t(panel)], after = to.algorithms[std::size_t(panel)];
    if ((from.object != to.object || before != after) && document_.algorithm(panel) != after) {
      result.push_back(panel);
    }
  }
  return result;
}

/// Sets the contents to the values of a step that was done or undone, and emits the signals of values that differ.
void ChangeExecutor::show(Change& change, const Contents& from, const Contents& to, bool done) {
  const std::vector<int> panels = panelsToSwitch(from, to);
  const bool isOther = from.object != to.object;
  to.object->wake();
  if (isOther) {  // first, because listeners still read elements of the old mesh
    document_.highlight().set({});
    document_.selection().set({});
  }
  replaceValues(contents_, from, to, panels);
  for (const int panel : isOther ? panels : std::vector<int>()) {
    postAlgorithm(panel, document_.algorithm(panel));
  }
  if (change.sessionFile) {
    document_.files().exchangeSession(*change.sessionFile);
  }
  emitSignals(document_, from, to, panels);
  showParts(change, done);
  if (isOther && done) {
    replaceUnfitAlgorithms();
  }
  if (isOther) {
    from.object->sleep();
  }
}

/// Applies cuts and pins of a change to the contents, or reverts them if `done` is false.
void ChangeExecutor::showParts(const Change& change, bool done) {
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
    document_.highlight().set({});
    showMoves();
  }
}

void ChangeExecutor::showCuts(const std::vector<LinkId>& links, bool cut) {
  DocumentObject& object = *contents_.object;
  cut ? object.parts.cut(object.cuts, links) : object.parts.uncut(object.cuts, links);
  Application::guarded([&] { emit document_.cutsChanged(links, cut); });
  document_.selection().followCuts();
}

void ChangeExecutor::showPins(const std::vector<ElementId>& elements, bool pinned) {
  auto& pins = contents_.object->pins;
  pins = combined(pins, elements, pinned ? SelectionMode::add : SelectionMode::remove);
  Application::guarded([this] { emit document_.pinsChanged(); });
}

// Commands to the solvers, and their refusals.

void ChangeExecutor::post(const Command& command) {
  CommandLog& log = document_.solvers().log();
  // The recorded commands may end within a drag, as in a session that was saved while dragging.
  if (!document_.handle().isActive() && changesObject(command) && log.history().holds()) {
    log.post(commands::Release{});
  }
  log.post(command);
}

void ChangeExecutor::reportRefusal(int panel, const QString& sentence) {
  if (std::exchange(lastRefusal_[std::size_t(panel)], sentence) == sentence) {
    return;
  }
  if (lacksPins(document_, panel)) {
    emit document_.unpinned(panel);
  } else {
    emit document_.refused(sentence);
  }
}

void ChangeExecutor::postAlgorithm(int panel, Algorithm algorithm) {
  document_.moves().noteDeparture();
  document_.solvers().post(panel, commands::SetAlgorithm{algorithm});
}

/// Sets Natural Queue for panels whose algorithm does not work on the new mesh. Their solvers have already switched.
void ChangeExecutor::replaceUnfitAlgorithms() {
  QStringList where;
  QString from;
  for (int panel = 0; panel < document_.panels(); ++panel) {
    if (!fits(document_.algorithm(panel), *document_.mesh())) {
      from = chainmail::text(info(document_.algorithm(panel)).label);
      contents_.algorithms[std::size_t(panel)] = Algorithm::natural_queue;
      where << panelName(panel);
      Application::guarded([&] { emit document_.algorithmChanged(panel); });
    }
  }
  if (!where.isEmpty()) {
    emit document_.noticed(
        QStringLiteral("%1 does not work on this mesh: panel %2 now runs %3")
            .arg(from, where.join(QStringLiteral(" and ")), chainmail::text(info(Algorithm::natural_queue).label)));
  }
}

/// Sets cuts, pins and softness to their state at the current position in the recorded commands.
void ChangeExecutor::showMoves() {
  const ObjectState object = document_.moves().history().object();
  const std::vector<LinkId> cut = document_.cuts().links();
  if (cut != object.cuts) {
    showCuts(minus(cut, object.cuts), false);
    showCuts(minus(object.cuts, cut), true);
  }
  if (document_.pins() != object.pins) {
    contents_.object->pins = object.pins;
    emit document_.pinsChanged();
  }
  if (*document_.wholeSoftness() != *object.softness) {
    contents_.softness = object.softness;
    emit document_.softnessChanged();
  }
}

}  // namespace chainmail
