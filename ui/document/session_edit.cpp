#include "document/session_edit.h"

#include <algorithm>
#include <exception>
#include <new>

namespace chainmail {

SessionEdit::SessionEdit(Document& document, const std::shared_ptr<const Session>& session, const QString& file,
                         const QString& text)
    : Edit(document, text, document.newState()),
      other_{session->mesh,
             QString::fromStdString(session->name),
             file,
             Cuts(session->mesh),
             Parts(session->mesh),
             session->pins,
             session->softness,
             session->relaxation,
             session->elastic,
             {document.algorithms_.begin(), document.algorithms_.begin() + document.panels()}},
      session_(session) {
  other_.parts.cut(other_.cuts, session->cuts);
  for (std::size_t panel = 0; panel < other_.algorithms.size(); ++panel) {
    Algorithm& algorithm = other_.algorithms[panel];
    algorithm = panel < session->panels.size()    ? session->panels[panel].algorithm
                : fits(algorithm, *session->mesh) ? algorithm
                                                  : Algorithm::natural_queue;
  }
}

/// Of panels that were there then and still are.
int SessionEdit::count() const { return std::min(document_.panels(), int(other_.algorithms.size())); }

void SessionEdit::carryOut() {
  document_.post(commands::ReplaceMesh{other_.mesh});
  document_.post(other_.relaxation);
  document_.post(commands::SetElastic{other_.elastic});
  const std::vector<Command> object{commands::SetSoftness{other_.softness}, commands::Cut{session_->cuts},
                                    commands::Pin{session_->pins}};
  for (const Command& command : object) {
    document_.log_->replay(command);
  }
  takeMoves(object);
  for (int panel = 0; panel < count(); ++panel) {
    document_.log_->post_to(*document_.solvers_[panel], commands::SetAlgorithm{other_.algorithms[panel]});
    place(panel);  // last: relaxation sleeps then, and leaves everything where it stood
  }
  session_.reset();
}

/// Where nothing is told of what was done, it begins with the object as it is, at rest.
void SessionEdit::takeMoves(const std::vector<Command>& object) {
  const bool told = !session_->moves.empty();
  Tape& tape = document_.log_->tape();
  tape.load(told ? session_->moves : object);
  tape.go_to(told ? session_->moves_done : object.size());
}

void SessionEdit::place(int panel) {
  const auto& panels = session_->panels;
  const auto& from = std::size_t(panel) < panels.size() ? panels[panel] : panels.front();
  // It shares the session, and does not copy its numbers.
  document_.log_->post_to(*document_.solvers_[panel],
                          commands::SetPositions{std::shared_ptr<const Snapshot>(session_, &from.placement)});
}

/// What solvers do not keep with the object. Of the algorithms, those that hold positions as the kept ones are, and
/// work on the mesh that is still there.
void SessionEdit::prepare(bool /*done*/) {
  document_.post(other_.relaxation);
  document_.post(commands::SetElastic{other_.elastic});
  for (int panel = 0; panel < count(); ++panel) {
    const bool exact = other_.algorithms[panel] == Algorithm::exact;
    document_.log_->post_to(*document_.solvers_[panel],
                            commands::SetAlgorithm{exact ? Algorithm::exact : Algorithm::natural_queue});
  }
}

void SessionEdit::show(bool /*done*/) {
  document_.letGoOfElements();
  std::swap(other_.mesh, document_.mesh_);
  std::swap(other_.name, document_.name_);
  std::swap(other_.file, document_.sessionFile_);
  std::swap(other_.cuts, document_.cuts_);
  std::swap(other_.parts, document_.parts_);
  std::swap(other_.pins, document_.pins_);
  std::swap(other_.softness, document_.softness_);
  std::swap(other_.relaxation, document_.relaxation_);
  std::swap(other_.elastic, document_.elastic_);
  for (int panel = 0; panel < count(); ++panel) {
    std::swap(other_.algorithms[panel], document_.algorithms_[panel]);
    document_.log_->post_to(*document_.solvers_[panel], commands::SetAlgorithm{document_.algorithms_[panel]});
  }
  tell();
}

void SessionEdit::tell() const {
  emit document_.meshChanged();
  emit document_.softnessChanged();
  emit document_.relaxationChanged();
  emit document_.elasticChanged();
  for (int panel = 0; panel < count(); ++panel) {
    emit document_.algorithmChanged(panel);
  }
  emit document_.sessionFileChanged();
}

// What a document has to do with sessions.

void Document::restore(const std::shared_ptr<const Session>& session, const QString& file, const QString& text) {
  push(new SessionEdit(*this, session, file, text));
}

void Document::ask(int panel, SolverThread::Question question) {
  log_->flush();
  solvers_[panel]->ask(std::move(question));
}

std::future<Snapshot> Document::placement(int panel) {
  const auto promise = std::make_shared<std::promise<Snapshot>>();
  ask(panel, [promise](const Simulation& simulation) {
    try {
      promise->set_value(simulation.snapshot());
    } catch (const std::bad_alloc&) {
      promise->set_exception(std::current_exception());
    }
  });
  return promise->get_future();
}

void Document::setSessionFile(const QString& file) {
  if (file != sessionFile_) {
    sessionFile_ = file;
    emit sessionFileChanged();
  }
}

}  // namespace chainmail
