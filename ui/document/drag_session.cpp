#include "document/drag_session.h"

#include <algorithm>
#include <iterator>
#include <utility>

#include "common/text.h"
#include "document/document.h"

namespace chainmail {

void DragSession::grab(std::vector<ElementId> elements) {
  end();
  std::ranges::sort(elements);
  std::vector<ElementId> free;
  std::ranges::set_difference(elements, document_.pins(), std::back_inserter(free));
  if (free.empty()) {
    executor_.forgetRefusals();  // each attempt is answered
    // The solvers refuse it, and nothing is recorded.
    document_.solvers().log().replay(commands::Grab{std::move(elements)});
    return;
  }
  begin(free, free.size() == 1 ? QStringLiteral("drag of element %1").arg(free.front())
                               : counted(QStringLiteral("drag of"), free.size(), QStringLiteral("element")));
  executor_.post(commands::Grab{std::move(free)});
}

void DragSession::begin(std::vector<ElementId> elements, const QString& text) {
  document_.moves().endFilm();
  executor_.forgetRefusals();
  handle_ = Handle{std::move(elements), text, executor_.newState()};
  executor_.post(commands::KeepState{handle_->before});
}

void DragSession::drag(const commands::Drag& drag) {
  if (handle_) {
    handle_->moved = true;
    document_.solvers().log().post(drag);
  }
}

void DragSession::release() {
  if (!handle_ && document_.moves().history().holds()) {  // a session that was saved while dragging
    executor_.post(commands::Release{});
  }
  end();
}

void DragSession::cancel() {
  const auto handle = std::exchange(handle_, {});
  if (!handle) {
    return;
  }
  executor_.post(commands::Release{});
  if (handle->moved) {
    executor_.post(commands::RestoreState{handle->before});
  }
  executor_.post(commands::DropState{handle->before});
}

void DragSession::end() {
  if (const auto handle = std::exchange(handle_, {})) {
    executor_.post(commands::Release{});
    if (handle->moved) {
      auto edit = std::make_unique<Edit>(executor_, document_.change(handle->text), handle->before, true);
      document_.undoStack().push(edit.release());
    } else {
      executor_.post(commands::DropState{handle->before});
    }
  }
}

}  // namespace chainmail
