#include <span>
#include <utility>
#include <variant>

#include "files/formats/voxel_block.h"
#include "files/import/handover.h"
#include "files/mesh/open_mesh.h"
#include "fuzz/target.h"

namespace chainmail::fuzz_handover {
namespace {

int read_once(const std::uint8_t* data, std::size_t size) {
  fuzz::read_or_refuse([&] {
    Imported imported = decode_imported(std::as_bytes(std::span(data, size)), "fuzz");
    const auto again = encode_imported(imported);
    fuzz::expect(decode_imported(again, "fuzz").index() == imported.index(), "what was encoded decodes differently");
    if (const auto* volume = std::get_if<Volume>(&imported)) {
      fuzz::check_mesh(*voxel_block(*volume, {}, "fuzz").mesh);
    } else if (auto* mesh = std::get_if<ImportedMesh>(&imported)) {
      fuzz::check_mesh(*opened(std::move(*mesh), "fuzz", {}, {}).mesh);
    }
  });
  return 0;
}

const fuzz::Target target("handover", read_once);

}  // namespace
}  // namespace chainmail::fuzz_handover
