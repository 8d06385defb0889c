#include "files/session/moves.h"

#include <algorithm>
#include <array>
#include <string>
#include <variant>

#include "files/session/moves_codec.h"
#include "files/text/limits.h"
#include "files/text/text.h"
#include "mesh/error.h"
#include "simulate/move_history.h"

namespace chainmail {
namespace {

// The second version knows `split`, the third `relaxed`, the fourth splits of cells.
constexpr std::uint64_t first_version = 1, split_version = 2, relaxed_version = 3, cells_version = newest_moves_version;
// Numbers in the row of a link: its ends and its softness, without or with the numbers of its energy.
constexpr std::size_t short_row = 2 + region_numbers, long_row = 2 + softness_numbers.size();

}  // namespace

void MovesReader::scan(std::string_view text, const std::filesystem::path& path, std::span<const PackedKey> packed,
                       const std::function<void()>& add, const Progress& progress) {
  // A split costs at least as much as the mesh before all of them.
  static constexpr std::string_view name = "\"split\"";
  std::uint64_t splits = 0;
  for (std::size_t at = text.find(name); at != std::string_view::npos; at = text.find(name, at + name.size())) {
    ++splits;
  }
  check_split_parts(splits * mesh_size(*mesh_));
  scan_json(text, path, where_,
            {.content = "recorded moves",
             .packed = packed,
             .items = "commands",
             .item = ": command ",
             .take = [&](const Json& command) { take(command, add); }},
            json_, progress);
  fields_.say_at(where_);
  check_head();
  if (fault_) {
    throw Error(*fault_);
  }
}

void MovesReader::check_head() const {
  if (!json_.tree.is_object()) {
    fields_.fail("it contains no recorded moves", "use a file of recorded moves");
  }
  fields_.version(json_.tree, newest_moves_version);
  fields_.check_keys(json_.tree, {"version", "commands"});
  fields_.array(json_.tree, "commands");
}

void MovesReader::take(const Json& command, const std::function<void()>& add) {
  if (fault_) {
    return;
  }
  fields_.say_at(where_ + ": command " + std::to_string(commands_));
  of_ = &command;
  try {
    if (!command.is_object()) {
      fields_.fail("it is not an object", "write {\"do\": …}");
    }
    if (commands_ == limits::moves) {
      fields_.fail("there are more than " + std::to_string(limits::moves) + " commands", "use fewer moves");
    }
    add();
    ++commands_;
  } catch (const Error& error) {
    fault_ = error;
  }
}

const MovesReader::Json& MovesReader::with(const char* key) {
  keys_.emplace_back(key);
  return *of_;
}

void MovesReader::element(const char* key, ElementId& one) {
  const Json& json = fields_.member(with(key), key);
  if (!json.is_number_unsigned()) {
    fields_.fail(in_quotes(text_of(json)) + " is not an element's id", "ids are whole numbers from 0");
  }
  fields_.check_element(json.get<std::uint64_t>(), mesh_->element_count(), key);
  one = json.get<ElementId>();
}

void MovesReader::elements(const char* key, std::vector<ElementId>& all) {
  all = fields_.elements(with(key), key, mesh_->element_count()).ids;
}

void MovesReader::links(const char* key, std::vector<LinkId>& all) {
  const auto& ends = fields_.elements(with(key), key, mesh_->element_count(), {2}).ids;
  for (std::size_t i = 0; i < ends.size(); i += 2) {
    all.push_back(fields_.link(*mesh_, ends[i], ends[i + 1]));
  }
}

void MovesReader::point(const char* key, Point& one, std::string_view /*help*/) { one = fields_.point(with(key), key); }

void MovesReader::rotation(const char* key, Rotation& one, std::string_view /*help*/) {
  const Json& rotate = fields_.object(with(key), key);
  fields_.check_keys(rotate, {"axis", "degrees"});
  one = {fields_.point(rotate, "axis"), fields_.number(fields_.member(rotate, "degrees"))};
  fields_.here([&] { check(one, *mesh_); });
}

void MovesReader::numbers(const char* key, std::vector<std::uint32_t>& all, std::string_view /*help*/) {
  if (has(key, true)) {
    all = fields_.packed(with(key), key).ids;
  }
}

void MovesReader::points(const char* key, std::vector<SplitPoint>& all) {
  const PackedArray& rows = fields_.packed(with(key), key, {5});
  for (std::size_t i = 0; i < rows.size; ++i) {
    const auto* of = &rows.ids[3 * i];
    all.push_back({{of[0], of[1], of[2]}, {rows.reals[2 * i], rows.reals[2 * i + 1]}});
  }
}

void MovesReader::split(SplitPointer& split) {
  SplitEdit edit;
  members(*this, edit);
  split_parts_ += mesh_size(*mesh_) + edit.elements.size();
  check_split_parts(split_parts_);
  split = fields_.here([&] { return make_split(mesh_, std::move(edit)); });
  mesh_ = split->after();
  const auto pins = pins_after(*split, std::vector(pinned_.begin(), pinned_.end()));
  pinned_ = {pins.begin(), pins.end()};
  grabbed_.clear();
  principal_.reset();
}

void MovesReader::softness(const char* key, std::shared_ptr<const Softness>& softness) {
  keys_ = softness_keys({"do", key});
  Softness result = fields_.softness(*of_, *mesh_, absent_energy_, principal_);
  if (has(key, true)) {
    const PackedArray& rows = fields_.elements(*of_, key, mesh_->element_count(), {short_row, long_row});
    fields_.add_own(result.links, *mesh_, rows.ids, rows.reals);
  }
  softness = std::make_shared<const Softness>(std::move(result));
}

void MovesReader::counts(const char* panels, const char* slices, std::shared_ptr<const commands::SliceCounts>& counts) {
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

void MovesReader::follow(const commands::Grab& one) {
  grabbed_.clear();
  for (const ElementId element : one.elements) {
    if (pinned_.contains(element)) {
      fields_.fail("element " + std::to_string(element) + " is pinned at that time and cannot move", "unpin it first");
    }
    if (!grabbed_.insert(element).second) {
      fields_.fail("element " + std::to_string(element) + " is grabbed twice", "name each element of the handle once");
    }
  }
  if (grabbed_.empty()) {
    fields_.fail("the handle has no elements", "grab at least one element");
  }
}

void MovesReader::follow(const commands::Drag& /*one*/) {
  if (grabbed_.empty()) {
    fields_.fail("no element is grabbed at that time", "grab an element first");
  }
}

void MovesReader::follow(const commands::Pin& one) {
  for (const ElementId element : one.elements) {
    if (grabbed_.contains(element)) {
      fields_.fail("element " + std::to_string(element) + " is grabbed at that time", "release it first");
    }
  }
  pinned_.insert(one.elements.begin(), one.elements.end());
}

void MovesReader::follow(const commands::Unpin& one) {
  for (const ElementId element : one.elements) {
    pinned_.erase(element);
  }
}

void MovesReader::follow(const commands::Relax& one) {
  if (one.until > 0 && info(one.scheme).sweeps) {
    fields_.fail("'until' works only with the scheme equilibrium", "leave it out, or choose this scheme");
  }
  if (one.local && info(one.scheme).sweeps) {
    fields_.fail("'local' works only with the scheme equilibrium", "leave it out, or choose this scheme");
  }
}

void MovesReader::check_split_parts(std::uint64_t parts) const {
  if (parts > limits::split_parts) {
    fields_.fail("the meshes after all splits have more than " + std::to_string(limits::split_parts) +
                     " elements, links, triangles and cells",
                 "use fewer splits, or a smaller object");
  }
}

/// Returns the mesh of the next command. It is made only for commands that name links.
const Mesh& MovesWriter::mesh() {
  if (split_) {
    after_split_ = split_->after();
    mesh_ = after_split_.get();
    split_.reset();
  }
  return *mesh_;
}

void MovesWriter::links(const char* key, const std::vector<LinkId>& all) {
  json_[key] = Json::array();
  for (const LinkId link : all) {
    json_[key].push_back(mesh().links[link]);
  }
}

void MovesWriter::point(const char* key, const Point& one, std::string_view /*help*/) {
  json_[key] = {one.x(), one.y(), one.z()};
}

void MovesWriter::rotation(const char* key, const Rotation& one, std::string_view /*help*/) {
  json_[key] = {{"axis", {one.axis.x(), one.axis.y(), one.axis.z()}}, {"degrees", one.degrees}};
}

void MovesWriter::points(const char* key, const std::vector<SplitPoint>& all) {
  json_[key] = Json::array();
  for (const auto& [of, shares] : all) {
    json_[key].push_back({of[0], of[1], of[2], shares[0], shares[1]});
  }
}

void MovesWriter::split(const SplitPointer& split) {
  split_ = split;
  SplitEdit edit = split->edit();
  members(*this, edit);
}

void MovesWriter::softness(const char* key, const std::shared_ptr<const Softness>& softness) {
  add_softness(json_, *softness);
  for (const auto& [link, own] : softness->links) {
    Json row = mesh().links[link];
    for (const SoftnessNumber& number : softness_numbers) {
      row.push_back(own.*number.value);
    }
    json_[key].push_back(std::move(row));
  }
}

void MovesWriter::counts(const char* panels, const char* slices,
                         const std::shared_ptr<const commands::SliceCounts>& counts) {
  for (std::size_t i = 0; i < counts->size(); ++i) {
    json_[panels].push_back(info(counts->algorithm(i)).name);
    json_[slices].push_back(counts->slices(i));
  }
}

std::vector<Command> read_moves(std::string_view text, const std::filesystem::path& path, const std::string& where,
                                const MeshPointer& mesh, const Progress& progress, EnergyKind absent_energy) {
  return MovesReader(where, mesh, absent_energy).read<Command>(text, path, progress);
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
  const bool cells = std::ranges::any_of(commands, [](const Command& command) {
    const auto* split = std::get_if<commands::Split>(&command);
    return split != nullptr && split->split->had_cells();
  });
  out << "{\"version\": "
      << (cells     ? cells_version
          : relaxed ? relaxed_version
          : first   ? split_version
                    : first_version)
      << ", \"commands\": [";
  const char* before = "\n";
  for (std::size_t i = 0; i < commands.size(); ++i) {
    progress.report(i, commands.size());
    if (const auto json = std::visit(write, commands[i]); !json.is_null()) {
      out << before << json.dump();
      before = ",\n";
    }
  }
  out << "\n]}\n";
}

}  // namespace chainmail
