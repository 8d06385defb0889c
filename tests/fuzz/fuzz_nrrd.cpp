#include "files/formats/nrrd_head.h"
#include "fuzz/target.h"

namespace chainmail::fuzz_nrrd {
namespace {

int read_once(const std::uint8_t* data, std::size_t size) {
  fuzz::read_or_refuse([&] {
    const NrrdHead head = read_nrrd_head(fuzz::text_of(data, size), "fuzz.nhdr");
    // The header for teem names the link next to it, or no file.
    const NrrdHead again = read_nrrd_head(head.text, "fuzz.nhdr");
    fuzz::expect(again.data_files.size() == head.data_files.size(), "a header that names another number of files");
    for (std::size_t i = 0; i < again.data_files.size(); ++i) {
      fuzz::expect(again.data_files[i] == nrrd_data_name(i), "a header that names another file");
    }
    fuzz::expect(again.text == head.text, "a header that changes when it is read again");
  });
  return 0;
}

const fuzz::Target target("nrrd", read_once);

}  // namespace
}  // namespace chainmail::fuzz_nrrd
