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
class PassCount {
 public:
  explicit PassCount(std::uint64_t total) : total_(total) {}

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

/// Returns the elements that an act pins.
std::vector<ElementId> pins_of(const Act& act, const Mesh& mesh) {
  if (act.layer.empty()) {
    return {act.element};
  }
  const auto pins = pins_by_name(act.where, act.layer, mesh);
  if (!pins) {
    throw Error(act.where, in_quotes(act.layer) + " is not an element's id",
                "use a whole number from 0, or " + pin_names());
  }
  return *pins;
}

void check_element(const Act& act, ElementId element, const Mesh& mesh) {
  if (element >= mesh.element_count()) {
    throw Error(act.where, "there is no element " + std::to_string(element),
                "use an id from 0 to " + std::to_string(mesh.element_count() - 1));
  }
}

void check_axes(const Act& act, const Mesh& mesh) {
  for (int k = 0; k < static_cast<int>(act.coordinates.size()); ++k) {
    const bool carried = std::find(mesh.axes.begin(), mesh.axes.begin() + mesh.space_dimension, k) !=
                         mesh.axes.begin() + mesh.space_dimension;
    const double coordinate = act.coordinates[k];
    const bool stays = coordinate == 0 || (act.kind == Act::Kind::move && coordinate == mesh.origin[k]);
    if (!carried && !stays) {
      const std::string axis(1, "xyz"[k]);
      throw Error(act.where, "the object does not extend along " + axis,
                  "write 0 for " + axis + ", or use more dimensions with --space");
    }
  }
}

void check_link(const Act& act, const Mesh& mesh) {
  check_element(act, act.other, mesh);
  if (!find_link(mesh, act.element, act.other)) {
    throw Error(act.where, "these elements are not linked", "use the ids of the two ends of a link");
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

bool is_move(const Act& act) { return act.kind == Act::Kind::move || act.kind == Act::Kind::by; }

class Runner {
 public:
  Runner(Simulation& simulation, const Schedule& schedule, std::uint64_t passes)
      : simulation_(simulation), schedule_(schedule), progress_(passes) {}

  void carry_out(const chainmail::Command& command) {
    if (const auto* drag = std::get_if<commands::Drag>(&command)) {
      pass(*simulation_.grabbed(), drag->target);
    } else {
      simulation_.apply(command);
    }
  }

  void carry_out(const Act& act) {
    if (act.kind == Act::Kind::cut) {
      simulation_.apply(commands::Cut{{*find_link(simulation_.mesh(), act.element, act.other)}});
    } else if (act.kind == Act::Kind::pin) {
      simulation_.apply(commands::Pin{pins_of(act, simulation_.mesh())});
    } else {
      try {
        move(act);
      } catch (const Error& error) {
        throw error.at(act.where + ": " + error.where());
      }
    }
  }
  Run take() { return std::move(run_); }

 private:
  Point target_of(const Act& act, const Point& start) const;
  void move(const Act& act);
  void pass(ElementId element, const Point& target);

  Simulation& simulation_;
  const Schedule& schedule_;
  PassCount progress_;
  Run run_;
};

Point Runner::target_of(const Act& act, const Point& start) const {
  Point target = start;
  for (int i = 0; i < simulation_.mesh().space_dimension; ++i) {
    const int k = simulation_.mesh().axes[i];
    if (k < static_cast<int>(act.coordinates.size())) {
      target[k] = act.kind == Act::Kind::by ? start[k] + act.coordinates[k] : act.coordinates[k];
    }
  }
  return target;
}

void Runner::move(const Act& act) {
  const Point start = point_of(simulation_.mesh(), simulation_.body().positions(), act.element);
  const Point target = target_of(act, start);
  simulation_.apply(commands::Grab{act.element});
  for (std::uint32_t step = 1; step <= schedule_.steps; ++step) {
    Point between;
    for (int k = 0; k < 3; ++k) {
      // std::lerp ends exactly at the target, and does not overflow.
      between[k] = std::lerp(start[k], target[k], double(step) / schedule_.steps);
    }
    pass(act.element, between);
  }
  simulation_.apply(commands::Release{});
}

void Runner::pass(ElementId element, const Point& target) {
  Trace trace;
  simulation_.set_trace(schedule_.trace ? &trace : nullptr);
  simulation_.apply(commands::Drag{target});
  simulation_.set_trace(nullptr);
  const Statistics& statistics = simulation_.statistics();
  run_.passes.push_back(
      {element, target, statistics.last_pass.checked, statistics.last_pass.moved, statistics.last_pass_ms});
  if (statistics.last_pass.stopped) {
    run_.passes.back().stopped_at = point_of(simulation_.mesh(), simulation_.body().positions(), element);
  }
  run_.passes.back().remark = statistics.remark;
  if (schedule_.trace) {
    run_.traces.push_back(std::move(trace));
  }
  simulation_.relax(static_cast<int>(schedule_.relax), schedule_.relax_step);
  progress_.advance();
}

}  // namespace

Act parse_act(Act::Kind kind, const std::string& option, const std::string& text) {
  Act act{kind, option + " " + text, 0, 0, {}, {}};
  if (kind == Act::Kind::pin) {
    if (text.find_first_of("0123456789") == 0) {
      act.element = parse_id(act.where, text);
    } else {
      act.layer = text;
    }
    return act;
  }
  const bool is_cut = kind == Act::Kind::cut;
  const std::size_t mark = text.find(is_cut ? '-' : ':');
  if (mark == std::string::npos) {
    throw Error(act.where, is_cut ? "it does not name a link" : "it does not name a target",
                is_cut ? "write A-B with the ids of the two ends" : "write ID:X[,Y[,Z]]");
  }
  act.element = parse_id(act.where, std::string_view(text).substr(0, mark));
  const std::string_view rest = std::string_view(text).substr(mark + 1);
  if (is_cut) {
    act.other = parse_id(act.where, rest);
  } else {
    act.coordinates = parse_coordinates(act.where, rest);
  }
  return act;
}

void check_acts(const std::vector<Act>& acts, const Mesh& mesh) {
  std::set<ElementId> pinned;
  for (const Act& act : acts) {
    check_element(act, act.element, mesh);
    switch (act.kind) {
      case Act::Kind::cut:
        check_link(act, mesh);
        break;
      case Act::Kind::pin:
        for (const ElementId pin : pins_of(act, mesh)) {
          pinned.insert(pin);
        }
        break;
      case Act::Kind::move:
      case Act::Kind::by:
        check_axes(act, mesh);
        if (pinned.contains(act.element)) {
          throw Error(act.where, "element " + std::to_string(act.element) + " is pinned by then and cannot move",
                      "move another element, or pin it later");
        }
        break;
    }
  }
}

Run carry_out(Simulation& simulation, const std::vector<chainmail::Command>& moves, const std::vector<Act>& acts,
              const Schedule& schedule) {
  const auto drags = std::count_if(moves.begin(), moves.end(),
                                   [](const auto& one) { return std::holds_alternative<commands::Drag>(one); });
  const auto passes = std::count_if(acts.begin(), acts.end(), is_move) * schedule.steps + drags;
  Runner runner(simulation, schedule, static_cast<std::uint64_t>(passes));
  for (const chainmail::Command& command : moves) {
    runner.carry_out(command);
  }
  for (const Act& act : acts) {
    runner.carry_out(act);
  }
  return runner.take();
}

}  // namespace chainmail::command_line
