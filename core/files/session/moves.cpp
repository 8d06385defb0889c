#include "files/session/moves.h"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <optional>
#include <set>
#include <string>
#include <type_traits>
#include <variant>

#include "files/session/object_json.h"
#include "files/text/described_json.h"
#include "files/text/limits.h"
#include "files/text/text.h"
#include "mesh/error.h"
#include "simulate/move_history.h"

namespace chainmail {
namespace {

using Json = nlohmann::json;
using OrderedJson = nlohmann::ordered_json;

// The second version knows `split`, the third `relaxed`.
constexpr std::uint64_t first_version = 1, split_version = 2, relaxed_version = newest_moves_version;
// Numbers in the row of a link: its ends and its softness, without or with the numbers of its energy.
constexpr std::size_t short_row = 2 + region_numbers, long_row = 2 + softness_numbers.size();

// The members of each command. `Io` is MovesReader or MovesWriter, which have a function for each kind of member.

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
  if (!one.relative || io.has("by", true)) {
    io.point(one.relative ? "by" : "target", one.target);
  }
  if (is_turned) {
    io.rotation("rotate", one.rotation);
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
  io.numbers("removed", edit.removed);
  io.triangles("triangles", edit.triangles);
  io.numbers("removed_polygons", edit.removed_polygons);
  io.numbers("polygons", edit.polygons);
}
void members(auto& io, commands::Split& one) { io.split(one.split); }

/// Checks commands one after another, as a simulation would execute them from rest.
class MovesReader {
 public:
  MovesReader(const std::string& where, MeshPointer mesh, EnergyKind absent_energy)
      : where_(where), fields_(where, &json_.arrays), mesh_(std::move(mesh)), absent_energy_(absent_energy) {}

  std::vector<Command> read(std::string_view text, const std::filesystem::path& path, const Progress& progress) {
    // A split costs at least as much as the mesh before all of them.
    static constexpr std::string_view name = "\"split\"";
    std::uint64_t splits = 0;
    for (std::size_t at = text.find(name); at != std::string_view::npos; at = text.find(name, at + name.size())) {
      ++splits;
    }
    check_split_parts(splits * split_parts_of(*mesh_));
    static constexpr std::array packed{
        PackedKey{"links", 2},    PackedKey{"elements", 3},         PackedKey{"removed", 1}, PackedKey{"triangles", 3},
        PackedKey{"polygons", 1}, PackedKey{"removed_polygons", 1}, PackedKey{"slices", 1}};
    scan_json(text, path, where_,
              {.content = "recorded moves",
               .packed = packed,
               .items = "commands",
               .item = ": command ",
               .take = [this](const Json& command) { take(command); }},
              json_, progress);
    fields_.say_at(where_);
    check_head();
    if (fault_) {
      throw Error(*fault_);
    }
    return std::move(commands_);
  }

