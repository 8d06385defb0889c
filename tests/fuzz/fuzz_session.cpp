#include <string>

#include "files/session/session.h"
#include "fuzz/target.h"

namespace chainmail::fuzz_session {
namespace {

int read_once(const std::uint8_t* data, std::size_t size) {
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

const fuzz::Target target("session", read_once, fuzz::Kind::json);

}  // namespace
}  // namespace chainmail::fuzz_session
