#include "files/formats/msh.h"
#include "fuzz/target.h"

namespace chainmail::fuzz_msh {
namespace {

int read_once(const std::uint8_t* data, std::size_t size) {
  fuzz::read_or_refuse([&] { check_msh(fuzz::text_of(data, size), "fuzz.msh"); });
  return 0;
}

const fuzz::Target target("msh", read_once);

}  // namespace
}  // namespace chainmail::fuzz_msh
