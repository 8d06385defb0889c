#include "chainmail/preset.h"

#include "api/access.h"
#include "files/text/limits.h"

#ifdef CHAINMAIL_HAS_JSON
#include "files/session/softness_presets.h"
#include "files/text/outputs.h"
#include "files/text/text.h"
#endif

namespace chainmail::api {

static_assert(preset_name_bytes == limits::preset_name_bytes);

#ifdef CHAINMAIL_HAS_JSON

std::vector<Preset> built_in_presets() {
  std::vector<Preset> presets;
  for (const BuiltInPreset& one : inner::built_in_presets()) {
    presets.push_back({std::string(one.name), softness_of(one.softness)});
  }
  return presets;
}

std::vector<Preset> read_presets(const std::filesystem::path& path) {
  std::vector<Preset> presets;
  for (SoftnessPreset& one : guarded([&] { return inner::read_presets(path); })) {
    presets.push_back({std::move(one.name), softness_of(one.softness)});
  }
  return presets;
}

std::string fault_of_preset_name(std::string_view name) { return fault_of_name(name); }

void write_presets(std::ostream& out, std::span<const Preset> presets) {
  std::vector<SoftnessPreset> all;
  for (const Preset& one : presets) {
    if (const std::string fault = fault_of_name(one.name); !fault.empty()) {
      throw Error("preset " + inner::in_quotes(one.name), "this cannot be its name", fault);
    }
    guarded([&] { inner::check(softness_of(one.softness)); });
    all.push_back({one.name, softness_of(one.softness)});
  }
  inner::write_presets(out, all);
}

void write_preset(const std::filesystem::path& path, const std::string& name, const LinkSoftness& softness) {
  guarded([&] { inner::write_file(path, [&](std::ostream& out) { write_presets(out, {{Preset{name, softness}}}); }); });
}

#else

std::vector<Preset> built_in_presets() { refuse_without("nlohmann/json", "presets"); }
std::vector<Preset> read_presets(const std::filesystem::path& path) { refuse_without("nlohmann/json", path.string()); }
std::string fault_of_preset_name(std::string_view /*name*/) { refuse_without("nlohmann/json", "presets"); }
void write_presets(std::ostream& /*out*/, std::span<const Preset> /*presets*/) {
  refuse_without("nlohmann/json", "presets");
}
void write_preset(const std::filesystem::path& path, const std::string& /*name*/, const LinkSoftness& /*softness*/) {
  refuse_without("nlohmann/json", path.string());
}

#endif

}  // namespace chainmail::api
