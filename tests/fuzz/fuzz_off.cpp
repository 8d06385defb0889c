#include "files/formats/off.h"
#include "files/mesh/open_mesh.h"
#include "fuzz/target.h"

namespace chainmail::fuzz_off {
namespace {

int read_once(const std::uint8_t* data, std::size_t size) {
  fuzz::read_or_refuse(
      [&] { fuzz::check_mesh(*opened(read_off(fuzz::text_of(data, size), "fuzz.off", {}), "fuzz.off", {}, {}).mesh); });
  return 0;
}

const fuzz::Target target("off", read_once);

}  // namespace
}  // namespace chainmail::fuzz_off
