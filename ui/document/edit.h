#pragma once

#include <QUndoCommand>
#include <optional>

#include "document/change.h"

namespace chainmail {

class Document;

/// A change on the undo stack. The solvers save the state of the object before the step. Undo and redo exchange the
/// saved state with the current one. So every position is restored exactly (bit for bit), also after drags and
/// relaxation.
class Edit : public QUndoCommand {
 public:
  /// `state` identifies the saved state; none if the step will be merged into the previous one. `kept` is true if the
  /// solvers have saved it already.
  Edit(Document& document, Change change, std::optional<commands::StateId> state, bool kept = false);
  ~Edit() override;

  void redo() override;
  void undo() override;
  int id() const override { return change_.gesture == 0 ? -1 : change_.gesture; }
  bool mergeWith(const QUndoCommand* later) override;

 private:
  void exchange(const Contents& from, const Contents& to, bool done);
  void show(const Contents& from, const Contents& to, bool done);

  Document& document_;
  Contents before_;
  Change change_;
  std::optional<commands::StateId> state_;
  bool kept_;
  bool done_ = false;  // true after the first redo()
};

}  // namespace chainmail
