#include "command_line/script.h"

#include <algorithm>
#include <set>

#include "command_line/model.h"
#include "mesh/layers.h"
#include "simulate/move_history.h"

namespace chainmail::command_line {
namespace {

using enum Action::Kind;

Point parse_point(const std::string& where, std::string_view text) {
  std::vector<double> coordinates = parse_coordinates(where, text);
  coordinates.resize(3);
  return Point(coordinates.data());
}

ElementId parse_id(const std::string& where, std::string_view text) {
  const auto id = parse_count(text);
  require(id.has_value(), where, in_quotes(text) + " is not an element's id", "use a whole number from 0");
  return *id;
}

/// Reads `ID,A-B,…`.
std::vector<std::pair<ElementId, ElementId>> parse_ranges(const std::string& where, std::string_view text) {
  std::vector<std::pair<ElementId, ElementId>> ranges;
  for (const std::string_view range : split(text)) {
    const std::size_t dash = range.find('-');
    const ElementId first = parse_id(where, range.substr(0, dash));
    const ElementId last = dash == std::string_view::npos ? first : parse_id(where, range.substr(dash + 1));
    require(first <= last, where, in_quotes(range) + " is not a range", "write the smaller id first");
    ranges.emplace_back(first, last);
  }
  return ranges;
}

bool is_move(const Action& action) { return action.kind == move || action.kind == by || action.kind == rotate; }

void check_element(const Action& action, ElementId element, const Mesh& mesh) {
  require(element < mesh.element_count(), action.where, "there is no element " + std::to_string(element),
          "use an id from 0 to " + std::to_string(mesh.element_count() - 1));
}

/// Returns the elements that an action pins or grabs, in the given order.
std::vector<ElementId> elements_of(const Action& action, const Mesh& mesh) {
  if (!action.layer.empty()) {
    return error_at(action.where, [&] { return elements_at(mesh, action.layer); });
  }
  std::vector<ElementId> elements;
  for (const auto& [first, last] : action.ranges) {
    check_element(action, last, mesh);
    require(elements.size() + (last - first) < mesh.element_count(), action.where,
            "it names more elements than the mesh has", "name each element once");
    for (ElementId element = first; element <= last; ++element) {
      elements.push_back(element);
    }
  }
  return elements;
}

void check_axes(const Action& action, const Mesh& mesh) {
  for (int k = 0; k < int(action.coordinates.size()); ++k) {
    const double coordinate = action.coordinates[std::size_t(k)];
    const bool stays = coordinate == 0 || (action.kind == move && coordinate == mesh.origin[k]);
    const std::string axis(1, "xyz"[k]);
    require(mesh.has_axis(k) || stays, action.where, "the object does not extend along " + axis,
            "write 0 for " + axis + ", or use more dimensions with --space");
  }
}

/// Checks actions one after another, with what the actions before have pinned and grabbed.
class ActionChecker {
 public:
  explicit ActionChecker(std::uint32_t steps) : steps_(steps) {}

  /// Checks an action on the mesh that the object then has.
  void check(const Action& action, const Mesh& mesh) {
    check_element(action, action.element, mesh);
    require(!action.of_handle || is_grabbed_, action.where,
            "no handle is grabbed at this action: every action except --by without an id and --rotate releases it",
            "put --grab IDS directly before it, or write --by ID:DX,DY,DZ");
    is_grabbed_ = action.kind == grab || action.of_handle;
    check_one(action, mesh);
    count_passes(action);
  }

 private:
  void check_one(const Action& action, const Mesh& mesh) {
    if (action.kind == cut) {
      check_element(action, action.other, mesh);
      require(find_link(mesh, action.element, action.other).has_value(), action.where, "these elements are not linked",
              "use the ids of the two ends of a link");
    } else if (action.kind == pin) {
      const std::vector<ElementId> elements = elements_of(action, mesh);
      pinned_.insert(elements.begin(), elements.end());
    } else if (action.kind == grab) {
      check_grab(action, mesh);
    } else if (action.kind == rotate) {
      error_at(action.where, [&] { chainmail::check(action.rotation, mesh); });
    } else if (action.kind == blade) {
      error_at(action.where, [&] { chainmail::check(action.blade, mesh); });
    } else {
      check_axes(action, mesh);
      if (!action.of_handle) {
        check_free(action, action.element);
      }
    }
  }

  void check_free(const Action& action, ElementId element) const {
    if (pinned_.contains(element)) {
      throw Error(action.where, "element " + std::to_string(element) + " is already pinned and cannot move",
                  "move another element, or pin it later");
    }
  }

