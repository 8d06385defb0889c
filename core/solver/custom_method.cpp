#include "solver/custom_method.h"

#include <algorithm>
#include <limits>
#include <utility>

#include "body/body_view.h"
#include "mesh/error.h"

namespace chainmail {
namespace {

std::string name_of(ElementId element) { return "element " + std::to_string(element); }

}  // namespace

/// Begins a move: the elements of the handle go to their targets.
void MovingBody::begin(Body& body, const HandleMove& move, std::vector<ElementId>& moved) {
  body_ = &body;
  handle_ = &move.handle;
  moved_ = &moved;
  moved_in_.resize(body.mesh().element_count());
  if (++move_ == std::numeric_limits<std::uint32_t>::max()) {
    std::ranges::fill(moved_in_, 0);
    move_ = 1;
  }
  before_.clear();
  for (const ElementId element : handle_->elements()) {
    before_.push_back(stored(element));
  }
  body.with_view([&](const auto& view) { place_handle(view, move); });  // throws before anything has moved
  moved.clear();
}

MovingBody::Stored MovingBody::stored(ElementId element) const {
  Stored result{element, {}};
  body_->with_view([&]<class View>(const View& view) {
    std::copy_n(view.positions[element].at, View::Dimension, result.at.begin());
  });
  return result;
}

/// Puts all elements back.
void MovingBody::undo() {
  body_->with_view([&]<class View>(const View& view) {
    for (const Stored& one : before_) {
      for (int k = 0; k < View::Dimension; ++k) {
        view.positions[one.element][k] = static_cast<typename View::Scalar>(one.at[std::size_t(k)]);
      }
    }
  });
  moved_->clear();
}

void MovingBody::check_free(ElementId element) const {
  if (is_fixed(element)) {
    throw Error(name_of(element), body_->is_pinned(element) ? "it is pinned" : "it is part of the handle",
                "move only elements that are not fixed");
  }
}

/// Returns the entry of an element in the neighbour table of its sponsor.
EntryId MovingBody::entry_of(ElementId sponsor, ElementId element) const {
  const Mesh& links = body_->mesh();
  check_elements(links, std::array{sponsor, element});
  for (EntryId entry = links.first_entry[sponsor]; entry < links.first_entry[sponsor + 1]; ++entry) {
    if (links.neighbours[entry] == element && !body_->cuts().is_cut(links.entry_link[entry])) {
      return entry;
    }
  }
  throw Error("elements " + std::to_string(sponsor) + " and " + std::to_string(element),
              "they are not linked, or the link is cut", "use neighbours()");
}

/// Calls change(view), which returns true if it moved the element, and notes that it moved.
template <class Change>
bool MovingBody::change(ElementId element, Change change) {
  const Stored old = stored(element);
  const bool has_moved = body_->with_view(change);
  if (has_moved && moved_in_[element] != move_) {
    moved_in_[element] = move_;
    before_.push_back(old);
    moved_->push_back(element);
  }
  return has_moved;
}

std::span<const ElementId> MovingBody::neighbours(ElementId element) {
  check_element(body_->mesh(), element);
  neighbours_.clear();
  for_each_neighbour(body_->mesh(), body_->cuts(), element,
                     [&](ElementId neighbour, EntryId) { neighbours_.push_back(neighbour); });
  return neighbours_;
}

bool MovingBody::is_fixed(ElementId element) const {
  check_element(body_->mesh(), element);
  return body_->is_pinned(element) || handle_->contains(element);
}

Point MovingBody::position(ElementId element) const {
  check_element(body_->mesh(), element);
  return point_of(*body_->stored_mesh(), body_->stored_positions(), element);
}

void MovingBody::set_position(ElementId element, const Point& position) {
  check_free(element);
  check_position(body_->mesh(), name_of(element), position);
  change(element, [&](const auto& view) {
    const auto target = stored_target(view, element, position);
    const bool moves = target != view.positions[element];
    view.positions[element] = target;
    return moves;
  });
}

Box MovingBody::valid_region(ElementId sponsor, ElementId element) const {
  const EntryId entry = entry_of(sponsor, element);
  std::array<double, 3> low{}, high{};
  body_->with_view([&]<class View>(const View& view) {
    const auto& region = view.regions[entry];
    for (int k = 0; k < View::Dimension; ++k) {
      low[std::size_t(k)] = double(view.positions[sponsor][k] + region.low[k]);
      high[std::size_t(k)] = double(view.positions[sponsor][k] + region.high[k]);
    }
  });
  return {mesh().to_point(low.data()), mesh().to_point(high.data())};
}

bool MovingBody::clamp(ElementId element, ElementId sponsor) {
  const EntryId entry = entry_of(sponsor, element);
  check_free(element);
  return change(element, [&](const auto& view) { return view.clamp(element, sponsor, entry); });
}

PassCount CustomMethod::move(Body& body, HandleMove& move, PassOutput output) {
  before_.clear();
  for (const ElementId element : move.handle.elements()) {
    before_.push_back(point_of(*body.stored_mesh(), body.stored_positions(), element));
  }
  state_.begin(body, move, output.moved);
  try {
    const std::uint64_t checked = answer(state_, {move.handle.elements(), before_});
    return {checked, output.moved.size()};
  } catch (...) {
    state_.undo();
    throw;
  }
}

namespace {

void check_name(const std::string& name) {
  const auto fits = [](char one) { return (one >= 'a' && one <= 'z') || (one >= '0' && one <= '9') || one == '-'; };
  const std::string where = "method '" + name.substr(0, 60) + "'";
  if (name.empty() || name.size() > 40 || !std::ranges::all_of(name, fits)) {
    throw Error(where, "it cannot be the name of a method", "use up to 40 letters a to z, digits and hyphens");
  }
  if (name == "nothing" || find_algorithm(name)) {
    throw Error(where, "there is a method with this name", "use another name");
  }
}

/// Marks of added methods in plots: an hourglass, in colours that differ.
constexpr std::array<PlotStyle, 4> added_styles{{{"M-1-1H1L-1 1H1Z", "#117733"},
                                                 {"M-1-1H1L-1 1H1Z", "#aa4499"},
                                                 {"M-1-1H1L-1 1H1Z", "#999933"},
                                                 {"M-1-1H1L-1 1H1Z", "#44aa99"}}};

}  // namespace

Algorithm register_method(const MethodDescription& description, std::function<std::unique_ptr<Method>()> make) {
  check_name(description.name);
  const auto texts = std::make_shared<MethodDescription>(description);
  texts->label = description.label.empty() ? description.name : description.label;
  const std::string where = "method '" + texts->name + "'";
  if (!make) {
    throw Error(where, "there is no factory", "give a function that makes it");
  }
  const auto others = std::ranges::count_if(every_algorithm(), [](const AlgorithmInfo& one) { return one.is_added(); });
  return add_algorithm({.algorithm = {},
                        .name = texts->name,
                        .label = texts->label,
                        .source = texts->source,
                        .summary = texts->summary,
                        .style = added_styles[std::size_t(others) % added_styles.size()],
                        .make =
                            [make = std::move(make), where](Precision, int) {
                              std::unique_ptr<Method> method = make();
                              if (method == nullptr) {
                                throw Error(where, "its factory made none", "return a method from the factory");
                              }
                              return method;
                            },
                        .needs_grid = texts->needs_grid,
                        .holds_links = texts->holds_links,
                        .texts = texts});
}

}  // namespace chainmail
