#pragma once

#include <filesystem>
#include <ostream>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "solve/softness.h"

namespace chainmail {

/// A softness for all links, by a name.
struct SoftnessPreset {
  std::string name;  // UTF-8, one line
  LinkSoftness softness;

  bool operator==(const SoftnessPreset&) const = default;
};

/// One that is always there, and why it has its values.
struct BuiltInPreset {
  std::string_view name;
  LinkSoftness softness;
  std::string_view reason;
};
std::span<const BuiltInPreset> built_in_presets();

/// So many bytes a name has at most.
inline constexpr std::size_t longest_preset_name = 60;
/// What is wrong with a name, and what to do; empty where nothing is.
std::string fault_of_name(std::string_view name);

/// Presets as JSON: `{"version": 1, "presets": [{"name": "felt", "compression": 0.7, "stretch": 1.1, "shear": 0.2}]}`.
/// `path` appears in errors; `text` is what the file holds. Throws Error where it is something else, where a name is
/// empty, too long or comes twice, and for softness out of range.
std::vector<SoftnessPreset> read_presets(std::string_view text, const std::filesystem::path& path);
/// The same from a file.
std::vector<SoftnessPreset> read_presets(const std::filesystem::path& path);

/// With all digits: what is read back is the same to the bit.
void write_presets(std::ostream& out, std::span<const SoftnessPreset> presets);

}  // namespace chainmail
