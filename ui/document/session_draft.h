#pragma once

#include <future>
#include <vector>

#include "document/document.h"
#include "files/session/session.h"

namespace chainmail {

/// A session that is being saved. The constructor copies pointers from the document; the solvers deliver the positions
/// later, after all commands posted before. Copies of the draft share these positions.
class SessionDraft {
 public:
  /// `layout` is the state of the window as text.
  SessionDraft(Document& document, std::string layout);

  const MeshPointer& mesh() const { return session_.mesh; }
  /// Returns the complete session. Waits for the solvers, so do not call it in the GUI thread. Throws Cancelled.
  Session finished(const Progress& progress) const;

 private:
  void takeLesson(const Document& document);

  Session session_;
  std::vector<std::shared_future<Snapshot>> snapshots_;
};

}  // namespace chainmail
