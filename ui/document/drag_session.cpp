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
    document_.forgetRefusals();  // each attempt is answered
    // The solvers refuse it, and nothing is recorded.
    document_.solvers().log().replay(commands::Grab{std::move(elements)});
    return;
  }
  begin(free, free.size() == 1 ? QStringLiteral("drag of element %1").arg(free.front())
                               : counted(QStringLiteral("drag of"), free.size(), QStringLiteral("element")));
  document_.post(commands::Grab{std::move(free)});
}

void DragSession::begin(std::vector<ElementId> elements, const QString& text) {
  document_.moves().endFilm();
  document_.forgetRefusals();
  handle_ = Handle{std::move(elements), text, document_.newState()};
  document_.post(commands::KeepState{handle_->before});
}

void DragSession::drag(const Point& target) { post({target}); }

void DragSession::dragBy(const Point& by, const Rotation& rotation) { post({by, rotation, true}); }

/// A drag of nothing, for example after all elements of a grab were pinned, must not be recorded: no session with it
/// could be opened.
void DragSession::post(const commands::Drag& drag) {
  if (handle_) {
    handle_->moved = true;
    document_.post(drag);
  }
}

void DragSession::release() {
  if (!handle_ && document_.moves().history().holds()) {  // a session that was saved while dragging
    document_.post(commands::Release{});
  }
  end();
}

void DragSession::cancel() {
  const auto handle = std::exchange(handle_, {});
  if (!handle) {
    return;
  }
  document_.post(commands::Release{});
  if (handle->moved) {
    document_.post(commands::RestoreState{handle->before});
  }
  document_.post(commands::DropState{handle->before});
}

void DragSession::end() {
  if (const auto handle = std::exchange(handle_, {})) {
    document_.post(commands::Release{});
    if (handle->moved) {
      document_.addDone(document_.change(handle->text), handle->before);
    } else {
      document_.post(commands::DropState{handle->before});
    }
  }
}

}  // namespace chainmail
