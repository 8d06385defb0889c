#include "files/session/softness_csv.h"
#include "fuzz/target.h"
#include "mesh/generate.h"

namespace chainmail::fuzz_softness {
namespace {

int read_once(const std::uint8_t* data, std::size_t size) {
  const std::string_view text = fuzz::text_of(data, size);
  static const MeshPointer mesh = generate({MeshKind::cloth, {3, 3, 1}, 1, {}});
  fuzz::read_or_refuse([&] {
    for (const auto& [link, softness] : read_softness(text, "fuzz.csv", *mesh)) {
      fuzz::expect(link < mesh->link_count(), "a link that is not there");
      check(softness);
    }
  });
  return 0;
}

const fuzz::Target target("softness", read_once);

}  // namespace
}  // namespace chainmail::fuzz_softness
