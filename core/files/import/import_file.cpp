#include "files/import/import_file.h"

#include <utility>

#include "files/formats/data_file.h"
#include "files/formats/nrrd_head.h"
#include "files/import/import_process.h"
#include "files/text/limits.h"
#include "files/text/regular_file.h"
#include "files/text/text.h"
#include "mesh/error.h"

namespace chainmail {
namespace {

/// Throws Error at the first number with a decimal comma. Libraries do not say where it is, or what is wrong with it.
void refuse_decimal_commas(const std::filesystem::path& path) {
  std::string beginning(std::size_t{1} << 20, '\0');
  beginning.resize(RegularFile(path).read(beginning));
  Lines lines(beginning);
  while (lines.next()) {
    std::string_view rest = lines.line();
    for (auto word = take_word(rest); !word.empty(); word = take_word(rest)) {
      if (has_decimal_comma(word)) {
        throw Error(shown(path, lines.number()), in_quotes(word) + " is not a number", number_remedy(word));
      }
    }
  }
}

}  // namespace

/// Libraries recognise a format by the name: the file is linked under one with the right ending.
ImportedMesh import_mesh(const std::string& task, const std::filesystem::path& path, int passes,
                         const Progress& progress, const std::filesystem::path& program) {
  ImportInput input(path, passes);
  input.link("mesh." + task, RegularFile(path));
  try {
    return run_import_of<ImportedMesh>(task, input, {}, limits_for(input.linked_size()), progress, program);
  } catch (const Error&) {
    refuse_decimal_commas(path);
    throw;
  }
}

/// If the data are in a file of their own, teem gets a header that names a link to it.
Volume import_nrrd(const std::filesystem::path& path, bool outside, const Progress& progress,
                   const std::filesystem::path& program) {
  RegularFile file(path);
  std::string beginning(limits::nrrd_header_bytes, '\0');
  beginning.resize(file.read(beginning));
  const NrrdHead head = read_nrrd_head(beginning, path);
  ImportInput input(path);
  if (head.data_file.empty()) {
    input.link("volume.nrrd", std::move(file));
  } else {
    input.write("volume.nhdr", head.text);
    input.link("data", RegularFile(data_file(path, head.data_file, outside)));
  }
  return run_import_of<Volume>("nrrd", input, {}, limits_for(input.linked_size()), progress, program);
}

}  // namespace chainmail
