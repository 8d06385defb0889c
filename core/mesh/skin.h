#pragma once

#include <memory>
#include <mutex>
#include <span>
#include <vector>

#include "mesh/carriers.h"

namespace chainmail {

/// The surface that an object had before its cells were divided. A side of a cell that lies in it is skin. All others
/// are inner sides, which cuts have laid open.
class Skin {
 public:
  explicit Skin(const MeshPointer& undivided);

  /// Returns the skin of a mesh to which a split appends these elements. Takes time in proportion to the elements that
  /// all splits have appended.
  static std::shared_ptr<const Skin> after(const MeshPointer& mesh, std::span<const SplitPoint> appended);

  /// True if the elements lie in one side of the surface. The first call for any of the splits of a mesh takes a pass
  /// over all cells of the undivided mesh. Safe to call from several threads.
  bool contains(std::span<const ElementId> corners) const;

 private:
  struct First {
    MeshPointer mesh;
    std::mutex mutex;
    bool is_found = false;
    std::vector<Carrier> sides;  // of the surface, and their triangles, sorted; found when they are first needed
  };

  std::shared_ptr<First> first_;  // the same after all splits
  Carriers carriers_;
};

}  // namespace chainmail
