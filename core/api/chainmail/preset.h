#pragma once

#include <cstddef>
#include <filesystem>
#include <ostream>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "chainmail/body.h"

namespace chainmail::api {

/// A named softness for all links. Files of presets are JSON, which the workbench and `chainmail compare --preset`
/// open. These functions throw Error if the library was built without nlohmann/json.
struct Preset {
  std::string name = {};       ///< Its name: one line of UTF-8.
  LinkSoftness softness = {};  ///< Its softness.
};

/// Returns the presets that always exist: `Standard`, `Steel mail`, `Cloth` and others.
std::vector<Preset> built_in_presets();
/// Returns the presets of a file. Throws Error if it is not a file of presets.
std::vector<Preset> read_presets(const std::filesystem::path& path);

/// Largest length of a name (bytes).
inline constexpr std::size_t preset_name_bytes = 60;
/// Returns what a valid name of a preset needs; empty if this one is valid.
std::string fault_of_preset_name(std::string_view name);

/// Writes presets. Throws Error about a name that is not valid and a softness that is out of its range.
void write_presets(std::ostream& out, std::span<const Preset> presets);
/// Writes one preset into a file. Throws Error also if it cannot be written.
void write_preset(const std::filesystem::path& path, const std::string& name, const LinkSoftness& softness);

}  // namespace chainmail::api
