#pragma once

#include <algorithm>
#include <array>
#include <filesystem>
#include <functional>
#include <iterator>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

#include "files/session/object_json.h"
#include "files/text/described_json.h"
#include "simulate/command.h"

namespace chainmail {

// The members of each command with a name. Reading, writing and schemas follow from this list: `Io` is MovesReader,
// MovesWriter, PackedKeys or schema::CommandMembers, which have a function for each kind of member.

void members(auto& io, commands::Grab& one) {
  if (io.has("elements", one.elements.size() != 1)) {
    io.elements("elements", one.elements);
  } else {
    io.element("element", one.elements.front());
  }
}
void members(auto& io, commands::Drag& one) {
  const bool is_turned = io.has("rotate", one.rotation.degrees != 0);
  one.relative = io.has("by", one.relative) || (is_turned && !io.has("target", !one.relative));
  if (!one.relative) {
    io.point("target", one.target, "target of the handle's pivot (mesh units)");
  } else if (io.has("by", true)) {
    io.point("by", one.target, "displacement of the pivot since it was grabbed (mesh units)");
  }
  if (is_turned) {
    io.rotation("rotate", one.rotation, "rotation since it was grabbed");
  }
}
void members(auto& /*io*/, commands::Release& /*one*/) {}
void members(auto& io, commands::Cut& one) { io.links("links", one.links); }
void members(auto& io, commands::Uncut& one) { io.links("links", one.links); }
void members(auto& io, commands::Pin& one) { io.elements("elements", one.elements); }
void members(auto& io, commands::Unpin& one) { io.elements("elements", one.elements); }
void members(auto& io, commands::SetSoftness& one) { io.softness("links", one.softness); }
void members(auto& /*io*/, commands::Reset& /*one*/) {}
void members(auto& io, commands::Relax& one) { io.described(one); }
void members(auto& io, commands::Relaxed& one) {
  io.described(one);
  io.counts("panels", "slices", one.counts);
}
void members(auto& io, SplitEdit& edit) {
  io.points("elements", edit.elements);
  io.numbers("removed", edit.removed, "indices of the triangles that go");
  io.groups("triangles", edit.triangles, "corners of the new triangles");
  io.numbers("removed_polygons", edit.removed_polygons, "indices of the polygons that go");
  io.numbers("polygons", edit.polygons, "the new polygons: a count, then as many ids, for each");
  io.numbers("removed_cells", edit.removed_cells, "indices of the cells that go, the tetrahedra first");
  io.groups("tetrahedra", edit.tetrahedra, "corners of the new tetrahedra");
  io.groups("hexahedra", edit.hexahedra, "corners of the new hexahedra");
}
void members(auto& io, commands::Split& one) { io.split(one.split); }

/// Collects the keys of long arrays, which are read without a tree.
class PackedKeys {
 public:
  template <class... Kinds>
  explicit PackedKeys(std::type_identity<std::variant<Kinds...>> /*commands*/) {
    (add_named<Kinds>(), ...);
  }
  std::span<const PackedKey> all() const { return keys_; }

  // The kinds of members.
  /// All members that are only there in one case are in the case of yes.
  static bool has(const char* /*key*/, bool /*is_written*/) { return true; }
  void element(const char* /*key*/, ElementId /*one*/) {}
  void elements(const char* key, const auto& /*all*/) { add(key, 1); }
  void links(const char* key, const auto& /*all*/) { add(key, 2); }
  void point(const char* /*key*/, const Point& /*one*/, std::string_view /*help*/) {}
  void rotation(const char* /*key*/, const Rotation& /*one*/, std::string_view /*help*/) {}
  void numbers(const char* key, const auto& /*all*/, std::string_view /*help*/) { add(key, 1); }
  template <std::size_t Size>
  void groups(const char* key, const std::vector<std::array<ElementId, Size>>& /*all*/, std::string_view /*help*/) {
    add(key, Size);
  }
  void points(const char* key, const auto& /*all*/) { add(key, 3); }
  void split(const SplitPointer& /*split*/) {
    SplitEdit edit;
    members(*this, edit);
  }
  void softness(const char* key, const auto& /*softness*/) { add(key, 2); }
  void counts(const char* /*panels*/, const char* slices, const auto& /*counts*/) { add(slices, 1); }
  void described(const auto& /*one*/) {}

 private:
  template <class Kind>
  void add_named() {
    if constexpr (requires { Kind::name; }) {
      Kind one;
      members(*this, one);
    }
  }
  /// Adds a key. Of each item, the first `ids` numbers are whole; several commands may have arrays with this key.
  void add(std::string_view key, std::size_t ids) {
    const auto known = std::ranges::find(keys_, key, &PackedKey::key);
    if (known == keys_.end()) {
      keys_.push_back({key, ids});
    } else {
      known->ids = std::max(known->ids, ids);
    }
  }

  std::vector<PackedKey> keys_;
};

/// Reads commands and checks one after another, as a simulation would execute them from rest.
class MovesReader {
 public:
  MovesReader(const std::string& where, MeshPointer mesh, EnergyKind absent_energy)
      : where_(where), fields_(where, &json_.arrays), mesh_(std::move(mesh)), absent_energy_(absent_energy) {}
  MovesReader(const MovesReader&) = delete;
  MovesReader& operator=(const MovesReader&) = delete;

  /// Returns commands of the kinds of a variant that have a name.
  template <class Commands>
  std::vector<Commands> read(std::string_view text, const std::filesystem::path& path, const Progress& progress) {
    std::vector<Commands> commands;
    const PackedKeys packed{std::type_identity<Commands>()};
    scan(
        text, path, packed.all(), [&] { add_command(commands); }, progress);
    return commands;
  }

