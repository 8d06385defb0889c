#include "simulate/move_history.h"

#include <algorithm>
#include <set>

#include "body/snapshot.h"

namespace chainmail {
namespace {

constexpr std::size_t max_unreachable = 10'000;

/// Returns the mesh that a command splits; null for other commands.
MeshPointer mesh_before(const Command& command) {
  const auto* split = std::get_if<commands::Split>(&command);
  return split == nullptr ? nullptr : split->split->before();
}

}  // namespace

void MoveHistory::note(const Command& command) {
  using namespace commands;
  if (const auto* keep = std::get_if<KeepState>(&command)) {
    kept_[keep->state] = last();
  } else if (const auto* restore = std::get_if<RestoreState>(&command)) {
    if (const auto kept = kept_.find(restore->state);
        kept != kept_.end()) {  // otherwise the solver refuses the command
      return_to(kept->second);
    }
  } else if (const auto* drop = std::get_if<DropState>(&command)) {
    kept_.erase(drop->state);
  } else if (std::holds_alternative<ReplaceMesh>(command)) {
    begin_mesh(*std::get<ReplaceMesh>(command).mesh);
  } else if (!is_one_of<SetAlgorithm, SetRelaxation, SetElastic>(command)) {
    add(command);
    if (const auto* split = std::get_if<commands::Split>(&command)) {
      keep_recent(split->split->after());
    }
  }
}

void MoveHistory::keep_recent(MeshPointer mesh) {
  recent_size_ += mesh_size(*mesh);
  recent_.push_back(std::move(mesh));
  for (; recent_size_ > kept_size && recent_.size() > 1; recent_.pop_front()) {
    recent_size_ -= mesh_size(*recent_.front());
  }
}

void MoveHistory::add(const Command& command) {
  if (position_ < timeline_.size()) {
    timeline_.resize(position_);
    ++timeline_number_;
  }
  if (nodes_.size() > 2 * reachable_ + max_unreachable) {
    drop_unreachable();
  }
  const Node before = last();
  nodes_.push_back(
      {command, before, nodes_[before].passes + (is_one_of<commands::Drag>(command) ? 1U : 0U),
       is_one_of<commands::Grab>(command) || (nodes_[before].holds && !is_one_of<commands::Release>(command))});
  timeline_.push_back(static_cast<Node>(nodes_.size() - 1));
  ++position_;
}

void MoveHistory::begin() {
  timeline_.clear();
  position_ = 0;
  ++timeline_number_;
  recent_.clear();
  recent_size_ = 0;
  drop_unreachable();
  beginning_ = static_cast<Node>(nodes_.size());
  nodes_.push_back({{}, none, 0});
}

/// Drops commands to which neither the timeline nor a kept state returns.
void MoveHistory::drop_unreachable() {
  std::vector<bool> reachable(nodes_.size());
  const auto mark = [&](Node node) {
    for (; node != none && !reachable[node]; node = nodes_[node].before) {
      reachable[node] = true;
    }
  };
  mark(beginning_);
  std::ranges::for_each(timeline_, mark);
  for (const auto& [state, node] : kept_) {
    mark(node);
  }
  std::vector<Node> moved(nodes_.size(), none);
  Node count = 0;
  for (Node node = 0; node < nodes_.size(); ++node) {
    if (reachable[node]) {
      Entry entry = std::move(nodes_[node]);
      entry.before = entry.before == none ? none : moved[entry.before];
      moved[node] = count;
      nodes_[count++] = std::move(entry);
    }
  }
  nodes_.resize(count);
  reachable_ = count;
  beginning_ = moved[beginning_];
  std::ranges::transform(timeline_, timeline_.begin(), [&](Node node) { return moved[node]; });
  for (auto& [state, node] : kept_) {
    node = moved[node];
  }
}

/// Begins the timeline of a new object, which keeps the global softness, the kind of energy and the frame.
void MoveHistory::begin_mesh(const Mesh& mesh) {
  const auto before = object().softness;
  begin();
  if (const Softness kept = kept_for(mesh, *before); kept != Softness()) {
    add(commands::SetSoftness{kept});
  }
}

void MoveHistory::return_to(Node last) {
  std::vector<Node> way;
  Node node = last;
  for (; nodes_[node].before != none; node = nodes_[node].before) {
    way.push_back(node);
  }
  std::ranges::reverse(way);
  position_ = way.size();
  const bool is_behind = way.size() <= timeline_.size() && std::equal(way.begin(), way.end(), timeline_.begin());
  if (node != beginning_ || !is_behind) {
    beginning_ = node;
    timeline_ = std::move(way);
    ++timeline_number_;
  }
}

void MoveHistory::load(const std::vector<Command>& commands) {
  begin();
  for (const Command& command : commands) {
    add(command);
  }
  position_ = 0;
}

std::vector<Command> MoveHistory::commands() const {
  std::vector<Command> all;
  for (const Node node : timeline_) {
    all.push_back(nodes_[node].command);
  }
  return all;
}

std::vector<Command> MoveHistory::last_drag() const {
  std::vector<Command> drag;
  for (std::size_t i = position_; i > 0; --i) {
    const bool is_grab = is_one_of<commands::Grab>(at(i - 1));
    if (is_one_of<commands::Drag>(at(i - 1)) || (is_grab && !drag.empty())) {
      drag.push_back(at(i - 1));
    }
    if (is_grab && !drag.empty()) {
      break;
    }
  }
  return {drag.rbegin(), drag.rend()};
}

MeshPointer first_mesh(const std::vector<Command>& commands) {
  for (const Command& command : commands) {
    if (auto mesh = mesh_before(command)) {
      return mesh;
    }
  }
  return nullptr;
}

MeshPointer last_mesh(const MeshPointer& mesh, std::span<const Command> commands) {
  for (std::size_t i = commands.size(); i > 0; --i) {
    if (const auto* split = std::get_if<commands::Split>(&commands[i - 1])) {
      return split->split->after();
    }
  }
  return mesh;
}

std::size_t count_drags(std::span<const Command> commands) {
  return std::size_t(std::ranges::count_if(
      commands, [](const Command& command) { return std::holds_alternative<commands::Drag>(command); }));
}

MeshPointer MoveHistory::first_mesh() const {
  MeshPointer first;
  for (std::size_t i = 0; i < length() && !first; ++i) {
    first = mesh_before(at(i));
  }
  return first;
}

ObjectState MoveHistory::object(std::size_t position) const {
  std::set<LinkId> cuts;
  std::set<ElementId> pins;
  ObjectState object;
  const auto toggle = [](auto& all, const auto& some, bool add) {
    for (const auto one : some) {
      add ? void(all.insert(one)) : void(all.erase(one));
    }
  };
  SplitPointer last;
  MeshPointer kept;  // of the last split, so that the next one need not make it again
  for (std::size_t i = 0; i < position; ++i) {
    const Command& command = at(i);
    if (const auto* cut = std::get_if<commands::Cut>(&command)) {
      toggle(cuts, cut->links, true);
    } else if (const auto* uncut = std::get_if<commands::Uncut>(&command)) {
      toggle(cuts, uncut->links, false);
    } else if (const auto* pin = std::get_if<commands::Pin>(&command)) {
      toggle(pins, pin->elements, true);
    } else if (const auto* unpin = std::get_if<commands::Unpin>(&command)) {
      toggle(pins, unpin->elements, false);
    } else if (const auto* softness = std::get_if<commands::SetSoftness>(&command)) {
      object.softness = softness->softness;
    } else if (const auto* split = std::get_if<commands::Split>(&command)) {
      object.cuts.assign(cuts.begin(), cuts.end());
      object.pins.assign(pins.begin(), pins.end());
      last = split->split;
      kept = object.cuts.empty() && object.softness->links.empty() ? nullptr : last->after();
      object = meshless_after(*last, object);
      cuts = {object.cuts.begin(), object.cuts.end()};
      pins = {object.pins.begin(), object.pins.end()};
    }
  }
  object.mesh = last ? last->after() : first_mesh();
  object.cuts.assign(cuts.begin(), cuts.end());
  object.pins.assign(pins.begin(), pins.end());
  return object;
}

}  // namespace chainmail
