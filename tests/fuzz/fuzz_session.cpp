#include <algorithm>
#include <string>

#include "files/session/session.h"
#include "fuzz/damage.h"
#include "fuzz/target.h"

using namespace chainmail;

extern "C" std::size_t LLVMFuzzerMutate(std::uint8_t* data, std::size_t size, std::size_t most);

/// Half of the inputs stay JSON: bytes alone would hardly ever get past the parser.
extern "C" std::size_t LLVMFuzzerCustomMutator(std::uint8_t* data, std::size_t size, std::size_t most, unsigned seed) {
  if (seed % 2 == 0) {
    return LLVMFuzzerMutate(data, size, most);
  }
  std::string text(fuzz::text_of(data, size));
  fuzz::Damage(seed).apply_to_json(text);
  text.resize(std::min(text.size(), most));
  std::ranges::copy(text, data);
  return text.size();
}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view text = fuzz::text_of(data, size);
  fuzz::read_or_refuse([&] {
    const auto write = [](const Session& one) { return fuzz::written([&](auto& out) { write_session(out, one); }); };
    const Session session = parse_session(text, "fuzz.chainmail");
    fuzz::check_mesh(*session.mesh);
    const std::string once = write(session);
    fuzz::expect(write(parse_session(once, "again.chainmail")) == once, "what was written reads differently");
  });
  return 0;
}