  void check_grab(const Action& action, const Mesh& mesh) {
    std::set<ElementId> grabbed;
    for (const ElementId element : elements_of(action, mesh)) {
      check_free(action, element);
      if (!grabbed.insert(element).second) {
        throw Error(action.where, "element " + std::to_string(element) + " is named twice", "name each element once");
      }
    }
    handle_ = grabbed.size();
  }

  /// A pass has a row in the results, which names the elements of the handle.
  void count_passes(const Action& action) {
    if (is_move(action)) {
      passes_ += steps_;
      named_ += steps_ * (action.of_handle ? handle_ : 1);
    }
    require(passes_ <= most_passes && named_ <= most_named, "--steps",
            "the moves have more than " + std::to_string(most_passes) + " passes in all, or name more than " +
                std::to_string(most_named) + " elements in them",
            "use fewer steps");
  }

  static constexpr std::uint64_t most_passes = 100'000, most_named = 10'000'000;

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

void split(Deformation& deformation, const Action& action) {
  const Simulation& simulation = deformation.simulation();
  const SplitPointer split = error_at(action.where, [&] { return split_along(action.blade, simulation.body()); });
  require(split != nullptr, action.where, "nothing comes apart", "give a line that crosses the object");
  const MeshPointer after = split->after();  // kept until the simulation has it
  error_at(action.where, [&] { check(simulation.statistics().algorithm, *after); });  // some need a lattice
  deformation.apply(commands::Split{split});
}

void apply(Deformation& deformation, const Action& action, std::uint32_t steps) {
  const Mesh& mesh = deformation.simulation().mesh();
  if (action.kind == cut) {
    deformation.apply(commands::Cut{{*find_link(mesh, action.element, action.other)}});
  } else if (action.kind == pin) {
    deformation.apply(commands::Pin{elements_of(action, mesh)});
  } else if (action.kind == grab) {
    deformation.apply(commands::Grab{elements_of(action, mesh)});
  } else if (action.kind == blade) {
    split(deformation, action);
  } else if (action.of_handle) {
    deformation.move_handle(target_of(action, mesh, Point::Zero()), action.rotation, steps);
  } else {
    const Point start = point_of(mesh, deformation.simulation().body().positions(), action.element);
    deformation.move(action.element, target_of(action, mesh, start), steps);
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

Action parse_action(Action::Kind kind, const std::string& option, const std::string& text) {
  Action action{.kind = kind, .where = option + " " + text};
  const std::string& where = action.where;
  const std::size_t mark = text.find(kind == cut ? '-' : ':');
  if (kind == rotate) {
    action.rotation = parse_rotation(where, text);
    action.of_handle = true;
  } else if ((kind == pin || kind == grab) && text.find_first_of("0123456789") != 0) {
    require(is_side(text), where, in_quotes(text) + " is not an element's id",
            "use a whole number from 0, or " + pin_names());
    action.layer = text;
  } else if (kind == blade) {
    for (const std::string_view point : split(text, ';')) {
      action.blade.line.push_back(parse_point(where, point));
    }
  } else if (kind == along) {
    action.blade.along = parse_point(where, text);
  } else if (kind == pin) {
    action.ranges = {{parse_id(where, text), parse_id(where, text)}};
  } else if (kind == grab) {
    action.ranges = parse_ranges(where, text);
  } else if (kind == by && mark == std::string::npos) {
    action.of_handle = true;
    action.coordinates = parse_coordinates(where, text);
  } else {
    require(mark != std::string::npos, where, kind == cut ? "it does not name a link" : "it does not name a target",
            kind == cut ? "write A-B with the ids of the two ends" : "write ID:X[,Y[,Z]]");
    action.element = parse_id(where, text.substr(0, mark));
    const std::string rest = text.substr(mark + 1);
    action.other = kind == cut ? parse_id(where, rest) : 0;
    action.coordinates = kind == cut ? std::vector<double>() : parse_coordinates(where, rest);
  }
  return action;
}

void add_action(std::vector<Action>& actions, Action action) {
  if (action.kind != along) {
    actions.push_back(std::move(action));
    return;
  }
  require(!actions.empty() && actions.back().kind == blade && !actions.back().blade.along, action.where,
          "there is no --split without a direction directly before it", "write --split X,Y,Z;… --along DX,DY,DZ");
  actions.back().blade.along = action.blade.along;
}

void check_actions(const std::vector<Action>& actions, const Mesh& mesh, std::uint32_t steps) {
  ActionChecker checker(steps);
  for (const Action& action : actions) {
    checker.check(action, mesh);
    if (action.kind == blade) {
      return;
    }
  }
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
  ActionChecker checker(steps);
  for (const Action& action : actions) {
    checker.check(action, deformation.simulation().mesh());
    carry_out(deformation, action, steps);
  }
}

}  // namespace chainmail::command_line
