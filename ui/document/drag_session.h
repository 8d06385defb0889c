#pragma once

#include <QString>
#include <optional>
#include <span>
#include <vector>

#include "simulate/command.h"

namespace chainmail {

class ChangeExecutor;
class Document;

/// The handle of a document. A drag, from grab() to release(), goes directly to the solvers and becomes one undo step
/// if anything moved. Targets are in mesh units.
class DragSession {
 public:
  DragSession(Document& document, ChangeExecutor& executor) : document_(document), executor_(executor) {}

  void grab(ElementId element) { grab(std::vector{element}); }
  /// Grabs elements, which move together as one rigid body. Leaves pinned elements out; if all are pinned, the solvers
  /// refuse the grab.
  void grab(std::vector<ElementId> elements);
  /// Moves the handle. A drag of nothing, for example after all elements of a grab were pinned, is not recorded: no
  /// session with it could be opened.
  void drag(const commands::Drag& drag);
  /// Moves a handle of one element to a position.
  void drag(const Point& target) { drag(commands::Drag{target}); }
  /// Moves the handle by a displacement and a rotation about its pivot, both since it was grabbed.
  void dragBy(const Point& by, const Rotation& rotation = {}) { drag(commands::Drag{by, rotation, true}); }
  void release();
  /// Ends the drag and restores the object as it was before. It does not become an undo step.
  void cancel();
  /// Ends the drag, if there is one. The solvers release the handle, because the next change may be refused for its
  /// elements.
  void end();

  /// True between a grab and its end.
  bool isActive() const { return handle_.has_value(); }
  /// The grabbed elements, ascending; empty while nothing is grabbed.
  std::span<const ElementId> held() const { return handle_ ? handle_->elements : std::span<const ElementId>(); }

 private:
  struct Handle {
    std::vector<ElementId> elements;  // ascending
    QString text;                     // of the undo step
    commands::StateId before = 0;     // state before the drag, which the solvers have saved
    bool moved = false;
  };

  void begin(std::vector<ElementId> elements, const QString& text);

  Document& document_;
  ChangeExecutor& executor_;
  std::optional<Handle> handle_;
};

}  // namespace chainmail
