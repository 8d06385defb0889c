#include "chainmail/own_method.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <limits>
#include <optional>
#include <utility>

#include "api/access.h"
#include "body/body_view.h"
#include "body/method.h"
#include "files/text/text.h"
#include "solver/algorithms.h"

namespace chainmail::api {
namespace {

std::string element_name(ElementId element) { return "element " + std::to_string(element); }

}  // namespace

/// The state of a move that a method of a user answers.
struct MovingBody::Impl {
  /// The stored coordinates of an element before the move. A double holds a float exactly.
  struct Stored {
    ElementId element;
    std::array<double, 3> at;
  };

  inner::Body* body = nullptr;
  const inner::Handle* handle = nullptr;
  std::vector<ElementId>* moved = nullptr;
  std::optional<Mesh> mesh = {};
  std::vector<Stored> before = {};           // of the handle, and of all elements that moved
  std::vector<std::uint32_t> moved_in = {};  // the last move in which each element moved
  std::uint32_t move = 0;
  std::vector<ElementId> neighbours = {};

  /// Begins a move: the elements of the handle go to their targets.
  void begin(inner::Body& on, const inner::HandleMove& with, std::vector<ElementId>& output);
  /// Puts all elements back.
  void undo();
  void check_free(ElementId element) const;
  /// Returns the entry of an element in the neighbour table of its sponsor.
  EntryId entry_of(ElementId sponsor, ElementId element) const;
  /// Calls change(view), which returns true if it moved the element, and notes that it moved.
  template <class Change>
  bool change(ElementId element, Change change);
  Stored stored(ElementId element) const;
};

void MovingBody::Impl::begin(inner::Body& on, const inner::HandleMove& with, std::vector<ElementId>& output) {
  body = &on;
  handle = &with.handle;
  moved = &output;
  if (!mesh || Access::pointer(*mesh) != on.stored_mesh()) {
    mesh = Access::mesh(on.stored_mesh());
    moved_in.resize(on.mesh().element_count());
  }
  if (++move == std::numeric_limits<std::uint32_t>::max()) {
    std::ranges::fill(moved_in, 0);
    move = 1;
  }
  before.clear();
  for (const ElementId element : handle->elements()) {
    before.push_back(stored(element));
  }
  on.with_view([&](const auto& view) { place_handle(view, with); });  // throws before anything has moved
  moved->clear();
}

MovingBody::Impl::Stored MovingBody::Impl::stored(ElementId element) const {
  Stored result{element, {}};
  body->with_view([&]<class View>(const View& view) {
    for (int k = 0; k < View::Dimension; ++k) {
      result.at[std::size_t(k)] = double(view.positions[element][k]);
    }
  });
  return result;
}

void MovingBody::Impl::undo() {
  body->with_view([&]<class View>(const View& view) {
    for (const Stored& one : before) {
      for (int k = 0; k < View::Dimension; ++k) {
        view.positions[one.element][k] = static_cast<typename View::Scalar>(one.at[std::size_t(k)]);
      }
    }
  });
  moved->clear();
}

void MovingBody::Impl::check_free(ElementId element) const {
  check_id(body->mesh(), element);
  if (body->is_pinned(element) || handle->contains(element)) {
    throw Error(element_name(element), body->is_pinned(element) ? "it is pinned" : "it is part of the handle",
                "move only elements that are not fixed");
  }
}

EntryId MovingBody::Impl::entry_of(ElementId sponsor, ElementId element) const {
  const inner::Mesh& links = body->mesh();
  check_id(links, sponsor);
  check_id(links, element);
  for (EntryId entry = links.first_entry[sponsor]; entry < links.first_entry[sponsor + 1]; ++entry) {
    if (links.neighbours[entry] == element && !body->cuts().is_cut(links.entry_link[entry])) {
      return entry;
    }
  }
  throw Error("elements " + std::to_string(sponsor) + " and " + std::to_string(element),
              "they are not linked, or the link is cut", "use neighbours()");
}

template <class Change>
bool MovingBody::Impl::change(ElementId element, Change change) {
  const Stored old = stored(element);
  const bool has_moved = body->with_view(change);
  if (has_moved && moved_in[element] != move) {
    moved_in[element] = move;
    before.push_back(old);
    moved->push_back(element);
  }
  return has_moved;
}

const Mesh& MovingBody::mesh() const { return *impl_.mesh; }

std::span<const ElementId> MovingBody::neighbours(ElementId element) {
  check_id(impl_.body->mesh(), element);
  impl_.neighbours.clear();
  for_each_neighbour(impl_.body->mesh(), impl_.body->cuts(), element,
                     [&](ElementId neighbour, EntryId) { impl_.neighbours.push_back(neighbour); });
  return impl_.neighbours;
}

bool MovingBody::is_fixed(ElementId element) const {
  check_id(impl_.body->mesh(), element);
  return impl_.body->is_pinned(element) || impl_.handle->contains(element);
}

Vector3 MovingBody::position(ElementId element) const {
  check_id(impl_.body->mesh(), element);
  return vector_of(inner::point_of(*impl_.body->stored_mesh(), impl_.body->stored_positions(), element));
}

void MovingBody::set_position(ElementId element, const Vector3& position) {
  impl_.check_free(element);
  check_coordinates(impl_.body->mesh(), element_name(element), position, false);
  guarded([&] {
    impl_.change(element, [&](const auto& view) {
      const auto target = stored_target(view, element, point_of(position));
      const bool moves = target != view.positions[element];
      view.positions[element] = target;
      return moves;
    });
  });
}

Box MovingBody::valid_region(ElementId sponsor, ElementId element) const {
  const EntryId entry = impl_.entry_of(sponsor, element);
  const inner::Mesh& mesh = impl_.body->mesh();
  std::array<double, 3> low{}, high{};
  impl_.body->with_view([&]<class View>(const View& view) {
    const auto& region = view.regions[entry];
    for (int k = 0; k < View::Dimension; ++k) {
      low[std::size_t(k)] = double(view.positions[sponsor][k] + region.low[k]);
      high[std::size_t(k)] = double(view.positions[sponsor][k] + region.high[k]);
    }
  });
  return {vector_of(mesh.to_point(low.data())), vector_of(mesh.to_point(high.data()))};
}

bool MovingBody::clamp(ElementId element, ElementId sponsor) {
  const EntryId entry = impl_.entry_of(sponsor, element);
  impl_.check_free(element);
  return impl_.change(element, [&](const auto& view) { return view.clamp(element, sponsor, entry); });
}

namespace {

/// Runs a method of a user as one of the library.
class CustomMethod final : public inner::Method {
 public:
  explicit CustomMethod(std::unique_ptr<api::Method> method) : method_(std::move(method)) {}

