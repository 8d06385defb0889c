#pragma once

#include <cstdint>
#include <map>
#include <vector>

#include "simulate/command.h"

namespace chainmail {

/// The commands that lead to the current object from rest, without cuts and pins and with the default softness.
/// Settings of the solver (algorithm, relaxation) are not recorded.
///
/// The tape follows kept states: undo goes back to the position at which the state was kept. Later commands stay ahead,
/// until another command replaces them.
class Tape {
 public:
  /// Notes a command as it is sent.
  void note(const Command& command);

  /// Number of commands, including those ahead of the current position.
  std::size_t length() const { return timeline_.size(); }
  const Command& at(std::size_t i) const { return nodes_[timeline_[i]].command; }
  /// Number of commands that have been carried out.
  std::size_t position() const { return position_; }
  /// Sets the position, after the object was brought there.
  void go_to(std::size_t position) { position_ = position; }
  /// Replaces all commands; none of them is carried out yet.
  void load(const std::vector<Command>& commands);
  std::vector<Command> commands() const;
  /// Number of drags, and so of passes, among the first `commands` commands.
  std::size_t passes(std::size_t commands) const { return commands == 0 ? 0 : nodes_[timeline_[commands - 1]].passes; }
  /// Returns the last grab before the current position that was followed by a drag, with its drags; empty if there is
  /// none.
  std::vector<Command> last_drag() const;

  /// Changes when commands ahead of the object are replaced, or others are loaded.
  std::uint64_t timeline() const { return timeline_number_; }

  /// The state of the object without positions; cuts and pins are ascending.
  struct Object {
    std::vector<LinkId> cuts;
    std::vector<ElementId> pins;
    std::shared_ptr<const Softness> softness = std::make_shared<const Softness>();
  };
  /// Returns the object at the current position.
  Object object() const;

 private:
  using Node = std::uint32_t;  // into nodes_
  static constexpr Node none = ~Node{0};

  struct Entry {
    Command command;
    Node before;               // previous command; none for the beginning of a timeline, which is not a command
    std::uint32_t passes = 0;  // up to here
  };

  void add(const Command& command);
  void begin();
  void begin_mesh();
  void return_to(Node last);
  Node last() const { return position_ == 0 ? beginning_ : timeline_[position_ - 1]; }

  // All commands ever recorded, undone or not: commands after an undo form a branch.
  std::vector<Entry> nodes_{{{}, none, 0}};
  Node beginning_ = 0;          // of this object, or of the loaded commands
  std::vector<Node> timeline_;  // the current branch
  std::size_t position_ = 0;
  std::uint64_t timeline_number_ = 0;
  std::map<commands::StateId, Node> kept_;  // the last command before each state was kept
};

}  // namespace chainmail
