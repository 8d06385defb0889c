#include "files/session/moves.h"

#include <algorithm>
#include <array>
#include <limits>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <set>
#include <string>

#include "files/session/moves_scan.h"
#include "files/session/session_json.h"
#include "files/text/limits.h"
#include "files/text/text.h"
#include "mesh/error.h"
#include "simulate/move_history.h"

namespace chainmail {
namespace {

using Json = nlohmann::json;
using OrderedJson = nlohmann::ordered_json;

/// Checks and returns the members of a command. Throws Error if one is wrong.
class MoveFields : public ObjectFields {
 public:
  /// `where` appears in errors.
  MoveFields(std::string where, MeshPointer mesh) : ObjectFields(std::move(where)), mesh_(std::move(mesh)) {}

  ElementId element(const Json& json) const;
  /// Returns the link whose ends are the first two numbers of an array of this size.
  LinkId link(const Json& json, std::size_t size) const;
  /// Return the only member of a command besides `do`.
  std::vector<LinkId> links(const MoveMembers& command) const;
  std::vector<ElementId> elements(const MoveMembers& command, const std::string& key = "elements") const;
  /// Returns a position, a displacement or an axis: three coordinates.
  Point coordinates(const Json& members, const std::string& key) const;
  Rotation rotation(const Json& members) const;
  const NumberList& list(const MoveMembers& command, const std::string& key) const;
  /// Returns the numbers of a list; empty if the command does not have it.
  std::vector<std::uint32_t> indices(const MoveMembers& command, const std::string& key) const;
  SplitEdit split(const MoveMembers& command) const;

  RegionAxes axes(const Json& members) { return ObjectFields::axes(members, *mesh_, principal_); }

  const MeshPointer& mesh() const { return mesh_; }
  /// From now on, commands are about this mesh.
  void set_mesh(MeshPointer mesh) {
    mesh_ = std::move(mesh);
    principal_.reset();
  }

 private:
  std::vector<double> row(const Json& json, std::size_t size, const std::string& key) const;
  std::uint32_t index(const Json& json, const std::string& key) const;

