#include "files/session/softness_presets.h"
#include "fuzz/target.h"

namespace chainmail::fuzz_presets {
namespace {

int read_once(const std::uint8_t* data, std::size_t size) {
  const std::string_view text = fuzz::text_of(data, size);
  fuzz::read_or_refuse([&] {
    const auto presets = read_presets(text, "fuzz.json");
    const std::string once = fuzz::written([&](auto& out) { write_presets(out, presets); });
    fuzz::expect(read_presets(once, "again.json") == presets, "what was written reads differently");
  });
  return 0;
}

const fuzz::Target target("presets", read_once, fuzz::Kind::json);

}  // namespace
}  // namespace chainmail::fuzz_presets
