#include "command_line/script.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <set>

#include "command_line/common.h"
#include "command_line/elastic.h"
#include "command_line/progress_line.h"
#include "files/text/text.h"
#include "mesh/error.h"

namespace chainmail::command_line {
namespace {

/// Shows the number of finished passes on a progress line.
class PassProgress {
 public:
  explicit PassProgress(std::uint64_t total) : total_(total) {}

  void advance() {
    ++done_;
    line_.show([this] { return "pass " + std::to_string(done_) + " of " + std::to_string(total_); });
  }

 private:
  std::uint64_t total_;
  std::uint64_t done_ = 0;
  ProgressLine line_{std::chrono::seconds(1)};
};

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
  for (int k = 0; k < static_cast<int>(action.coordinates.size()); ++k) {
    const double coordinate = action.coordinates[k];
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
  for (;;) {
    const std::size_t end = std::min(text.find(','), text.size());
    coordinates.push_back(parse_number_of(where, text.substr(0, end)));
    if (coordinates.size() > 3) {
      throw Error(where, "it has more than three coordinates", "write ID:X[,Y[,Z]]");
    }
    if (end == text.size()) {
      return coordinates;
    }
    text.remove_prefix(end + 1);
  }
}

/// Reads `ID,A-B,…`.
std::vector<std::pair<ElementId, ElementId>> parse_ranges(const std::string& where, std::string_view text) {
  std::vector<std::pair<ElementId, ElementId>> ranges;
  for (;;) {
    const std::size_t end = std::min(text.find(','), text.size());
    const std::string_view range = text.substr(0, end);
    const std::size_t dash = range.find('-');
    const ElementId first = parse_id(where, range.substr(0, dash));
    const ElementId last = dash == std::string_view::npos ? first : parse_id(where, range.substr(dash + 1));
    if (last < first) {
      throw Error(where, in_quotes(range) + " is not a range", "write the smaller id first");
    }
    ranges.emplace_back(first, last);
    if (end == text.size()) {
      return ranges;
    }
    text.remove_prefix(end + 1);
  }
}

bool is_move(const Action& action) {
  return action.kind == Action::Kind::move || action.kind == Action::Kind::by || action.kind == Action::Kind::rotate;
}

/// Checks actions one after another, with what the actions before have pinned and grabbed.
class ActionChecker {
 public:
  explicit ActionChecker(const Mesh& mesh) : mesh_(mesh) {}

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
    }
  }

 private:
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

  const Mesh& mesh_;
  std::set<ElementId> pinned_;
  bool is_grabbed_ = false;
};

class Runner {
 public:
  Runner(Simulation& simulation, const Schedule& schedule, std::uint64_t passes)
      : simulation_(simulation), schedule_(schedule), progress_(passes) {}

  void carry_out(const chainmail::Command& command) {
    if (const auto* drag = std::get_if<commands::Drag>(&command)) {
      pass(*drag);
    } else {
      simulation_.apply(command);
    }
  }

  void carry_out(const Action& action) {
    try {
      if (!action.of_handle) {
        simulation_.apply(commands::Release{});
      }
      apply(action);
    } catch (const Error& error) {
      throw is_move(action) ? error.at(action.where + ": " + error.where()) : error;
    }
  }
  Run take() { return std::move(run_); }

 private:
  void apply(const Action& action);
  Point target_of(const Action& action, const Point& start) const;
  void move(const Action& action);
  void move_handle(const Action& action);
  void pass(const commands::Drag& drag);

  Simulation& simulation_;
  const Schedule& schedule_;
  commands::Drag handle_;  // where the handle of many is, since it was grabbed
  PassProgress progress_;
  Run run_;
};

void Runner::apply(const Action& action) {
  const Mesh& mesh = simulation_.mesh();
  switch (action.kind) {
    case Action::Kind::cut:
      simulation_.apply(commands::Cut{{*find_link(mesh, action.element, action.other)}});
      break;
    case Action::Kind::pin:
      simulation_.apply(commands::Pin{elements_of(action, mesh)});
      break;
    case Action::Kind::grab:
      simulation_.apply(commands::Grab{elements_of(action, mesh)});
      handle_ = {Point::Zero(), {}, true};
      break;
    case Action::Kind::move:
    case Action::Kind::by:
    case Action::Kind::rotate:
      action.of_handle ? move_handle(action) : move(action);
      break;
  }
}

