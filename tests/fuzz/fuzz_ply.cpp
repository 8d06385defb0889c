#include "files/formats/ply.h"
#include "files/mesh/open_mesh.h"
#include "fuzz/target.h"

namespace chainmail::fuzz_ply {
namespace {

int read_once(const std::uint8_t* data, std::size_t size) {
  fuzz::read_or_refuse(
      [&] { fuzz::check_mesh(*opened(read_ply(fuzz::text_of(data, size), "fuzz.ply"), "fuzz.ply", {}, {}).mesh); });
  return 0;
}

const fuzz::Target target("ply", read_once);

}  // namespace
}  // namespace chainmail::fuzz_ply
