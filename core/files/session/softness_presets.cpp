#include "files/session/softness_presets.h"

#include <algorithm>
#include <array>
#include <unordered_set>

#include "files/text/described_json.h"
#include "files/text/limits.h"
#include "files/text/outputs.h"
#include "files/text/text.h"
#include "mesh/error.h"

namespace chainmail {
namespace {

// A preset describes how far a material deforms before it reaches its limit, not the force for this.
constexpr std::array all_built_in_presets{
    BuiltInPreset{"Standard", {}, "the softness of a new object"},
    BuiltInPreset{open_regions_name, open_regions, "regions that hardly bind: the energy of the material decides"},
    // Rings of wire do not lengthen. They slide together until wires touch, at about half their distance if four rings
    // pass through each one. They turn by little more than their play.
    BuiltInPreset{"Steel mail", {0.5, 1, 0.15}, "rings do not lengthen, they slide together and turn a little"},
    // Weaving bends the yarns, so they lengthen by a few percent when pulled straight. When pushed, cloth buckles
    // instead of shortening, and its ends come to a third of their distance. Crossing yarns turn until they lock, at 30
    // to 45 degrees.
    BuiltInPreset{"Cloth", {0.35, 1.05, 0.6}, "yarns hardly lengthen, buckle when pushed, and turn until they lock"},
    // Rubber returns from twice its length without loss, and tears only at about six times. Its volume stays constant,
    // so its sides shrink to 1/√2 at twice the length. Rubber bearings are sheared by up to about a half.
    BuiltInPreset{"Rubber", {0.7, 2, 0.5}, "lengthens to twice its length, keeps its volume, shears by half"},
    // Gelatine can be compressed and stretched by about two fifths before it breaks, and wobbles by as much.
    BuiltInPreset{"Jelly", {0.6, 1.4, 0.4}, "changes its length by two fifths before it breaks"},
    // Tests compress the tissue by three tenths (Miller and Chinzei 1997). Nerve fibres are damaged when they lengthen
    // by about a fifth (Bain and Meaney 2000). The tissue hardly resists shear.
    BuiltInPreset{
        "Brain-soft", {0.7, 1.2, 0.3}, "shortens by three tenths, lengthens by a fifth, hardly resists shear"}};

SoftnessPreset preset_of(const JsonFields& fields, const nlohmann::json& json) {
  auto keys = keys_of<LinkSoftness>();
  keys.emplace_back("name");
  fields.check_keys(json, keys);
  const std::string name = fields.text(json, "name");
  if (const std::string fault = fault_of_name(name); !fault.empty()) {
    fields.fail(in_quotes(name) + " is not a valid name", fault);
  }
  return {name, read_members<LinkSoftness>(fields, json)};
}

}  // namespace

std::span<const BuiltInPreset> built_in_presets() { return all_built_in_presets; }

std::string fault_of_name(std::string_view name) {
  if (name.empty() || name.front() == ' ' || name.back() == ' ') {
    return "a name must not be empty, or begin or end with a blank";
  }
  if (name.size() > limits::preset_name_bytes) {
    return "a name has at most " + std::to_string(limits::preset_name_bytes) + " bytes";
  }
  return printable(name) == name ? "" : "a name must be one line of text";
}

std::vector<SoftnessPreset> read_presets(std::string_view text, const std::filesystem::path& path) {
  const auto json = parse_json(text, path, "presets of softness");
  JsonFields fields(shown(path));
  if (!json.is_object()) {
    fields.fail("it contains no presets", "use a file of softness presets");
  }
  fields.version(json, presets_version);
  fields.check_keys(json, {"version", "presets"});
  const auto& list = fields.array(json, "presets");
  if (list.size() > limits::presets) {
    fields.fail("it contains " + std::to_string(list.size()) + " presets",
                "use at most " + std::to_string(limits::presets));
  }
  std::vector<SoftnessPreset> presets;
  std::unordered_set<std::string> names;
  for (const auto& one : list) {
    fields.say_at(shown(path) + ": preset " + std::to_string(presets.size()));
    SoftnessPreset preset = preset_of(fields, one);
    if (!names.insert(preset.name).second) {
      fields.fail(in_quotes(preset.name) + " appears twice", "rename one of them");
    }
    presets.push_back(std::move(preset));
  }
  return presets;
}

std::vector<SoftnessPreset> read_presets(const std::filesystem::path& path) {
  return read_presets(read_text(path, "presets of softness"), path);
}

void write_presets(std::ostream& out, std::span<const SoftnessPreset> presets) {
  auto list = nlohmann::ordered_json::array();
  for (const auto& [name, softness] : presets) {
    nlohmann::ordered_json one{{"name", name}};
    add_members(one, softness);
    list.push_back(std::move(one));
  }
  const nlohmann::ordered_json json{{"version", presets_version}, {"presets", list}};
  out << json.dump(2) << '\n';
}

void write_preset(const std::filesystem::path& path, const SoftnessPreset& preset) {
  if (const std::string fault = fault_of_name(preset.name); !fault.empty()) {
    throw Error("preset " + in_quotes(preset.name), "this cannot be its name", fault);
  }
  check(preset.softness);
  write_file(path, [&](std::ostream& out) { write_presets(out, std::span(&preset, 1)); });
}

}  // namespace chainmail
