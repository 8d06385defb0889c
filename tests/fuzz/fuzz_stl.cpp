#include "files/formats/stl.h"
#include "files/mesh/open_mesh.h"
#include "fuzz/target.h"

namespace chainmail::fuzz_stl {
namespace {

int read_once(const std::uint8_t* data, std::size_t size) {
  fuzz::read_or_refuse(
      [&] { fuzz::check_mesh(*opened(read_stl(fuzz::text_of(data, size), "fuzz.stl", {}), "fuzz.stl", {}, {}).mesh); });
  return 0;
}

const fuzz::Target target("stl", read_once);

}  // namespace
}  // namespace chainmail::fuzz_stl
