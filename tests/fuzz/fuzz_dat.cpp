#include "files/formats/dat.h"
#include "fuzz/target.h"

using namespace chainmail;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view text = fuzz::text_of(data, size);
  fuzz::read_or_refuse([&] {
    const MeshPointer mesh = read_dat(text, "fuzz.dat", {});
    fuzz::check_mesh(*mesh);
    const auto write = [](const Mesh& one) { return fuzz::written([&](auto& out) { write_dat(out, one, {}); }); };
    const std::string once = write(*mesh);
    fuzz::expect(write(*read_dat(once, "again.dat", {})) == once, "what was written reads differently");
  });
  return 0;
}
