#include "files/formats/obj.h"
#include "files/mesh/open_mesh.h"
#include "fuzz/target.h"

namespace chainmail::fuzz_obj {
namespace {

int read_once(const std::uint8_t* data, std::size_t size) {
  const std::string_view text = fuzz::text_of(data, size);
  fuzz::read_or_refuse([&] {
    const auto read = [](std::string_view from) { return opened(read_obj(from, "fuzz.obj"), "fuzz.obj", {}).mesh; };
    const MeshPointer mesh = read(text);
    fuzz::check_mesh(*mesh);
    const auto write = [](const Mesh& one) {
      return fuzz::written([&](auto& out) { write_obj(out, {one, {}, rest_positions(one), {}}); });
    };
    const std::string once = write(*mesh);
    fuzz::expect(write(*read(once)) == once, "what was written reads differently");
  });
  return 0;
}

const fuzz::Target target("obj", read_once);

}  // namespace
}  // namespace chainmail::fuzz_obj
