#include "files/formats/medit.h"
#include "files/mesh/open_mesh.h"
#include "fuzz/target.h"

namespace chainmail::fuzz_medit {
namespace {

int read_once(const std::uint8_t* data, std::size_t size) {
  const std::filesystem::path path = "fuzz.mesh";
  fuzz::read_or_refuse(
      [&] { fuzz::check_mesh(*opened(read_medit(fuzz::text_of(data, size), path), path, {}, {}).mesh); });
  return 0;
}

const fuzz::Target target("medit", read_once);

}  // namespace
}  // namespace chainmail::fuzz_medit