  // The kinds of members.
  bool has(const char* key, bool /*is_written*/) const { return of_->contains(key); }
  void element(const char* key, ElementId& one);
  void elements(const char* key, std::vector<ElementId>& all);
  void links(const char* key, std::vector<LinkId>& all);
  void point(const char* key, Point& one, std::string_view help);
  void rotation(const char* key, Rotation& one, std::string_view help);
  void numbers(const char* key, std::vector<std::uint32_t>& all, std::string_view help);
  template <std::size_t Size>
  void groups(const char* key, std::vector<std::array<ElementId, Size>>& all, std::string_view /*help*/) {
    if (has(key, true)) {
      all = fields_.groups<Size>(fields_.packed(with(key), key, {Size}).ids, key);
    }
  }
  void points(const char* key, std::vector<SplitPoint>& all);
  void split(SplitPointer& split);
  void softness(const char* key, std::shared_ptr<const Softness>& softness);
  void counts(const char* panels, const char* slices, std::shared_ptr<const commands::SliceCounts>& counts);
  template <class Kind>
  void described(Kind& one) {
    std::ranges::move(keys_of<Kind>(), std::back_inserter(keys_));
    one = read_members<Kind>(fields_, *of_);
  }

 private:
  using Json = nlohmann::json;

  /// Calls `add` for each command, which is `of_` then.
  void scan(std::string_view text, const std::filesystem::path& path, std::span<const PackedKey> packed,
            const std::function<void()>& add, const Progress& progress);
  void check_head() const;
  void take(const Json& command, const std::function<void()>& add);
  /// Returns the command, of which this key is known.
  const Json& with(const char* key);
  template <class... Kinds>
  void add_command(std::vector<std::variant<Kinds...>>& commands) {
    const Json& name = fields_.member(*of_, "do");
    const std::string_view given = name.is_string() ? *name.get_ptr<const std::string*>() : std::string_view();
    std::vector<std::string_view> names;
    if (!(add_if_named<Kinds>(given, commands, names) || ...)) {
      fields_.choice(name, "do", names);  // throws
    }
  }
  /// Adds the command if it is of this kind, and returns true then. `names` are those that it is not.
  template <class Kind>
  bool add_if_named(std::string_view name, auto& commands, std::vector<std::string_view>& names) {
    if constexpr (requires { Kind::name; }) {
      if (name == Kind::name) {
        Kind one;
        keys_ = {"do"};
        members(*this, one);
        fields_.check_keys(*of_, keys_);
        follow(one);
        commands.push_back(std::move(one));
        return true;
      }
      names.push_back(Kind::name);
    }
    return false;
  }
  // The rules of each command, and what it changes in the state.
  void follow(const auto& /*one*/) {}
  void follow(const commands::Grab& one);
  void follow(const commands::Drag& one);
  void follow(const commands::Release& /*one*/) { grabbed_.clear(); }
  void follow(const commands::Pin& one);
  void follow(const commands::Unpin& one);
  void follow(const commands::Relax& one);
  void check_split_parts(std::uint64_t parts) const;

  std::string where_;
  PackedJson json_;
  ObjectFields fields_;  // of the file, then of each command
  const Json* of_ = nullptr;
  std::vector<std::string> keys_;        // of the command that are known
  MeshPointer mesh_;                     // of the commands from now on
  std::optional<RegionAxes> principal_;  // principal axes of the mesh, once they are needed
  EnergyKind absent_energy_;             // of a softness that does not say it
  std::size_t commands_ = 0;             // number of those before
  std::optional<Error> fault_;           // of the first wrong command; errors of the whole file are reported first
  // The state that the simulation would be in.
  std::set<ElementId> grabbed_;
  std::set<ElementId> pinned_;
  std::uint64_t split_parts_ = 0;  // of the meshes after all splits
};

/// Writes commands as JSON.
class MovesWriter {
 public:
  using Json = nlohmann::ordered_json;

  /// The commands begin with this mesh, which must exist as long.
  explicit MovesWriter(const Mesh& mesh) : mesh_(&mesh) {}

  /// Returns a command as JSON, or null for a command that is left out.
  template <class Kind>
  Json operator()(Kind one) {
    if constexpr (requires { Kind::name; }) {
      json_ = {{"do", Kind::name}};
      members(*this, one);
      return std::move(json_);
    } else if (is_one_of<commands::ReplaceMesh, commands::SetPositions, commands::RestoreState>(one)) {
      throw Error("moves", "the object was replaced, or moves were undone, while they were recorded",
                  "record them on one object without undo");
    } else {
      return {};
    }
  }

  // The kinds of members.
  static bool has(const char* /*key*/, bool is_written) { return is_written; }
  void element(const char* key, ElementId one) { json_[key] = one; }
  void elements(const char* key, const std::vector<ElementId>& all) { json_[key] = all; }
  void links(const char* key, const std::vector<LinkId>& all);
  void point(const char* key, const Point& one, std::string_view help);
  void rotation(const char* key, const Rotation& one, std::string_view help);
  void numbers(const char* key, const auto& all, std::string_view /*help*/) {
    if (!all.empty()) {
      json_[key] = all;
    }
  }
  void groups(const char* key, const auto& all, std::string_view help) { numbers(key, all, help); }
  void points(const char* key, const std::vector<SplitPoint>& all);
  void split(const SplitPointer& split);
  void softness(const char* key, const std::shared_ptr<const Softness>& softness);
  void counts(const char* panels, const char* slices, const std::shared_ptr<const commands::SliceCounts>& counts);
  void described(const auto& one) { add_members(json_, one); }

 private:
  const Mesh& mesh();

  const Mesh* mesh_;
  MeshPointer after_split_;  // keeps mesh_
  SplitPointer split_;       // the last one; null if mesh_ is the mesh after it
  Json json_;
};

}  // namespace chainmail
