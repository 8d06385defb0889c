#include "command_line/script.h"

#include <algorithm>
#include <set>

#include "command_line/common.h"
#include "command_line/model.h"

namespace chainmail::command_line {
namespace {

ElementId parse_id(const std::string& where, std::string_view text) {
  const auto id = parse_count(text);
  if (!id) {
    throw Error(where, in_quotes(text) + " is not an element's id", "use a whole number from 0");
  }
  return *id;
}

void check_element(const Action& action, ElementId element, const Mesh& mesh) {
  if (element >= mesh.element_count()) {
    throw Error(action.where, "there is no element " + std::to_string(element),
                "use an id from 0 to " + std::to_string(mesh.element_count() - 1));
  }
}

/// Returns the elements that an action pins or grabs, in the given order.
std::vector<ElementId> elements_of(const Action& action, const Mesh& mesh) {
  if (action.layer.empty() && action.kind == Action::Kind::pin) {
    return {action.element};
  }
  if (action.layer.empty()) {
    std::vector<ElementId> elements;
    for (const auto& [first, last] : action.ranges) {
      check_element(action, last, mesh);
      if (elements.size() + (last - first) >= mesh.element_count()) {
        throw Error(action.where, "it names more elements than the mesh has", "name each element once");
      }
      for (ElementId element = first; element <= last; ++element) {
        elements.push_back(element);
      }
    }
    return elements;
  }
  const auto pins = pins_by_name(action.where, action.layer, mesh);
  if (!pins) {
    throw Error(action.where, in_quotes(action.layer) + " is not an element's id",
                "use a whole number from 0, or " + pin_names());
  }
  return *pins;
}

void check_axes(const Action& action, const Mesh& mesh) {
  for (int k = 0; k < int(action.coordinates.size()); ++k) {
    const double coordinate = action.coordinates[std::size_t(k)];
    const bool stays = coordinate == 0 || (action.kind == Action::Kind::move && coordinate == mesh.origin[k]);
    if (!mesh.has_axis(k) && !stays) {
      const std::string axis(1, "xyz"[k]);
      throw Error(action.where, "the object does not extend along " + axis,
                  "write 0 for " + axis + ", or use more dimensions with --space");
    }
  }
}

void check_link(const Action& action, const Mesh& mesh) {
  check_element(action, action.other, mesh);
  if (!find_link(mesh, action.element, action.other)) {
    throw Error(action.where, "these elements are not linked", "use the ids of the two ends of a link");
  }
}

std::vector<double> parse_coordinates(const std::string& where, std::string_view text) {
  std::vector<double> coordinates;
  for (const std::string_view number : split(text)) {
    coordinates.push_back(parse_number_of(where, number));
    if (coordinates.size() > 3) {
      throw Error(where, "it has more than three coordinates", "write ID:X[,Y[,Z]]");
    }
  }
  return coordinates;
}

/// Reads `ID,A-B,…`.
std::vector<std::pair<ElementId, ElementId>> parse_ranges(const std::string& where, std::string_view text) {
  std::vector<std::pair<ElementId, ElementId>> ranges;
  for (const std::string_view range : split(text)) {
    const std::size_t dash = range.find('-');
    const ElementId first = parse_id(where, range.substr(0, dash));
    const ElementId last = dash == std::string_view::npos ? first : parse_id(where, range.substr(dash + 1));
    if (last < first) {
      throw Error(where, in_quotes(range) + " is not a range", "write the smaller id first");
    }
    ranges.emplace_back(first, last);
  }
  return ranges;
}

bool is_move(const Action& action) {
  return action.kind == Action::Kind::move || action.kind == Action::Kind::by || action.kind == Action::Kind::rotate;
}

/// Checks actions one after another, with what the actions before have pinned and grabbed.
class ActionChecker {
 public:
  ActionChecker(const Mesh& mesh, std::uint32_t steps) : mesh_(mesh), steps_(steps) {}

