#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "body/body.h"
#include "body/handle.h"
#include "body/method.h"
#include "mesh/mesh.h"
#include "solver/algorithms.h"

namespace chainmail {

/// A box (mesh units). Coordinates that do not exist are those of the object.
struct Box {
  Point low = Point::Zero(), high = Point::Zero();
};

/// Access to an object while a custom method answers a move, for any precision and dimension. It notes which elements
/// move, and puts them back if the method throws. Every function throws Error if an id does not exist. All coordinates
/// are those of the body's axes (see Body::region_axes).
class MovingBody {
 public:
  MovingBody() = default;
  MovingBody(const MovingBody&) = delete;
  MovingBody& operator=(const MovingBody&) = delete;
  ~MovingBody() = default;

  /// The object at rest.
  const Mesh& mesh() const { return *body_->stored_mesh(); }
  /// The neighbours of an element whose links are not cut, in their order. Valid until the next call.
  std::span<const ElementId> neighbours(ElementId element);
  /// True if an element may not move: it is pinned, or part of the handle.
  bool is_fixed(ElementId element) const;

  /// Current position of an element (mesh units).
  Point position(ElementId element) const;
  /// Moves an element. The position is rounded to the precision. Throws Error if the element is fixed, or if a
  /// coordinate is not a finite number of the precision or is on an axis that does not exist.
  void set_position(ElementId element, const Point& position);

  /// Returns the box in which an element is valid for one of its neighbours at its current position, the sponsor
  /// (Li and Brodlie 2003). Throws Error if they are not linked.
  Box valid_region(ElementId sponsor, ElementId element) const;
  /// Moves an element just far enough into that box. Returns true if it moved. This is the step of all methods of the
  /// ChainMail family; it rounds as theirs does. Throws Error if the element is fixed or they are not linked.
  bool clamp(ElementId element, ElementId sponsor);

 private:
  friend class CustomMethod;

  /// The stored coordinates of an element before the move. A double holds a float exactly.
  struct Stored {
    ElementId element;
    std::array<double, 3> at;
  };

  void begin(Body& body, const HandleMove& move, std::vector<ElementId>& moved);
  void undo();
  void check_free(ElementId element) const;
  EntryId entry_of(ElementId sponsor, ElementId element) const;
  template <class Change>
  bool change(ElementId element, Change change);
  Stored stored(ElementId element) const;

  Body* body_ = nullptr;
  const Handle* handle_ = nullptr;
  std::vector<ElementId>* moved_ = nullptr;
  std::vector<Stored> before_;           // of the handle, and of all elements that moved
  std::vector<std::uint32_t> moved_in_;  // the last move in which each element moved
  std::uint32_t move_ = 0;
  std::vector<ElementId> neighbours_;
};

/// The move that a custom method answers.
struct MovedHandle {
  std::span<const ElementId> elements;  // the grabbed elements, ascending; they are at their targets already
  std::span<const Point> before;        // their positions before the move (mesh units), as MovingBody gives them
};

/// A method of your own that needs no templates: derive from it, and make it known with register_method(). Each
/// deformer has one, made when the first move comes; it may keep data between moves.
class CustomMethod : public Method {
 public:
  /// Answers a move: moves the other elements. Returns the number of elements or links that it looked at, for
  /// statistics. If it throws, nothing has moved, and the exception reaches the caller of Deformer::move(); comparisons
  /// list an Error as the reason why the method has no result.
  virtual std::uint64_t answer(MovingBody& body, const MovedHandle& handle) = 0;

  PassCount move(Body& body, HandleMove& move, PassOutput output) final;

 private:
  MovingBody state_;
  std::vector<Point> before_;
};

/// How reports and lists describe a method of a program.
struct MethodDescription {
  std::string name = {};     // letters a to z, digits and hyphens
  std::string label = {};    // title in reports: one line; empty: the name
  std::string source = {};   // publication: author and year
  std::string summary = {};  // one sentence about how it works
  bool needs_grid = false;   // it works only on lattices with links along the axes
  bool holds_links = false;  // no link is violated after a move
};

/// Adds a method to the table of algorithms, for the rest of the program, as a member of the ChainMail family. `make`
/// makes one for each deformer: a CustomMethod, or another Method. No other thread may use the library meanwhile.
/// Throws Error for a name that is not well formed or is taken, and if `make` is empty.
Algorithm register_method(const MethodDescription& description, std::function<std::unique_ptr<Method>()> make);

}  // namespace chainmail
