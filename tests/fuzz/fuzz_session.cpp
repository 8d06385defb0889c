#include "files/session/session.h"
#include "fuzz/target.h"

using namespace chainmail;

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
