#pragma once

#include <memory>
#include <span>
#include <vector>

#include "chainmail/body.h"
#include "chainmail/types.h"

namespace chainmail::api {

struct Access;

/// Where a handle is.
struct Pose {
  /// Position of its pivot (mesh units). Coordinates that do not exist are 0 or those of the object.
  Vector3 pivot = {};
  Rotation rotation = {};  ///< Rotation about the pivot since the handle was grabbed.

  /// True if position and rotation are equal.
  bool operator==(const Pose&) const = default;
};

/// Throws Error about a rotation that has no axis, or that leaves the space of a mesh.
void check(const Rotation& rotation, const Mesh& mesh);

/// A rigid motion of a handle, from where it was grabbed.
struct Motion {
  Vector3 by = {};         ///< Displacement of the pivot (mesh units).
  Rotation rotation = {};  ///< Rotation about the pivot.

  /// True if displacement and rotation are equal.
  bool operator==(const Motion&) const = default;
};

/// What is grabbed: one element, or many that move together as one rigid body. The pivot is the mean of the positions
/// at which they were grabbed. After positions were set, restored or reset, grab again: a handle moves its elements
/// from where they were grabbed.
class Handle {
 public:
  /// Grabs elements at their current positions; nothing moves. Throws Error if there is none, or if one does not exist,
  /// is given twice or is pinned.
  Handle(const Body& body, const std::vector<ElementId>& elements);
  /// Copies the handle.
  Handle(const Handle& other);
  /// Moves the handle; `other` may then only be assigned to or destroyed.
  Handle(Handle&& other) noexcept;
  /// Copies the handle.
  Handle& operator=(const Handle& other);
  /// Moves the handle; `other` may then only be assigned to or destroyed.
  Handle& operator=(Handle&& other) noexcept;
  ~Handle();

  /// The object at rest.
  const Mesh& mesh() const;
  /// The grabbed elements, ascending. Valid while the handle exists.
  std::span<const ElementId> elements() const;
  /// The pose at which it was grabbed.
  Pose grabbed() const;
  /// The pose that the last move reached.
  Pose pose() const;
  /// Returns the pose after a motion from where it was grabbed.
  Pose after(const Motion& motion) const;

 private:
  friend struct Access;
  struct Impl;
  explicit Handle(std::unique_ptr<Impl> impl);
  std::unique_ptr<Impl> impl_;
};

}  // namespace chainmail::api
