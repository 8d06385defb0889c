#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <string>

#include "chainmail/handle.h"
#include "chainmail/mesh.h"
#include "chainmail/types.h"

namespace chainmail::api {

struct Access;

/// A box (mesh units). Coordinates that do not exist are those of the object.
struct Box {
  Vector3 low = {};   ///< Lowest corner.
  Vector3 high = {};  ///< Highest corner.
};

/// Access to an object while a method of your own answers a move. It notes which elements move. Every function throws
/// Error if an id does not exist. All coordinates are along the axes on which valid regions lie (see Body::set_frame).
class MovingBody {
 public:
  MovingBody(const MovingBody&) = delete;
  MovingBody& operator=(const MovingBody&) = delete;

  /// The object at rest.
  const Mesh& mesh() const;
  /// The neighbours of an element whose links are not cut, in their order. Valid until the next call.
  std::span<const ElementId> neighbours(ElementId element);
  /// True if an element may not move: it is pinned, or part of the handle.
  bool is_fixed(ElementId element) const;

  /// Current position of an element (mesh units).
  Vector3 position(ElementId element) const;
  /// Moves an element. The position is rounded to the precision. Throws Error if the element is fixed, or if a
  /// coordinate is not a finite number of the precision.
  void set_position(ElementId element, const Vector3& position);

  /// Returns the box in which an element is valid for one of its neighbours at its current position, the sponsor
  /// (Li and Brodlie 2003). Throws Error if they are not linked.
  Box valid_region(ElementId sponsor, ElementId element) const;
  /// Moves an element just far enough into that box. Returns true if it moved. This is the step of all methods of the
  /// ChainMail family; it rounds as theirs does. Throws Error if the element is fixed or they are not linked.
  bool clamp(ElementId element, ElementId sponsor);

 private:
  friend struct Access;
  struct Impl;
  explicit MovingBody(Impl& impl) : impl_(impl) {}
  Impl& impl_;
};

/// The move that a method answers.
struct HandleMove {
  std::span<const ElementId> elements = {};  ///< The grabbed elements, ascending. They are at their targets already.
  std::span<const Vector3> before = {};  ///< Their positions before the move (mesh units), as MovingBody gives them.
};

/// A method of your own. Each Deformer has one, made by the factory when the first move comes; it may keep data between
/// moves. Derive from it, and make it known with register_method().
class Method {
 public:
  virtual ~Method() = default;

  /// Answers a move: moves the other elements. Returns the number of elements or links that it looked at, for
  /// statistics. If it throws, all elements are put back, and the exception reaches the caller of Deformer::move();
  /// compare() lists an Error as the reason why the method has no result.
  virtual std::uint64_t move(MovingBody& body, const HandleMove& move) = 0;

  /// Returns the reason why the last move did not end as requested, for the user. Usually empty.
  virtual std::string remark() const { return {}; }
};

/// How reports and lists describe a method of your own.
struct MethodDescription {
  std::string name = {};     ///< Its name: letters a to z, digits and hyphens.
  std::string label = {};    ///< Its title in reports: one line. Empty: the name.
  std::string source = {};   ///< Publication: author and year.
  std::string summary = {};  ///< One sentence about how it works.
  bool needs_grid = false;   ///< True if it works only on lattices with links along the axes.
  bool holds_links = false;  ///< True if no link is violated after a move.
};

/// Makes a method for a Deformer.
using MethodFactory = std::function<std::unique_ptr<Method>()>;

/// Makes a method known under a name, for the rest of the program: it is listed by methods(), and works in Deformer,
/// compare() and calibrate() like those that are built in, as a member of the ChainMail family. No other thread may use
/// the library meanwhile. Throws Error for a name that is not well formed or is taken, and for an empty factory.
void register_method(const MethodDescription& description, MethodFactory factory);

}  // namespace chainmail::api
