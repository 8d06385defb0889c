#pragma once

#include <QObject>
#include <optional>
#include <span>
#include <vector>

#include "document/change.h"
#include "mesh/cuts.h"
#include "mesh/mesh.h"

namespace chainmail {

/// What all panels mark: the element under the cursor or in the handle, the links that a stroke would cut, and the
/// elements of a handle of many.
struct Marks {
  std::optional<ElementId> element;
  bool grabbed = false;
  std::vector<LinkId> links;
  std::vector<ElementId> handle = {};  // grabbed, or those that a press would grab

  bool operator==(const Marks&) const = default;
};

/// The marks of a document. They do not change the object and are not undo steps.
class Highlight : public QObject {
  Q_OBJECT

 public:
  const Marks& marks() const { return marks_; }
  void set(const Marks& marks);
  /// Adds links to the marked ones. The time depends only on the number of added links.
  void add(std::span<const LinkId> links);

 signals:
  void changed();
  /// The stroke of a tool has changed, or has ended. All views may draw a part of it.
  void strokeChanged();

 private:
  Marks marks_;
};

/// How a stroke changes the previous selection.
enum class SelectionMode { replace, add, remove };

/// Returns the selection after a stroke over the elements `hit`. All lists are ascending.
std::vector<ElementId> combined(const std::vector<ElementId>& before, const std::vector<ElementId>& hit,
                                SelectionMode mode);

/// Returns the uncut links between these elements; both ascending.
std::vector<LinkId> linksAmong(const Mesh& mesh, const Cuts& cuts, const std::vector<ElementId>& elements);

/// The selected elements of a document, and the links between them. They do not change the object and are not undo
/// steps.
class Selection : public QObject {
  Q_OBJECT

 public:
  explicit Selection(const Contents& contents) : contents_(contents) {}

  /// The selected elements, ascending.
  const std::vector<ElementId>& elements() const { return elements_; }
  /// The uncut links between them, ascending.
  const std::vector<LinkId>& links() const { return links_; }
  bool empty() const { return elements_.empty(); }
  /// Selects these elements, which must be ascending.
  void set(std::vector<ElementId> elements);
  /// Finds the links again, after links were cut or restored.
  void followCuts();

 signals:
  void changed();

 private:
  const Contents& contents_;
  std::vector<ElementId> elements_;
  std::vector<LinkId> links_;
};

}  // namespace chainmail
