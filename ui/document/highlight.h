#pragma once

#include <QObject>
#include <optional>
#include <span>
#include <vector>

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

 private:
  Marks marks_;
};

}  // namespace chainmail