  // The kinds of members.
  bool has(const char* key, bool /*is_written*/) const { return of_->contains(key); }
  void element(const char* key, ElementId& one) {
    const Json& json = fields_.member(with(key), key);
    if (!json.is_number_unsigned()) {
      fields_.fail(in_quotes(text_of(json)) + " is not an element's id", "ids are whole numbers from 0");
    }
    fields_.check_element(json.get<std::uint64_t>(), mesh_->element_count(), key);
    one = json.get<ElementId>();
  }
  void elements(const char* key, std::vector<ElementId>& all) {
    all = fields_.elements(with(key), key, mesh_->element_count()).ids;
  }
  void links(const char* key, std::vector<LinkId>& all) {
    const auto& ends = fields_.elements(with(key), key, mesh_->element_count(), {2}).ids;
    for (std::size_t i = 0; i < ends.size(); i += 2) {
      all.push_back(fields_.link(*mesh_, ends[i], ends[i + 1]));
    }
  }
  void point(const char* key, Point& one) { one = fields_.point(with(key), key); }
  void rotation(const char* key, Rotation& one) {
    const Json& rotate = fields_.object(with(key), key);
    fields_.check_keys(rotate, {"axis", "degrees"});
    one = {fields_.point(rotate, "axis"), fields_.number(fields_.member(rotate, "degrees"))};
    fields_.here([&] { check(one, *mesh_); });
  }
  void numbers(const char* key, std::vector<std::uint32_t>& all) {
    if (has(key, true)) {
      all = fields_.packed(with(key), key).ids;
    }
  }
  void triangles(const char* key, std::vector<std::array<ElementId, 3>>& all) {
    if (has(key, true)) {
      all = fields_.groups<3>(fields_.packed(with(key), key, {3}).ids, key);
    }
  }
  void points(const char* key, std::vector<SplitPoint>& all) {
    const PackedArray& rows = fields_.packed(with(key), key, {5});
    for (std::size_t i = 0; i < rows.size; ++i) {
      const auto* of = &rows.ids[3 * i];
      all.push_back({{of[0], of[1], of[2]}, {rows.reals[2 * i], rows.reals[2 * i + 1]}});
    }
  }
  void split(SplitPointer& split) {
    SplitEdit edit;
    members(*this, edit);
    split_parts_ += split_parts_of(*mesh_) + edit.elements.size();
    check_split_parts(split_parts_);
    split = fields_.here([&] { return make_split(mesh_, std::move(edit)); });
    const auto pins = pins_after(*split, std::vector(pinned_.begin(), pinned_.end()));
    pinned_ = {pins.begin(), pins.end()};
    grabbed_.clear();
    mesh_ = split->after;
    principal_.reset();
  }
  void softness(const char* key, std::shared_ptr<const Softness>& softness) {
    keys_ = softness_keys({"do", key});
    Softness result = fields_.softness(*of_, *mesh_, absent_energy_, principal_);
    if (has(key, true)) {
      const PackedArray& rows = fields_.elements(*of_, key, mesh_->element_count(), {short_row, long_row});
      fields_.add_own(result.links, *mesh_, rows.ids, rows.reals);
    }
    softness = std::make_shared<const Softness>(std::move(result));
  }
  void counts(const char* panels, const char* slices, std::shared_ptr<const commands::SliceCounts>& counts) {
    const Json& names = fields_.array(with(panels), panels);
    const auto& numbers = fields_.packed(with(slices), slices).ids;
    if (numbers.empty() || numbers.size() > limits::session_panels || names.size() != numbers.size()) {
      fields_.fail("'panels' and 'slices' do not have one item for each panel",
                   "write 1 to " + std::to_string(limits::session_panels) + " of each");
    }
    const auto noted = std::make_shared<commands::SliceCounts>(numbers.size());
    for (std::size_t i = 0; i < numbers.size(); ++i) {
      noted->note(i, fields_.algorithm(names[i]), numbers[i]);
    }
    counts = noted;
  }
  template <class Kind>
  void described(Kind& one) {
    std::ranges::move(keys_of<Kind>(), std::back_inserter(keys_));
    one = read_members<Kind>(fields_, *of_);
  }

