#include "files/formats/tetgen.h"
#include "files/mesh/open_mesh.h"
#include "fuzz/target.h"

namespace chainmail::fuzz_tetgen {
namespace {

int read_once(const std::uint8_t* data, std::size_t size) {
  // Two files in one: a line of three dashes separates them.
  const std::string_view text = fuzz::text_of(data, size);
  constexpr std::string_view between = "---\n";
  const std::size_t end = text.find(between);
  const std::string_view nodes = text.substr(0, end);
  const std::string_view elements = end == text.npos ? std::string_view() : text.substr(end + between.size());
  const std::filesystem::path path = "fuzz.node", other = "fuzz.ele";
  fuzz::read_or_refuse([&] {
    fuzz::check_mesh(*opened(read_tetgen({nodes, path}, {elements, other}), path, {}, {}).mesh);
  });
  return 0;
}

const fuzz::Target target("tetgen", read_once);

}  // namespace
}  // namespace chainmail::fuzz_tetgen