  MeshPointer mesh_;
  std::optional<RegionAxes> principal_;  // principal axes of the mesh, once they are needed
};

ElementId MoveFields::element(const Json& json) const {
  if (!json.is_number_unsigned()) {
    fail(in_quotes(text_of(json)) + " is not an element's id", "ids are whole numbers from 0");
  }
  if (json.get<std::uint64_t>() >= mesh_->element_count()) {
    fail("there is no element " + json.dump(), "ids run from 0 to " + std::to_string(mesh_->element_count() - 1));
  }
  return json.get<ElementId>();
}

LinkId MoveFields::link(const Json& json, std::size_t size) const {
  if (!json.is_array() || json.size() != size) {
    fail("a link is not an array of " + (size == 2 ? std::string("2") : "5 or 8"),
         size == 2 ? "write [a, b]" : "write [a, b, " + softness_names(", ") + "]");
  }
  const ElementId a = element(json[0]), b = element(json[1]);
  const auto found = find_link(*mesh_, a, b);
  if (!found) {
    fail("the elements " + std::to_string(a) + " and " + std::to_string(b) + " are not linked",
         "give the two ends of a link");
  }
  return *found;
}

const NumberList& MoveFields::list(const MoveMembers& command, const std::string& key) const {
  array(command.members, key);
  return command.lists.at(key);
}

std::vector<LinkId> MoveFields::links(const MoveMembers& command) const {
  check_keys(command.members, {"do", "links"});
  const NumberList& ends = list(command, "links");
  std::vector<LinkId> result;
  for (std::size_t i = 0; i < ends.size(); ++i) {
    result.push_back(link(ends.at(i), 2));
  }
  return result;
}

Point MoveFields::coordinates(const Json& members, const std::string& key) const {
  const Json& values = array(members, key);
  if (values.size() != 3) {
    fail(in_quotes(key) + " does not have three coordinates", "write [x, y, z]");
  }
  return {number(values[0]), number(values[1]), number(values[2])};
}

Rotation MoveFields::rotation(const Json& members) const {
  const Json& rotate = member(members, "rotate");
  if (!rotate.is_object()) {
    fail("'rotate' is not an object", "write {\"axis\": [x, y, z], \"degrees\": angle}");
  }
  check_keys(rotate, {"axis", "degrees"});
  Rotation rotation{coordinates(rotate, "axis"), number(member(rotate, "degrees"))};
  if (rotation.axis.isZero(0)) {
    fail("the rotation has no axis: all its coordinates are 0", "write an axis such as [0, 0, 1]");
  }
  try {
    check(rotation, *mesh_);
  } catch (const Error& error) {
    fail(error.problem(), error.remedy());
  }
  return rotation;
}

std::vector<ElementId> MoveFields::elements(const MoveMembers& command, const std::string& key) const {
  check_keys(command.members, {"do", key});
  const NumberList& ids = list(command, key);
  std::vector<ElementId> result;
  for (std::size_t i = 0; i < ids.size(); ++i) {
    result.push_back(element(ids.at(i)));
  }
  return result;
}

std::uint32_t MoveFields::index(const Json& json, const std::string& key) const {
  if (!json.is_number_unsigned() || json.get<std::uint64_t>() > std::numeric_limits<std::uint32_t>::max()) {
    fail("'" + key + "' contains " + in_quotes(text_of(json)), "write whole numbers from 0");
  }
  return json.get<std::uint32_t>();
}

std::vector<std::uint32_t> MoveFields::indices(const MoveMembers& command, const std::string& key) const {
  std::vector<std::uint32_t> result;
  if (command.members.contains(key)) {
    const NumberList& all = list(command, key);
    for (std::size_t i = 0; i < all.size(); ++i) {
      result.push_back(index(all.at(i), key));
    }
  }
  return result;
}

/// Returns the numbers of an item of a list.
std::vector<double> MoveFields::row(const Json& json, std::size_t size, const std::string& key) const {
  if (!json.is_array() || json.size() != size) {
    fail("'" + key + "' contains something that is not an array of " + std::to_string(size) + " numbers",
         "write " + std::to_string(size) + " numbers for each");
  }
  std::vector<double> result;
  for (const Json& one : json) {
    result.push_back(number(one));
  }
  return result;
}

SplitEdit MoveFields::split(const MoveMembers& command) const {
  check_keys(command.members, {"do", "elements", "removed", "triangles", "removed_polygons", "polygons"});
  SplitEdit edit;
  const NumberList& points = list(command, "elements");
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Json one = points.at(i);
    const auto numbers = row(one, 5, "elements");
    edit.elements.push_back(
        {{index(one[0], "elements"), index(one[1], "elements"), index(one[2], "elements")}, {numbers[3], numbers[4]}});
  }
  if (command.members.contains("triangles")) {
    const NumberList& triangles = list(command, "triangles");
    for (std::size_t i = 0; i < triangles.size(); ++i) {
      const Json one = triangles.at(i);
      row(one, 3, "triangles");
      edit.triangles.push_back({index(one[0], "triangles"), index(one[1], "triangles"), index(one[2], "triangles")});
    }
  }
  edit.removed = indices(command, "removed");
  edit.removed_polygons = indices(command, "removed_polygons");
  edit.polygons = indices(command, "polygons");
  return edit;
}

// The second version knows `split`, the third `relaxed`.
constexpr std::uint64_t first_version = 1, split_version = 2, relaxed_version = 3;
constexpr std::array<std::string_view, 3> starts{"goes on", "awake", "asleep"};  // see commands::Relaxed::Start
constexpr std::uint64_t max_sweeps = 1'000'000;
// Numbers in the row of a link: its ends and its softness, without or with the numbers of its energy.
constexpr std::size_t short_row = 2 + region_numbers, long_row = 2 + softness_numbers.size();

/// Checks commands one after another, as a simulation would execute them from rest.
class MovesReader {
 public:
  MovesReader(const std::string& where, const MeshPointer& mesh, EnergyKind absent_energy = link_energy)
      : where_(where), fields_(where_, mesh), absent_energy_(absent_energy) {}

  std::vector<Command> read(std::string_view text, const std::filesystem::path& path, const Progress& progress);

 private:
  using Members = MoveMembers;