 private:
  /// Returns the command, of which this key is known.
  const Json& with(const char* key) {
    keys_.emplace_back(key);
    return *of_;
  }
  void check_head() const {
    if (!json_.tree.is_object()) {
      fields_.fail("it contains no recorded moves", "use a file of recorded moves");
    }
    fields_.version(json_.tree, relaxed_version);
    fields_.check_keys(json_.tree, {"version", "commands"});
    fields_.array(json_.tree, "commands");
  }
  void take(const Json& command) {
    if (fault_) {
      return;
    }
    fields_.say_at(where_ + ": command " + std::to_string(commands_.size()));
    of_ = &command;
    try {
      add_command();
    } catch (const Error& error) {
      fault_ = error;
    }
  }
  void add_command() {
    if (!of_->is_object()) {
      fields_.fail("it is not an object", "write {\"do\": …}");
    }
    if (commands_.size() == limits::moves) {
      fields_.fail("there are more than " + std::to_string(limits::moves) + " commands", "use fewer moves");
    }
    const Json& name = fields_.member(*of_, "do");
    std::vector<std::string_view> names;
    if (!add_named(name.is_string() ? name.get<std::string>() : "", names, std::type_identity<Command>())) {
      fields_.choice(name, "do", names);  // throws
    }
  }
  /// Adds the command of this name, and returns true if there is one. `names` are those that it is not.
  template <class... Kinds>
  bool add_named(const std::string& name, std::vector<std::string_view>& names,
                 std::type_identity<std::variant<Kinds...>> /*all*/) {
    return (add_if_named<Kinds>(name, names) || ...);
  }
  template <class Kind>
  bool add_if_named(const std::string& name, std::vector<std::string_view>& names) {
    if constexpr (requires { Kind::name; }) {
      if (name == Kind::name) {
        Kind one;
        keys_ = {"do"};
        members(*this, one);
        fields_.check_keys(*of_, keys_);
        follow(one);
        commands_.push_back(std::move(one));
        return true;
      }
      names.push_back(Kind::name);
    }
    return false;
  }
  // The rules of each command, and what it changes in the state.
  void follow(const auto& /*one*/) {}
  void follow(const commands::Grab& one) {
    grabbed_.clear();
    for (const ElementId element : one.elements) {
      if (pinned_.contains(element)) {
        fields_.fail("element " + std::to_string(element) + " is pinned at that time and cannot move",
                     "unpin it first");
      }
      if (!grabbed_.insert(element).second) {
        fields_.fail("element " + std::to_string(element) + " is grabbed twice",
                     "name each element of the handle once");
      }
    }
    if (grabbed_.empty()) {
      fields_.fail("the handle has no elements", "grab at least one element");
    }
  }
  void follow(const commands::Drag& /*one*/) {
    if (grabbed_.empty()) {
      fields_.fail("no element is grabbed at that time", "grab an element first");
    }
  }
  void follow(const commands::Release& /*one*/) { grabbed_.clear(); }
  void follow(const commands::Pin& one) {
    for (const ElementId element : one.elements) {
      if (grabbed_.contains(element)) {
        fields_.fail("element " + std::to_string(element) + " is grabbed at that time", "release it first");
      }
    }
    pinned_.insert(one.elements.begin(), one.elements.end());
  }
  void follow(const commands::Unpin& one) {
    for (const ElementId element : one.elements) {
      pinned_.erase(element);
    }
  }
  void follow(const commands::Relax& one) {
    if (one.until > 0 && info(one.scheme).sweeps) {
      fields_.fail("'until' works only with the scheme equilibrium", "leave it out, or choose this scheme");
    }
  }
  void check_split_parts(std::uint64_t parts) const {
    if (parts > limits::split_parts) {
      fields_.fail("the meshes after all splits have more than " + std::to_string(limits::split_parts) +
                       " elements, links and triangles",
                   "use fewer splits, or a smaller object");
    }
  }

  std::string where_;
  PackedJson json_;
  ObjectFields fields_;  // of the file, then of each command
  const Json* of_ = nullptr;
  std::vector<std::string> keys_;        // of the command that are known
  MeshPointer mesh_;                     // of the commands from now on
  std::optional<RegionAxes> principal_;  // principal axes of the mesh, once they are needed
  EnergyKind absent_energy_;             // of a softness that does not say it
  std::vector<Command> commands_;
  std::optional<Error> fault_;  // of the first wrong command; errors of the whole file are reported first
  // The state that the simulation would be in.
  std::set<ElementId> grabbed_;
  std::set<ElementId> pinned_;
  std::uint64_t split_parts_ = 0;  // of the meshes after all splits
};

/// Writes commands as JSON.
class MovesWriter {
 public:
  /// The commands begin with this mesh.
  explicit MovesWriter(const Mesh& mesh) : mesh_(&mesh) {}