  PassCount move(inner::Body& body, inner::HandleMove& move, PassOutput output) override {
    before_.clear();
    for (const ElementId element : move.handle.elements()) {
      before_.push_back(vector_of(inner::point_of(*body.stored_mesh(), body.stored_positions(), element)));
    }
    state_.begin(body, move, output.moved);
    return {answer(move.handle), output.moved.size()};
  }

  std::string remark() const override { return method_->remark(); }

 private:
  /// If the method throws, nothing has moved.
  std::uint64_t answer(const inner::Handle& handle) {
    try {
      MovingBody body = Access::moving(state_);
      return method_->move(body, {handle.elements(), before_});
    } catch (const Error& error) {
      state_.undo();
      throw inner::Error(error.where(), error.problem(), error.remedy());
    } catch (const Cancelled&) {
      state_.undo();
      throw inner::Cancelled();
    } catch (...) {
      state_.undo();
      throw;
    }
  }

  std::unique_ptr<api::Method> method_;
  Access::MovingState state_;
  std::vector<Vector3> before_;  // positions of the handle before the move
};

void check_own_name(const std::string& name) {
  const auto fits = [](char one) { return (one >= 'a' && one <= 'z') || (one >= '0' && one <= '9') || one == '-'; };
  const std::string where = "method " + in_quotes(name);
  if (name.empty() || name.size() > 40 || !std::ranges::all_of(name, fits)) {
    throw Error(where, "it cannot be the name of a method", "use up to 40 letters a to z, digits and hyphens");
  }
  if (name == "nothing" || find_algorithm(name)) {
    throw Error(where, "there is a method with this name", "use another name");
  }
}

/// Marks of own methods in plots: an hourglass, in colours that differ.
constexpr std::array<PlotStyle, 4> own_styles{{{"M-1-1H1L-1 1H1Z", "#117733"},
                                               {"M-1-1H1L-1 1H1Z", "#aa4499"},
                                               {"M-1-1H1L-1 1H1Z", "#999933"},
                                               {"M-1-1H1L-1 1H1Z", "#44aa99"}}};

}  // namespace

void register_method(const MethodDescription& description, MethodFactory factory) {
  check_own_name(description.name);
  const auto texts = std::make_shared<MethodDescription>(description);
  texts->label = description.label.empty() ? description.name : printable(description.label);
  texts->source = printable(description.source);
  texts->summary = printable(description.summary);
  if (!factory) {
    throw Error("method " + in_quotes(description.name), "there is no factory", "give a function that makes it");
  }
  const auto others = std::ranges::count_if(every_algorithm(), [](const AlgorithmInfo& one) { return one.is_added(); });
  add_algorithm(
      {.algorithm = {},
       .name = texts->name,
       .label = texts->label,
       .source = texts->source,
       .summary = texts->summary,
       .style = own_styles[std::size_t(others) % own_styles.size()],
       .make = [factory = std::move(factory), texts](inner::Precision, int) -> std::unique_ptr<inner::Method> {
         std::unique_ptr<Method> method = factory();
         if (method == nullptr) {
           throw inner::Error("method " + in_quotes(texts->name), "its factory made none",
                              "return a method from the factory");
         }
         return std::make_unique<CustomMethod>(std::move(method));
       },
       .needs_grid = texts->needs_grid,
       .holds_links = texts->holds_links,
       .texts = texts});
}

}  // namespace chainmail::api