  void check_head(const Json& head) const;
  void take(const Json& value, const Members& of);
  Command command(const Members& of);
  Command grab(const Members& of);
  ElementId one_element(const Members& of) const;
  Command drag(const Members& of);
  Command release(const Members& of);
  Command cut(const Members& of) { return commands::Cut{fields_.links(of)}; }
  Command uncut(const Members& of) { return commands::Uncut{fields_.links(of)}; }
  Command pin(const Members& of);
  Command unpin(const Members& of);
  Command softness(const Members& of);
  LinkSoftness own_softness(const Json& row) const;
  Command reset(const Members& of);
  Command relax(const Members& of);
  Command relaxed(const Members& of);
  Command split(const Members& of);
  void check_split_parts(std::uint64_t parts) const;

  std::string where_;
  MoveFields fields_;         // of the file, then of each command
  EnergyKind absent_energy_;  // of a softness that does not say it
  std::vector<Command> commands_;
  std::optional<Error> fault_;  // of the first wrong command; errors of the whole file are reported first
  // The state that the simulation would be in.
  std::set<ElementId> grabbed_;
  std::set<ElementId> pinned_;
  std::uint64_t split_parts_ = 0;  // of the meshes after all splits
};

Command MovesReader::grab(const Members& of) {
  const bool many = of.members.contains("elements");
  const auto elements = many ? fields_.elements(of) : std::vector{one_element(of)};
  std::set<ElementId> grabbed;
  for (const ElementId one : elements) {
    if (pinned_.contains(one)) {
      fields_.fail("element " + std::to_string(one) + " is pinned at that time and cannot move", "unpin it first");
    }
    if (!grabbed.insert(one).second) {
      fields_.fail("element " + std::to_string(one) + " is grabbed twice", "name each element of the handle once");
    }
  }
  if (grabbed.empty()) {
    fields_.fail("the handle has no elements", "grab at least one element");
  }
  grabbed_ = std::move(grabbed);
  return commands::Grab{elements};
}

ElementId MovesReader::one_element(const Members& of) const {
  fields_.check_keys(of.members, {"do", "element"});
  return fields_.element(fields_.member(of.members, "element"));
}

Command MovesReader::drag(const Members& of) {
  const bool relative = of.members.contains("by") || !of.members.contains("target");
  fields_.check_keys(of.members, {"do", relative ? "by" : "target", "rotate"});
  if (grabbed_.empty()) {
    fields_.fail("no element is grabbed at that time", "grab an element first");
  }
  commands::Drag drag;
  drag.relative = relative;
  if (of.members.contains("rotate")) {
    drag.rotation = fields_.rotation(of.members);
  } else if (!of.members.contains("by") && relative) {
    fields_.fail("it has no 'target'", "write \"target\": [x, y, z], or \"by\": [x, y, z]");
  }
  if (of.members.contains("by") || !relative) {
    drag.target = fields_.coordinates(of.members, relative ? "by" : "target");
  }
  return drag;
}

Command MovesReader::release(const Members& of) {
  fields_.check_keys(of.members, {"do"});
  grabbed_.clear();
  return commands::Release{};
}

Command MovesReader::pin(const Members& of) {
  const auto pins = fields_.elements(of);
  for (const ElementId one : pins) {
    if (grabbed_.contains(one)) {
      fields_.fail("element " + std::to_string(one) + " is grabbed at that time", "release it first");
    }
  }
  pinned_.insert(pins.begin(), pins.end());
  return commands::Pin{pins};
}

Command MovesReader::unpin(const Members& of) {
  const auto pins = fields_.elements(of);
  for (const ElementId one : pins) {
    pinned_.erase(one);
  }
  return commands::Unpin{pins};
}

Command MovesReader::softness(const Members& of) {
  auto keys = softness_keys();
  keys.insert(keys.end(), {"do", "energy", "frame", "links"});
  fields_.check_keys(of.members, keys);
  Softness result{
      fields_.softness(of.members), {}, fields_.energy(of.members, absent_energy_), fields_.axes(of.members)};
  if (!of.members.contains("links")) {
    return commands::SetSoftness{result};
  }
  const NumberList& links = fields_.list(of, "links");
  const std::size_t row = links.size() > 0 && links.at(0).size() == short_row ? short_row : long_row;
  for (std::size_t i = 0; i < links.size(); ++i) {
    const Json one = links.at(i);
    const LinkId link = fields_.link(one, row);
    if (result.links.contains(link)) {
      fields_.fail("the link " + one[0].dump() + "-" + one[1].dump() + " is given twice", "remove one of them");
    }
    result.links.set(link, own_softness(one));
  }
  return commands::SetSoftness{result};
}

/// Returns the softness in the row of a link, after the ids of its two ends.
LinkSoftness MovesReader::own_softness(const Json& row) const {
  LinkSoftness own;
  for (std::size_t i = 2; i < row.size(); ++i) {
    const auto& [parameter, value] = softness_numbers[i - 2];
    own.*value = fields_.number(row[i], *parameter);
  }
  return own;
}

Command MovesReader::reset(const Members& of) {
  fields_.check_keys(of.members, {"do"});
  return commands::Reset{};
}

Command MovesReader::relaxed(const Members& of) {
  fields_.check_keys(of.members, {"do", "scheme", "step", "start", "panels", "slices"});
  commands::Relaxed relaxed;
  relaxed.scheme = fields_.relaxation_scheme(fields_.member(of.members, "scheme"));
  relaxed.step = fields_.number(fields_.member(of.members, "step"), parameters::relax_step);
  const Json& start = fields_.member(of.members, "start");
  const auto found = std::ranges::find(starts, start.is_string() ? start.get<std::string>() : "");
  if (found == starts.end()) {
    fields_.fail("'start' is not known", "write \"goes on\", \"awake\" or \"asleep\"");
  }
  relaxed.start = commands::Relaxed::Start(found - starts.begin());
  const Json& panels = fields_.array(of.members, "panels");
  const auto slices = fields_.indices(of, "slices");
  if (slices.empty() || slices.size() > limits::session_panels || panels.size() != slices.size()) {
    fields_.fail("'panels' and 'slices' do not have one item for each panel",
                 "write 1 to " + std::to_string(limits::session_panels) + " of each");
  }
  const auto counts = std::make_shared<commands::SliceCounts>(slices.size());
  for (std::size_t i = 0; i < slices.size(); ++i) {
    const auto algorithm = find_algorithm(panels[i].is_string() ? panels[i].get<std::string>() : "");
    if (!algorithm) {
      fields_.fail("'panels' contains an algorithm that is not known", "use one that 'chainmail deform --help' lists");
    }
    counts->note(i, *algorithm, slices[i]);
  }
  relaxed.counts = counts;
  return relaxed;
}

Command MovesReader::relax(const Members& of) {
  fields_.check_keys(of.members, {"do", "sweeps", "step", "scheme", "until"});
  const Json& sweeps = fields_.member(of.members, "sweeps");
  if (!sweeps.is_number_unsigned() || sweeps.get<std::uint64_t>() > max_sweeps) {
    fields_.fail("'sweeps' is not a whole number up to " + std::to_string(max_sweeps), "write the number of sweeps");
  }
  const double step = of.members.contains("step") ? fields_.number(of.members["step"], parameters::relax_step) : 1;
  const RelaxationScheme scheme =
      of.members.contains("scheme") ? fields_.relaxation_scheme(of.members["scheme"]) : RelaxationScheme::mean;
  if (of.members.contains("until") && info(scheme).sweeps) {
    fields_.fail("'until' works only with the scheme equilibrium", "leave it out, or choose this scheme");
  }
  const double until = of.members.contains("until") ? fields_.number(of.members["until"], parameters::relax_until) : 0;
  return commands::Relax{sweeps.get<std::uint32_t>(), step, scheme, until};
}

Command MovesReader::split(const Members& of) {
  try {
    SplitEdit edit = fields_.split(of);
    split_parts_ += split_parts_of(*fields_.mesh()) + edit.elements.size();
    check_split_parts(split_parts_);
    SplitPointer split = make_split(fields_.mesh(), std::move(edit));
    const auto pins = pins_after(*split, std::vector(pinned_.begin(), pinned_.end()));
    pinned_ = {pins.begin(), pins.end()};
    grabbed_.clear();
    fields_.set_mesh(split->after);
    return commands::Split{std::move(split)};
  } catch (const Error& error) {
    const bool ours = error.where() == fields_.where();
    throw ours ? error : error.at(fields_.where() + ": " + error.where());
  }
}

void MovesReader::check_split_parts(std::uint64_t parts) const {
  if (parts > limits::split_parts) {
    fields_.fail("the meshes after all splits have more than " + std::to_string(limits::split_parts) +
                     " elements, links and triangles",
                 "use fewer splits, or a smaller object");
  }
}

Command MovesReader::command(const Members& of) {
  static const std::map<std::string, Command (MovesReader::*)(const Members&)> known{
      {"grab", &MovesReader::grab},   {"drag", &MovesReader::drag},         {"release", &MovesReader::release},
      {"cut", &MovesReader::cut},     {"uncut", &MovesReader::uncut},       {"pin", &MovesReader::pin},
      {"unpin", &MovesReader::unpin}, {"softness", &MovesReader::softness}, {"reset", &MovesReader::reset},
      {"relax", &MovesReader::relax}, {"relaxed", &MovesReader::relaxed},   {"split", &MovesReader::split}};
  const Json& what = fields_.member(of.members, "do");
  const auto found = known.find(what.is_string() ? what.get<std::string>() : "");
  if (found == known.end()) {
    fields_.fail("'do' is not a known command",
                 "use grab, drag, release, cut, uncut, split, pin, unpin, softness, relax, relaxed or reset");
  }
  return (this->*found->second)(of);
}

void MovesReader::take(const Json& value, const Members& of) {
  if (fault_) {
    return;
  }
  fields_.say_at(where_ + ": command " + std::to_string(commands_.size()));
  try {
    if (!value.is_object()) {
      fields_.fail("it is not an object", "write {\"do\": …}");
    }
    if (commands_.size() == limits::moves) {
      fields_.fail("there are more than " + std::to_string(limits::moves) + " commands", "use fewer moves");
    }
    commands_.push_back(command(of));
  } catch (const Error& error) {
    fault_ = error;
  }
}

void MovesReader::check_head(const Json& head) const {
  if (!head.is_object()) {
    fields_.fail("it contains no recorded moves", "use a file of recorded moves");
  }
  const Json& version = fields_.member(head, "version");
  if (!version.is_number_unsigned() || version.get<std::uint64_t>() < first_version ||
      version.get<std::uint64_t>() > relaxed_version) {
    fields_.fail("its version is not " + std::to_string(first_version) + " to " + std::to_string(relaxed_version),
                 "record the moves again with this program");
  }
  fields_.check_keys(head, {"version", "commands"});
  fields_.array(head, "commands");
}

std::vector<Command> MovesReader::read(std::string_view text, const std::filesystem::path& path,
                                       const Progress& progress) {
  // A split costs at least as much as the mesh before all of them.
  static constexpr std::string_view name = "\"split\"";
  std::uint64_t splits = 0;
  for (std::size_t at = text.find(name); at != std::string_view::npos; at = text.find(name, at + name.size())) {
    ++splits;
  }
  check_split_parts(splits * split_parts_of(*fields_.mesh()));
  MovesScan scan(text, path, where_, [this](const Json& value, const Members& of) { take(value, of); });
  scan.scan(progress);
  fields_.say_at(where_);
  check_head(scan.head());
  if (fault_) {
    throw Error(*fault_);
  }
  return std::move(commands_);
}

OrderedJson links_of(const std::vector<LinkId>& links, const Mesh& mesh) {
  OrderedJson result = OrderedJson::array();
  for (const LinkId link : links) {
    result.push_back(mesh.links[link]);
  }
  return result;
}

OrderedJson coordinates_of(const Point& point) { return {point.x(), point.y(), point.z()}; }

OrderedJson json_of(const SplitEdit& edit) {
  OrderedJson json{{"do", "split"}, {"elements", OrderedJson::array()}};
  for (const SplitPoint& point : edit.elements) {
    json["elements"].push_back({point.of[0], point.of[1], point.of[2], point.shares[0], point.shares[1]});
  }
  const auto add = [&json](const char* key, const auto& all) {
    if (!all.empty()) {
      json[key] = all;
    }
  };
  add("removed", edit.removed);
  add("triangles", edit.triangles);
  add("removed_polygons", edit.removed_polygons);
  add("polygons", edit.polygons);
  return json;
}

/// Returns a command as JSON, or null for a command that is left out.
class MoveWriter {
 public:
  /// The commands begin with this mesh.
  explicit MoveWriter(const Mesh& mesh) : mesh_(&mesh) {}

