#pragma once

#include <cstdint>
#include <deque>
#include <map>
#include <span>
#include <vector>

#include "body/snapshot.h"
#include "simulate/command.h"

namespace chainmail {

/// Returns the mesh with which recorded commands begin, if one of them splits it; otherwise null.
MeshPointer first_mesh(const std::vector<Command>& commands);

/// Returns the mesh of the object after recorded commands that begin with `mesh`.
MeshPointer last_mesh(const MeshPointer& mesh, std::span<const Command> commands);
/// Returns the number of drags.
std::size_t count_drags(std::span<const Command> commands);

/// The recorded commands. They lead from an object at rest, without cuts and pins and with Softness(), to the current
/// object. Settings of the solver (algorithm, relaxation) are not recorded, but what relaxation did is.
/// RestoreState moves the position back to where the state was saved. Later commands stay until a new command replaces
/// them.
class MoveHistory {
 public:
  /// Records a command. Call this when the command is sent.
  void note(const Command& command);

  /// Returns the number of commands, including those after the current position.
  std::size_t length() const { return timeline_.size(); }
  const Command& at(std::size_t i) const { return nodes_[timeline_[i]].command; }
  /// Returns the current position: the number of commands that the object has run.
  std::size_t position() const { return position_; }
  /// Sets the current position. Call this after the object was brought to that state.
  void go_to(std::size_t position) { position_ = position; }
  /// Replaces all commands and sets the position to 0.
  void load(const std::vector<Command>& commands);
  std::vector<Command> commands() const;
  /// Returns the position after which an object begins its life: a first command that sets its softness is none of its
  /// moves.
  std::size_t start() const {
    return !timeline_.empty() && std::holds_alternative<commands::SetSoftness>(at(0)) ? 1 : 0;
  }
  /// Returns the number of passes (drags) among the first `commands` commands.
  std::size_t passes(std::size_t commands) const { return commands == 0 ? 0 : nodes_[timeline_[commands - 1]].passes; }
  /// True if the commands up to the current position grab elements and do not release them.
  bool holds() const { return nodes_[last()].holds; }
  /// Returns the last grab before the current position that has drags, with these drags; empty if there is none.
  std::vector<Command> last_drag() const;

  /// Returns the mesh with which the commands begin, if one of them splits it; otherwise null.
  MeshPointer first_mesh() const;

  /// Returns a number that changes when commands after the current position are replaced, or others are loaded.
  std::uint64_t timeline() const { return timeline_number_; }

  /// Returns the object at the current position. Its mesh is null if no command splits it: it is the same at all
  /// positions.
  ObjectState object() const { return object(position_); }
  /// Returns the object after the first `position` commands.
  ObjectState object(std::size_t position) const;

 private:
  using Node = std::uint32_t;  // index into nodes_
  static constexpr Node none = ~Node{0};

  struct Entry {
    Command command;
    Node before;               // previous command; none for the beginning of a timeline, which is not a command
    std::uint32_t passes = 0;  // number of passes up to this command
    bool holds = false;        // elements are grabbed after this command
  };

  void add(const Command& command);
  void begin();
  void begin_mesh(const Mesh& mesh);
  void return_to(Node last);
  void drop_unreachable();
  void keep_recent(MeshPointer mesh);
  Node last() const { return position_ == 0 ? beginning_ : timeline_[position_ - 1]; }

  // All commands that the timeline or a kept state may return to: commands after an undo form a branch.
  std::vector<Entry> nodes_{{{}, none, 0}};
  std::size_t reachable_ = 0;   // number of nodes after the last drop of unreachable ones
  Node beginning_ = 0;          // node before the first command of this object, or of the loaded commands
  std::vector<Node> timeline_;  // the current branch
  std::size_t position_ = 0;
  std::uint64_t timeline_number_ = 0;
  std::map<commands::StateId, Node> kept_;  // the last command before each state was saved
  // The meshes after the last splits, up to kept_size together: undo then need not make them again.
  static constexpr std::uint64_t kept_size = 10'000'000;  // see mesh_size(); about 25 bytes each
  std::deque<MeshPointer> recent_;
  std::uint64_t recent_size_ = 0;
};

}  // namespace chainmail