  void check(const std::vector<Action>& actions) {
    for (const Action& action : actions) {
      check_element(action, action.element, mesh_);
      if (action.of_handle && !is_grabbed_) {
        throw Error(
            action.where,
            "no handle is grabbed at this action: every action except --by without an id and --rotate releases it",
            "put --grab IDS directly before it, or write --by ID:DX,DY,DZ");
      }
      is_grabbed_ = action.kind == Action::Kind::grab || action.of_handle;
      check_one(action);
      count_passes(action);
    }
  }

 private:
  /// A pass has a row in the results, which names the elements of the handle.
  void count_passes(const Action& action) {
    if (action.kind == Action::Kind::grab) {
      handle_ = elements_of(action, mesh_).size();
    } else if (is_move(action)) {
      passes_ += steps_;
      named_ += steps_ * (action.of_handle ? handle_ : 1);
    }
    if (passes_ > most_passes || named_ > most_named) {
      throw Error("--steps",
                  "the moves have more than " + std::to_string(most_passes) + " passes in all, or name more than " +
                      std::to_string(most_named) + " elements in them",
                  "use fewer steps");
    }
  }

  void check_one(const Action& action) {
    switch (action.kind) {
      case Action::Kind::cut:
        return check_link(action, mesh_);
      case Action::Kind::pin:
        return pinned_.merge(as_set(elements_of(action, mesh_)));
      case Action::Kind::grab:
        return check_grab(action);
      case Action::Kind::rotate:
        return check_rotation(action);
      case Action::Kind::move:
      case Action::Kind::by:
        check_axes(action, mesh_);
        return action.of_handle ? void() : check_free(action, action.element);
    }
  }

  static std::set<ElementId> as_set(const std::vector<ElementId>& elements) {
    return {elements.begin(), elements.end()};
  }

  void check_free(const Action& action, ElementId element) const {
    if (pinned_.contains(element)) {
      throw Error(action.where, "element " + std::to_string(element) + " is already pinned and cannot move",
                  "move another element, or pin it later");
    }
  }

  void check_grab(const Action& action) const {
    std::set<ElementId> grabbed;
    for (const ElementId element : elements_of(action, mesh_)) {
      check_free(action, element);
      if (!grabbed.insert(element).second) {
        throw Error(action.where, "element " + std::to_string(element) + " is named twice", "name each element once");
      }
    }
  }

  void check_rotation(const Action& action) const {
    try {
      chainmail::check(action.rotation, mesh_);
    } catch (const Error& error) {
      throw error.at(action.where);
    }
  }

  static constexpr std::uint64_t most_passes = 100'000, most_named = 10'000'000;

