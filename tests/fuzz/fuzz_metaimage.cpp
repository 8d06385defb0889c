#include "files/formats/metaimage.h"
#include "files/formats/voxel_block.h"
#include "fuzz/target.h"

namespace chainmail::fuzz_metaimage {
namespace {

int read_once(const std::uint8_t* data, std::size_t size) {
  fuzz::read_or_refuse([&] {
    const std::string_view file = fuzz::text_of(data, size);
    const MetaImageHead head = read_metaimage_head(file, "fuzz.mha");
    fuzz::expect(head.length <= file.size(), "a head longer than its file");
    const Volume volume = metaimage_volume(head, file.substr(head.length), "fuzz.mha");
    fuzz::expect(volume.densities.size() == volume.voxel_count(), "a volume that is not full");
    fuzz::check_mesh(*voxel_block(volume, {}, "fuzz.mha").mesh);
  });
  return 0;
}

const fuzz::Target target("metaimage", read_once);

}  // namespace
}  // namespace chainmail::fuzz_metaimage
