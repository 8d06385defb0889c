#include "files/formats/vtk.h"
#include "files/mesh/open_mesh.h"
#include "fuzz/target.h"

namespace chainmail::fuzz_vtk {
namespace {

int read_once(const std::uint8_t* data, std::size_t size) {
  fuzz::read_or_refuse(
      [&] { fuzz::check_mesh(*opened(read_vtk(fuzz::text_of(data, size), "fuzz.vtk"), "fuzz.vtk", {}, {}).mesh); });
  return 0;
}

const fuzz::Target target("vtk", read_once);

}  // namespace
}  // namespace chainmail::fuzz_vtk
