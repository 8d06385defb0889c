#pragma once

#include <cstdint>
#include <map>
#include <vector>

#include "simulate/command.h"

namespace chainmail {

/// What was done to an object since it was at rest, whole and with the default softness: the commands that do it again.
/// What is not the object's but the solver's (the algorithm, relaxation's settings) is left out.
///
/// It follows kept states: undo goes back to where the state was kept, and what was done after that still stands ahead,
/// until something else is done.
class Tape {
 public:
  /// Notes a command as it is sent.
  void note(const Command& command);

  /// How many commands there are, those ahead of where the object stands too.
  std::size_t length() const { return timeline_.size(); }
  const Command& at(std::size_t i) const { return nodes_[timeline_[i]].command; }
  /// How many of them have been carried out.
  std::size_t position() const { return position_; }
  /// The object was brought to where it stands after this many commands.
  void go_to(std::size_t position) { position_ = position; }
  /// Other commands, none of them carried out yet.
  void load(const std::vector<Command>& commands);
  std::vector<Command> commands() const;
  /// How many of the first so many commands are drags, and with them passes.
  std::size_t passes(std::size_t commands) const { return commands == 0 ? 0 : nodes_[timeline_[commands - 1]].passes; }
  /// The last grab before where the object stands that was followed by a drag, and its drags; empty where there is
  /// none.
  std::vector<Command> last_drag() const;

  /// Changes when commands ahead of the object are replaced, or others are loaded.
  std::uint64_t timeline() const { return timeline_number_; }

  /// What the commands make of an object, its positions apart; cuts and pins ascending.
  struct Object {
    std::vector<LinkId> cuts;
    std::vector<ElementId> pins;
    std::shared_ptr<const Softness> softness = std::make_shared<const Softness>();
  };
  /// The object where it stands.
  Object object() const;

 private:
  using Node = std::uint32_t;  // into nodes_
  static constexpr Node none = ~Node{0};

  struct Entry {
    Command command;
    Node before;               // what was done before it; none for the beginning of a timeline, which is no command
    std::uint32_t passes = 0;  // up to here
  };

  void add(const Command& command);
  void begin();
  void begin_mesh();
  void return_to(Node last);
  Node last() const { return position_ == 0 ? beginning_ : timeline_[position_ - 1]; }

  // All that was ever done, undone or not: what follows after an undo is a branch.
  std::vector<Entry> nodes_{{{}, none, 0}};
  Node beginning_ = 0;          // of this object, or of what was loaded
  std::vector<Node> timeline_;  // the branch that is looked at
  std::size_t position_ = 0;
  std::uint64_t timeline_number_ = 0;
  std::map<commands::StateId, Node> kept_;  // the last command before each state was kept
};

}  // namespace chainmail
