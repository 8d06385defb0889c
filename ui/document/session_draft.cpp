#include "document/session_draft.h"

#include <algorithm>

namespace chainmail {

SessionDraft::SessionDraft(Document& document, std::string layout) {
  document.moves().endFilm();
  for (auto& snapshot : document.solvers().snapshots()) {  // first: this records what relaxation has done
    snapshots_.push_back(snapshot.share());
  }
  static_cast<ObjectState&>(session_) = document.object();
  session_.name = document.name().toStdString();
  session_.relaxation = document.relaxation();
  session_.elastic = document.elastic();
  session_.moves = document.moves().history().commands();
  session_.moves_done = document.moves().history().position();
  takeLesson(document);
  session_.ui = std::move(layout);
  for (int panel = 0; panel < document.panels(); ++panel) {
    session_.panels.push_back({document.algorithm(panel), Precision::single_precision, {}});
  }
}

/// A lesson keeps its captions. They belong to its own moves, which the user's moves may have replaced meanwhile. If
/// the user has also split the object, the lesson's moves do not lead to it: the session is then the user's alone.
void SessionDraft::takeLesson(const Document& document) {
  const auto& lesson = document.lesson().session;
  if (!lesson) {
    return;
  }
  if (!document.moves().recordsLesson()) {
    const std::size_t done = std::min(session_.moves_done, lesson->moves.size());
    if (last_mesh(first_mesh(*lesson), std::span(lesson->moves).first(done)) != session_.mesh) {
      return;
    }
    session_.moves = lesson->moves;
    session_.moves_done = done;
  }
  session_.lesson = *document.lesson().captions;
}

Session SessionDraft::finished(const Progress& progress) const {
  constexpr std::chrono::milliseconds patience(10);  // between two checks for cancellation
  Session result = session_;
  for (std::size_t panel = 0; panel < snapshots_.size(); ++panel) {
    while (snapshots_[panel].wait_for(patience) != std::future_status::ready) {
      progress.report(0);
    }
    try {
      result.panels[panel].positions = snapshots_[panel].get();
    } catch (const std::future_error&) {
      if (panel == 0) {
        throw Cancelled();  // a session without panels must not overwrite a good one
      }
      result.panels.resize(panel);  // this panel and those after it were removed before their solvers answered
      break;
    }
  }
  return result;
}

}  // namespace chainmail
