#pragma once

#include <cstdint>
#include <filesystem>
#include <ostream>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "body/softness.h"

namespace chainmail {

inline constexpr std::uint64_t presets_version = 1;

/// A named softness for all links.
struct SoftnessPreset {
  std::string name;  // UTF-8, one line
  LinkSoftness softness;

  bool operator==(const SoftnessPreset&) const = default;
};

/// A preset that always exists, and the reason for its values.
struct BuiltInPreset {
  std::string_view name;
  LinkSoftness softness;
  std::string_view reason;
};
std::span<const BuiltInPreset> built_in_presets();
/// The preset for relaxation to the material.
inline constexpr std::string_view open_regions_name = "Open regions (material)";
inline constexpr LinkSoftness open_regions{0, 3, 2};

/// Returns what a valid name needs, or an empty text if the name is valid.
std::string fault_of_name(std::string_view name);

/// Presets as JSON: `{"version": 1, "presets": [{"name": "felt", "compression": 0.7, "stretch": 1.1, "shear": 0.2,
/// …}]}`, with the numbers of softness_numbers. Those after the first three may be left out: they have their defaults
/// then. `path` appears in errors. Throws Error for anything else, for more than limits::presets, for a name that is
/// empty, too long or appears twice, and for softness out of range.
std::vector<SoftnessPreset> read_presets(std::string_view text, const std::filesystem::path& path);
/// Reads presets from a file.
std::vector<SoftnessPreset> read_presets(const std::filesystem::path& path);

/// Writes presets with all digits, so that they read back exactly.
void write_presets(std::ostream& out, std::span<const SoftnessPreset> presets);

/// Writes one preset into a file. Throws Error for a name that is not valid, for softness out of range, and if the file
/// cannot be written.
void write_preset(const std::filesystem::path& path, const SoftnessPreset& preset);

}  // namespace chainmail
