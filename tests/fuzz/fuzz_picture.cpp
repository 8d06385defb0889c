#include "files/formats/bare_picture.h"
#include "fuzz/target.h"

namespace chainmail::fuzz_picture {
namespace {

int read_once(const std::uint8_t* data, std::size_t size) {
  fuzz::read_or_refuse([&] {
    const BarePicture picture = bare_picture(std::string(fuzz::text_of(data, size)), "fuzz.png");
    fuzz::expect(picture.bytes.size() <= size, "a picture that grew");
    const BarePicture again = bare_picture(picture.bytes, "fuzz.png");
    fuzz::expect(again.bytes == picture.bytes && again.scans == picture.scans, "a picture that changes again");
  });
  return 0;
}

const fuzz::Target target("picture", read_once);

}  // namespace
}  // namespace chainmail::fuzz_picture
