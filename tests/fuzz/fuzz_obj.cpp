#include "files/formats/obj.h"
#include "fuzz/target.h"

using namespace chainmail;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view text = fuzz::text_of(data, size);
  fuzz::read_or_refuse([&] {
    const MeshPointer mesh = read_obj(text, "fuzz.obj", {});
    fuzz::check_mesh(*mesh);
    const auto write = [](const Mesh& one) {
      return fuzz::written([&](auto& out) { write_obj(out, one, {}, rest_positions(one)); });
    };
    const std::string once = write(*mesh);
    fuzz::expect(write(*read_obj(once, "again.obj", {})) == once, "what was written reads differently");
  });
  return 0;
}
