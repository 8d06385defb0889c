#pragma once

#include <future>
#include <vector>

#include "document/document.h"
#include "files/session/session.h"

namespace chainmail {

/// A session in the making. The window gives at once what it has, at the cost of some copies of pointers; where the
/// elements stand the solvers tell, each when it has done what was asked of it before. Copies share that.
class SessionDraft {
 public:
  /// `look` is the window's part.
  SessionDraft(Document& document, std::string look);

  const MeshPointer& mesh() const { return session_.mesh; }
  /// Waits for the solvers: not to be called by the window's thread. Throws Cancelled.
  Session finished(const Progress& progress) const;

 private:
  Session session_;
  std::vector<std::shared_future<Snapshot>> placements_;
};

}  // namespace chainmail