  /// Returns a command as JSON, or null for a command that is left out.
  template <class Kind>
  OrderedJson operator()(Kind one) {
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
  void links(const char* key, const std::vector<LinkId>& all) {
    json_[key] = OrderedJson::array();
    for (const LinkId link : all) {
      json_[key].push_back(mesh_->links[link]);
    }
  }
  void point(const char* key, const Point& one) { json_[key] = {one.x(), one.y(), one.z()}; }
  void rotation(const char* key, const Rotation& one) {
    json_[key] = {{"axis", {one.axis.x(), one.axis.y(), one.axis.z()}}, {"degrees", one.degrees}};
  }
  void numbers(const char* key, const auto& all) {
    if (!all.empty()) {
      json_[key] = all;
    }
  }
  void triangles(const char* key, const std::vector<std::array<ElementId, 3>>& all) { numbers(key, all); }
  void points(const char* key, const std::vector<SplitPoint>& all) {
    json_[key] = OrderedJson::array();
    for (const auto& [of, shares] : all) {
      json_[key].push_back({of[0], of[1], of[2], shares[0], shares[1]});
    }
  }
  void split(const SplitPointer& split) {
    mesh_ = split->after.get();  // of the commands after this one
    SplitEdit edit = split->edit;
    members(*this, edit);
  }
  void softness(const char* key, const std::shared_ptr<const Softness>& softness) {
    add_softness(json_, *softness);
    for (const auto& [link, own] : softness->links) {
      OrderedJson row = mesh_->links[link];
      for (const SoftnessNumber& number : softness_numbers) {
        row.push_back(own.*number.value);
      }
      json_[key].push_back(std::move(row));
    }
  }
  void counts(const char* panels, const char* slices, const std::shared_ptr<const commands::SliceCounts>& counts) {
    for (std::size_t i = 0; i < counts->size(); ++i) {
      json_[panels].push_back(info(counts->algorithm(i)).name);
      json_[slices].push_back(counts->slices(i));
    }
  }
  void described(const auto& one) { add_members(json_, one); }

 private:
  const Mesh* mesh_;
  OrderedJson json_;
};

}  // namespace

std::uint64_t split_parts_of(const Mesh& mesh) {
  return std::uint64_t{mesh.element_count()} + mesh.link_count() + mesh.triangles.size();
}

std::vector<Command> read_moves(std::string_view text, const std::filesystem::path& path, const std::string& where,
                                const MeshPointer& mesh, const Progress& progress, EnergyKind absent_energy) {
  return MovesReader(where, mesh, absent_energy).read(text, path, progress);
}

std::vector<Command> read_moves(std::string_view text, const std::filesystem::path& path, const MeshPointer& mesh,
                                const Progress& progress) {
  return read_moves(text, path, shown(path), mesh, progress);
}

std::vector<Command> read_moves(const std::filesystem::path& path, const MeshPointer& mesh, const Progress& progress) {
  return read_moves(read_text(path, "recorded moves", progress.part(0, 0.1)), path, mesh, progress.part(0.1, 1));
}

void write_moves(std::ostream& out, const std::vector<Command>& commands, const Mesh& mesh, const Progress& progress) {
  const MeshPointer first = first_mesh(commands);
  MovesWriter write(first ? *first : mesh);
  const bool relaxed =
      std::ranges::any_of(commands, [](const Command& one) { return std::holds_alternative<commands::Relaxed>(one); });
  out << "{\"version\": " << (relaxed ? relaxed_version : first ? split_version : first_version) << ", \"commands\": [";
  const char* before = "\n";
  for (std::size_t i = 0; i < commands.size(); ++i) {
    progress.report(i, commands.size());
    if (const OrderedJson json = std::visit(write, commands[i]); !json.is_null()) {
      out << before << json.dump();
      before = ",\n";
    }
  }
  out << "\n]}\n";
}

}  // namespace chainmail
