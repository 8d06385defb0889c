#include "files/open_mesh.h"
#include "files/ply.h"
#include "fuzz/target.h"

using namespace chainmail;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  fuzz::read_or_refuse(
      [&] { fuzz::check_mesh(*opened(read_ply(fuzz::text_of(data, size), "fuzz.ply"), "fuzz.ply", {}, {}).mesh); });
  return 0;
}
