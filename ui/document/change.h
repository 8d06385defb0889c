#pragma once

#include <QString>
#include <QUndoCommand>
#include <array>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "mesh/parts.h"
#include "simulate/command.h"

namespace chainmail {

struct Lesson;
struct Session;
class ChangeExecutor;
class Document;

/// What the user sets: it stays when another object is opened.
struct Settings {
  static constexpr int minPanels = 2, maxPanels = 4;

  std::shared_ptr<const Softness> softness = std::make_shared<const Softness>();
  commands::SetRelaxation relaxation;
  ElasticOptions elastic;
  int panels = 0;
  std::array<Algorithm, maxPanels> algorithms{};  // one per panel; the last one of a removed panel

  std::span<const Algorithm> running() const { return std::span(algorithms).first(std::size_t(panels)); }
};

/// The object of a document without its positions. Cuts and pins change in place, so the time for a change depends on
/// the size of the change, not of the object.
struct DocumentObject {
  DocumentObject(const ObjectState& object, QString called)
      : mesh(object.mesh), unsplit(mesh), name(std::move(called)), cuts(mesh), parts(mesh), pins(object.pins) {
    parts.cut(cuts, object.cuts);
  }

  /// While undo or redo may return to the object, it keeps the splits that lead to its mesh, not the mesh.
  void sleep();
  void wake();

  MeshPointer mesh;     // null while it sleeps
  MeshPointer unsplit;  // the mesh from which splits made this one; the same mesh without splits
  QString name;
  Cuts cuts;
  Parts parts;                                  // connected parts of the object with these cuts
  std::vector<ElementId> pins;                  // ascending
  std::shared_ptr<const Settings> before = {};  // which a lesson replaces while it is open

 private:
  struct Sleeping {
    MeshSource mesh;
    std::vector<LinkId> cuts;
  };

  std::optional<Sleeping> sleeping_;
};

/// The lesson of an object, if it is one. Captions and step change alone, so that they are small.
struct OpenLesson {
  std::shared_ptr<const Session> session = {};  // the moves of the lesson; null: the object is no lesson
  std::shared_ptr<const Lesson> captions = {};  // null if the session is
  std::size_t step = 0;                         // index of the step to which the object was led last

  bool operator==(const OpenLesson&) const = default;
};

/// The values that undo restores, except the positions: each solver stores its own. Copying this copies pointers, not
/// elements or links.
struct Contents : Settings {
  std::shared_ptr<DocumentObject> object;
  OpenLesson lesson;

  /// Lets the object become the same before or after splits, with the softness that it has there.
  void goTo(const ObjectState& state);
};

/// One undo step, as data. Document::apply carries it out.
///
/// To write an edit, start with Document::change(text), replace the values in `after`, and apply it. The document sends
/// the solvers the commands for all values that differ, and emits their signals. Undo restores the previous values.
struct Change {
  QString text;                        // shown in the undo list, for example "cut 3 links"
  Contents after;                      // the values after the change
  int gesture = 0;                     // changes with the same gesture number (not 0) and text become one undo step
  std::vector<LinkId> cut;             // links that the change cuts
  std::vector<ElementId> pin, unpin;   // elements that the change pins and unpins, ascending
  std::optional<QString> sessionFile;  // new session file; undo and redo exchange it with the current one
  bool resets = false;                 // moves all elements to rest
  std::function<void()> carryOut;      // sends commands that do not follow from the values; called once
  SplitPointer split;                  // leads to the object and the softness after the change
  bool followsMoves = false;           // cuts, pins and softness are taken from the recorded commands
};

/// A change on the undo stack. The solvers save the state of the object before the step. Undo and redo exchange the
/// saved state with the current one. So every position is restored exactly (bit for bit), also after drags and
/// relaxation.
class Edit : public QUndoCommand {
 public:
  /// `state` identifies the saved state; none if the step will be merged into the previous one. `kept` is true if the
  /// solvers have saved it already.
  Edit(ChangeExecutor& executor, Change change, std::optional<commands::StateId> state, bool kept = false);
  ~Edit() override;

  void redo() override;
  void undo() override;
  int id() const override { return change_.gesture == 0 ? -1 : change_.gesture; }
  bool mergeWith(const QUndoCommand* later) override;

 private:
  void exchange(const Contents& from, const Contents& to, bool done);
  void show(const Contents& from, const Contents& to, bool done);

  ChangeExecutor& executor_;
  Contents before_;
  Change change_;
  std::optional<commands::StateId> state_;
  bool kept_;
  bool done_ = false;  // true after the first redo()
};

}  // namespace chainmail
