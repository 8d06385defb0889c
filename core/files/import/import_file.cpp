#include "files/import/import_file.h"

#include <utility>

#include "files/formats/data_file.h"
#include "files/formats/msh.h"
#include "files/formats/nrrd_head.h"
#include "files/import/import_process.h"
#include "files/text/limits.h"
#include "files/text/text.h"
#include "mesh/error.h"

namespace chainmail {
namespace {

// Bytes of a refused file in which its fault is looked for. Raw numbers may look like a decimal comma.
constexpr std::size_t max_text = std::size_t{1} << 24;
constexpr std::size_t max_maybe_binary = std::size_t{1} << 20;

/// Throws Error at the first number with a decimal comma.
void refuse_decimal_commas(std::string_view text, const std::filesystem::path& path) {
  Lines lines(text);
  while (lines.next()) {
    std::string_view rest = lines.line();
    for (auto word = take_word(rest); !word.empty(); word = take_word(rest)) {
      if (has_decimal_comma(word)) {
        throw Error(shown(path, lines.number()), in_quotes(word) + " is not a number", number_remedy(word));
      }
    }
  }
}

/// Throws Error at the line that is wrong, where it can be found: libraries do not say where it is.
void find_fault(const std::string& task, const RegularFile& file) {
  std::string text(max_text, '\0');
  text.resize(file.read_at(0, text));
  refuse_decimal_commas(std::string_view(text).substr(0, max_maybe_binary), file.path());
  if (task == "msh" && text.size() < max_text) {
    check_msh(text, file.path());
  }
}

}  // namespace

/// Libraries recognise a format by the name: the file is linked under one with the right ending.
ImportedMesh import_mesh(const std::string& task, RegularFile file, int passes, const Progress& progress,
                         const std::filesystem::path& program) {
  ImportInput input(file.path(), passes);
  input.link("mesh." + task, std::move(file));
  try {
    return run_import_of<ImportedMesh>(task, input, {}, limits_for(input.linked_size()), progress, program);
  } catch (const Error&) {
    find_fault(task, input.linked().front());
    throw;
  }
}

/// If the data are in files of their own, teem gets a header that names links to them.
Volume import_nrrd(RegularFile file, bool outside, const Progress& progress, const std::filesystem::path& program) {
  const std::filesystem::path path = file.path();
  std::string beginning(limits::nrrd_header_bytes, '\0');
  beginning.resize(file.read(beginning));
  const NrrdHead head = read_nrrd_head(beginning, path);
  ImportInput input(path);
  if (head.data_files.empty()) {
    input.link("volume.nrrd", std::move(file));
  } else {
    input.write("volume.nhdr", head.text);
    for (std::size_t i = 0; i < head.data_files.size(); ++i) {
      input.link(nrrd_data_name(i), RegularFile(data_file(path, head.data_files[i], outside)));
    }
  }
  return run_import_of<Volume>("nrrd", input, {}, limits_for(input.linked_size()), progress, program);
}

}  // namespace chainmail