  OrderedJson operator()(const commands::Grab& one) const {
    return one.elements.size() == 1 ? OrderedJson{{"do", "grab"}, {"element", one.elements.front()}}
                                    : OrderedJson{{"do", "grab"}, {"elements", one.elements}};
  }
  OrderedJson operator()(const commands::Drag& one) const {
    OrderedJson json{{"do", "drag"}, {one.relative ? "by" : "target", coordinates_of(one.target)}};
    if (one.rotation.degrees != 0) {
      json["rotate"] = {{"axis", coordinates_of(one.rotation.axis)}, {"degrees", one.rotation.degrees}};
    }
    return json;
  }
  OrderedJson operator()(const commands::Release&) const { return {{"do", "release"}}; }
  OrderedJson operator()(const commands::Cut& one) const {
    return {{"do", "cut"}, {"links", links_of(one.links, *mesh_)}};
  }
  OrderedJson operator()(const commands::Uncut& one) const {
    return {{"do", "uncut"}, {"links", links_of(one.links, *mesh_)}};
  }
  OrderedJson operator()(const commands::Pin& one) const { return {{"do", "pin"}, {"elements", one.elements}}; }
  OrderedJson operator()(const commands::Unpin& one) const { return {{"do", "unpin"}, {"elements", one.elements}}; }
  OrderedJson operator()(const commands::Reset&) const { return {{"do", "reset"}}; }
  OrderedJson operator()(const commands::SetSoftness& one) const {
    OrderedJson json{{"do", "softness"}};
    add_softness(json, *one.softness);
    for (const auto& [link, of_link] : one.softness->links) {
      OrderedJson row{mesh_->links[link][0], mesh_->links[link][1]};
      for (const auto& [parameter, value] : softness_numbers) {
        row.push_back(of_link.*value);
      }
      json["links"].push_back(std::move(row));
    }
    return json;
  }
  OrderedJson operator()(const commands::Relax& one) const {
    OrderedJson json{{"do", "relax"}, {"sweeps", one.sweeps}, {"step", one.step}, {"scheme", info(one.scheme).name}};
    if (one.until > 0) {
      json["until"] = one.until;
    }
    return json;
  }
  OrderedJson operator()(const commands::Relaxed& one) const {
    OrderedJson json{{"do", "relaxed"},
                     {"scheme", info(one.scheme).name},
                     {"step", one.step},
                     {"start", starts[std::size_t(one.start)]}};
    for (std::size_t i = 0; i < one.counts->size(); ++i) {
      json["panels"].push_back(info(one.counts->algorithm(i)).name);
      json["slices"].push_back(one.counts->slices(i));
    }
    return json;
  }
  OrderedJson operator()(const commands::Split& one) {
    mesh_ = one.split->after.get();  // of the commands after this one
    return json_of(one.split->edit);
  }
  OrderedJson operator()(const commands::ReplaceMesh&) const { refuse(); }
  OrderedJson operator()(const commands::SetPositions&) const { refuse(); }
  OrderedJson operator()(const commands::RestoreState&) const { refuse(); }
  OrderedJson operator()(const commands::SetRelaxation&) const { return {}; }
  OrderedJson operator()(const commands::SetElastic&) const { return {}; }
  OrderedJson operator()(const commands::SetAlgorithm&) const { return {}; }
  OrderedJson operator()(const commands::KeepState&) const { return {}; }
  OrderedJson operator()(const commands::DropState&) const { return {}; }

 private:
  [[noreturn]] static void refuse() {
    throw Error("moves", "the object was replaced, or moves were undone, while they were recorded",
                "record them on one object without undo");
  }

  const Mesh* mesh_;
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
  MoveWriter write(first ? *first : mesh);
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
