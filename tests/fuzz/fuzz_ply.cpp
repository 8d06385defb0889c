#include "files/formats/ply.h"
#include "files/mesh/open_mesh.h"
#include "fuzz/target.h"

using namespace chainmail;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  fuzz::read_or_refuse(
      [&] { fuzz::check_mesh(*opened(read_ply(fuzz::text_of(data, size), "fuzz.ply"), "fuzz.ply", {}, {}).mesh); });
  return 0;
}
