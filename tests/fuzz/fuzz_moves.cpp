#include "files/session/moves.h"
#include "fuzz/target.h"
#include "mesh/generate.h"

namespace chainmail::fuzz_moves {
namespace {

int read_once(const std::uint8_t* data, std::size_t size) {
  const std::string_view text = fuzz::text_of(data, size);
  static const MeshPointer mesh = generate({MeshKind::cloth, {3, 3, 1}, 1, {}});
  fuzz::read_or_refuse([&] {
    const auto write = [](const std::vector<Command>& commands) {
      return fuzz::written([&](auto& out) { write_moves(out, commands, *mesh); });
    };
    const std::string once = write(read_moves(text, "fuzz.json", mesh));
    fuzz::expect(write(read_moves(once, "again.json", mesh)) == once, "what was written reads differently");
  });
  return 0;
}

const fuzz::Target target("moves", read_once, fuzz::Kind::json);

}  // namespace
}  // namespace chainmail::fuzz_moves
