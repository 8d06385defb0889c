#include "document/change.h"

#include <utility>

#include "common/application.h"
#include "document/change_executor.h"

namespace chainmail {

void DocumentObject::sleep() {
  if (mesh && mesh->split) {
    sleeping_ = Sleeping{MeshSource(mesh), cuts.links()};
    mesh.reset();
    cuts = {};
    parts = {};
  }
}

void DocumentObject::wake() {
  if (sleeping_) {
    mesh = sleeping_->mesh.mesh();
    cuts = Cuts(mesh);
    parts = Parts(mesh);
    parts.cut(cuts, sleeping_->cuts);
    sleeping_.reset();
  }
}

void Contents::goTo(const ObjectState& state) {
  auto other = std::make_shared<DocumentObject>(state, object->name);
  other->unsplit = object->unsplit;
  other->before = object->before;
  object = std::move(other);
  softness = state.softness;
}

Edit::Edit(ChangeExecutor& executor, Change change, std::optional<commands::StateId> state, bool kept)
    : QUndoCommand(change.text),
      executor_(executor),
      before_(executor.contents()),
      change_(std::move(change)),
      state_(state),
      kept_(kept) {}

Edit::~Edit() {
  try {
    if (state_) {
      executor_.post(commands::DropState{*state_});
    }
  } catch (...) {
    // No memory for the command: the solvers keep a state that nobody needs.
  }
}

void Edit::redo() {
  if (done_) {
    exchange(before_, change_.after, true);
    return;
  }
  done_ = true;
  if (state_ && !kept_) {
    executor_.post(commands::KeepState{*state_});
  }
  try {
    executor_.carryOut(change_, before_);
  } catch (...) {  // no memory for a command: the solvers return to the state before
    if (state_) {
      executor_.post(commands::RestoreState{*state_});
    }
    throw;
  }
  change_.carryOut = {};
  show(before_, change_.after, true);
}

void Edit::undo() { exchange(change_.after, before_, false); }

bool Edit::mergeWith(const QUndoCommand* later) {
  const auto* other = dynamic_cast<const Edit*>(later);
  if (other == nullptr || other->text() != text()) {
    return false;
  }
  change_.after = other->change_.after;
  return true;
}

void Edit::exchange(const Contents& from, const Contents& to, bool done) {
  to.object->wake();
  const commands::StateId now = executor_.newState();
  executor_.post(commands::KeepState{now});
  executor_.postSettings(
      from, to,
      from.object != to.object ? ChangeExecutor::SolversHave::anotherObject : ChangeExecutor::SolversHave::thisObject);
  executor_.post(commands::RestoreState{*state_});
  executor_.post(commands::DropState{*state_});
  state_ = now;
  show(from, to, done);
}

/// The step must reach the stack, or leave it, whatever fails here.
void Edit::show(const Contents& from, const Contents& to, bool done) {
  Application::guarded([&] { executor_.show(change_, from, to, done); });
}

}  // namespace chainmail