  const Mesh& mesh_;
  std::uint32_t steps_;  // passes of each move
  std::uint64_t handle_ = 1, passes_ = 0, named_ = 0;
  std::set<ElementId> pinned_;
  bool is_grabbed_ = false;
};

/// Returns where a move with `--move` or `--by` goes: the axes that are not given stay.
Point target_of(const Action& action, const Mesh& mesh, const Point& start) {
  Point target = start;
  for (int k = 0; k < int(action.coordinates.size()); ++k) {
    if (mesh.has_axis(k)) {
      const double coordinate = action.coordinates[std::size_t(k)];
      target[k] = action.kind == Action::Kind::by ? start[k] + coordinate : coordinate;
    }
  }
  return target;
}

void apply(Deformation& deformation, const Action& action, std::uint32_t steps) {
  const Mesh& mesh = deformation.simulation().mesh();
  switch (action.kind) {
    case Action::Kind::cut:
      return deformation.apply(commands::Cut{{*find_link(mesh, action.element, action.other)}});
    case Action::Kind::pin:
      return deformation.apply(commands::Pin{elements_of(action, mesh)});
    case Action::Kind::grab:
      return deformation.apply(commands::Grab{elements_of(action, mesh)});
    case Action::Kind::move:
    case Action::Kind::by:
    case Action::Kind::rotate:
      if (action.of_handle) {
        deformation.move_handle(target_of(action, mesh, Point::Zero()), action.rotation, steps);
      } else {
        const Point start = point_of(mesh, deformation.simulation().body().positions(), action.element);
        deformation.move(action.element, target_of(action, mesh, start), steps);
      }
  }
}

void carry_out(Deformation& deformation, const Action& action, std::uint32_t steps) {
  try {
    if (!action.of_handle) {
      deformation.apply(commands::Release{});
    }
    apply(deformation, action, steps);
  } catch (const Error& error) {
    throw is_move(action) ? error.at(action.where + ": " + error.where()) : error;
  }
}

}  // namespace

Rotation parse_rotation(const std::string& where, std::string_view text) {
  const std::size_t mark = text.find(':');
  const std::string_view axis = text.substr(0, mark);
  if (mark == std::string_view::npos) {
    throw Error(where, "it has no axis or no angle", "write AXIS:DEGREES, such as z:30 or 0,1,1:30");
  }
  Rotation rotation{Point::Zero(), parse_number_of(where, text.substr(mark + 1))};
  if (const std::size_t k = std::string_view("xyz").find(axis); axis.size() == 1 && k != std::string_view::npos) {
    rotation.axis[int(k)] = 1;
    return rotation;
  }
  if (std::ranges::count(axis, ',') != 2) {
    throw Error(where, in_quotes(axis) + " is not an axis", "use x, y, z, or three coordinates");
  }
  const std::vector<double> coordinates = parse_coordinates(where, axis);
  rotation.axis = {coordinates[0], coordinates[1], coordinates[2]};
  if (rotation.axis == Point::Zero()) {
    throw Error(where, "the rotation has no axis: all its coordinates are 0", "use x, y, z, or other coordinates");
  }
  return rotation;
}

Action parse_action(Action::Kind kind, const std::string& option, const std::string& text) {
  Action action{kind, option + " " + text, 0, 0, {}, {}};
  const bool starts_with_digit = text.find_first_of("0123456789") == 0;
  const bool is_cut = kind == Action::Kind::cut;
  const std::size_t mark = text.find(is_cut ? '-' : ':');
  if (kind == Action::Kind::rotate) {
    action.rotation = parse_rotation(action.where, text);
    action.of_handle = true;
  } else if ((kind == Action::Kind::pin || kind == Action::Kind::grab) && !starts_with_digit) {
    action.layer = text;
  } else if (kind == Action::Kind::pin) {
    action.element = parse_id(action.where, text);
  } else if (kind == Action::Kind::grab) {
    action.ranges = parse_ranges(action.where, text);
  } else if (kind == Action::Kind::by && mark == std::string::npos) {
    action.of_handle = true;
    action.coordinates = parse_coordinates(action.where, text);
  } else if (mark == std::string::npos) {
    throw Error(action.where, is_cut ? "it does not name a link" : "it does not name a target",
                is_cut ? "write A-B with the ids of the two ends" : "write ID:X[,Y[,Z]]");
  } else {
    action.element = parse_id(action.where, std::string_view(text).substr(0, mark));
    const std::string_view rest = std::string_view(text).substr(mark + 1);
    is_cut ? void(action.other = parse_id(action.where, rest))
           : void(action.coordinates = parse_coordinates(action.where, rest));
  }
  return action;
}

void check_actions(const std::vector<Action>& actions, const Mesh& mesh, std::uint32_t steps) {
  ActionChecker(mesh, steps).check(actions);
}

std::uint64_t passes_of(const std::vector<chainmail::Command>& recorded, const std::vector<Action>& actions,
                        std::uint32_t steps) {
  return std::uint64_t(std::ranges::count_if(actions, is_move)) * steps + count_drags(recorded);
}

void carry_out(Deformation& deformation, const std::vector<chainmail::Command>& recorded,
               const std::vector<Action>& actions, std::uint32_t steps) {
  for (const chainmail::Command& command : recorded) {
    deformation.apply(command);
  }
  for (const Action& action : actions) {
    carry_out(deformation, action, steps);
  }
}

}  // namespace chainmail::command_line