Point Runner::target_of(const Action& action, const Point& start) const {
  Point target = start;
  for (int i = 0; i < simulation_.mesh().space_dimension; ++i) {
    const int k = simulation_.mesh().axes[i];
    if (k < static_cast<int>(action.coordinates.size())) {
      target[k] = action.kind == Action::Kind::by ? start[k] + action.coordinates[k] : action.coordinates[k];
    }
  }
  return target;
}

void Runner::move(const Action& action) {
  const Point start = point_of(simulation_.mesh(), simulation_.body().positions(), action.element);
  const Point target = target_of(action, start);
  simulation_.apply(commands::Grab{action.element});
  for (std::uint32_t step = 1; step <= schedule_.steps; ++step) {
    Point between;
    for (int k = 0; k < 3; ++k) {
      // std::lerp ends exactly at the target, and does not overflow.
      between[k] = std::lerp(start[k], target[k], double(step) / schedule_.steps);
    }
    pass({between});
  }
  simulation_.apply(commands::Release{});
}

/// Moves the handle of many from where it is.
void Runner::move_handle(const Action& action) {
  const commands::Drag from = handle_;
  const Point target = target_of(action, from.target);
  for (std::uint32_t step = 1; step <= schedule_.steps; ++step) {
    const double share = double(step) / schedule_.steps;
    for (int k = 0; k < 3; ++k) {
      handle_.target[k] = std::lerp(from.target[k], target[k], share);
    }
    handle_.rotation = composed(from.rotation, {action.rotation.axis, share * action.rotation.degrees});
    pass(handle_);
  }
}

void Runner::pass(const commands::Drag& drag) {
  Trace trace;
  simulation_.set_trace(schedule_.trace ? &trace : nullptr);
  simulation_.apply(drag);
  simulation_.set_trace(nullptr);
  const Statistics& statistics = simulation_.statistics();
  const Handle& handle = *simulation_.last_handle();
  const auto elements = handle.elements();
  run_.passes.push_back({{elements.begin(), elements.end()},
                         drag.relative ? Point(handle.grabbed().pivot + drag.target) : drag.target,
                         drag.rotation,
                         statistics.last_pass.checked,
                         statistics.last_pass.moved,
                         statistics.last_pass_ms});
  if (statistics.last_pass.stopped) {
    run_.passes.back().stopped_at = handle.has_one()
                                        ? point_of(simulation_.mesh(), simulation_.body().positions(), elements[0])
                                        : handle.pose().pivot;
  }
  run_.passes.back().remark = statistics.remark;
  if (schedule_.trace) {
    run_.traces.push_back(std::move(trace));
  }
  simulation_.relax(static_cast<int>(schedule_.relax), schedule_.relax_step, schedule_.relax_until);
  progress_.advance();
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
  std::ranges::copy(coordinates, rotation.axis.begin());
  if (rotation.axis.isZero(0)) {
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

void check_actions(const std::vector<Action>& actions, const Mesh& mesh) { ActionChecker(mesh).check(actions); }

Run carry_out(Simulation& simulation, const std::vector<chainmail::Command>& moves, const std::vector<Action>& actions,
              const Schedule& schedule) {
  const auto drags = std::count_if(moves.begin(), moves.end(),
                                   [](const auto& one) { return std::holds_alternative<commands::Drag>(one); });
  const auto passes = std::count_if(actions.begin(), actions.end(), is_move) * schedule.steps + drags;
  Runner runner(simulation, schedule, static_cast<std::uint64_t>(passes));
  for (const chainmail::Command& command : moves) {
    runner.carry_out(command);
  }
  for (const Action& action : actions) {
    runner.carry_out(action);
  }
  return runner.take();
}

}  // namespace chainmail::command_line
