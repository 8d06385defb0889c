#include "command_line/standard_input.h"

#include <array>
#include <cerrno>
#include <cstdio>
#include <fstream>

#include "chainmail/mesh_file.h"
#include "chainmail/text.h"

namespace chainmail::command_line {
namespace {

constexpr const char* name = "standard input";

void copy_standard_input(const std::filesystem::path& path) {
  std::ofstream file(path, std::ios::binary);
  std::array<char, std::size_t{1} << 16> part{};
  std::uint64_t size = 0;
  while (const std::size_t got = std::fread(part.data(), 1, part.size(), stdin)) {
    size += got;
    if (size > api::largest_file) {
      throw api::Error(name, "it is larger than 4 GiB", "use a smaller file");
    }
    errno = 0;
    if (!file.write(part.data(), static_cast<std::streamsize>(got))) {
      break;
    }
  }
  if (!file.flush()) {
    throw api::WriteFailure(api::shown(path), "it cannot be written to its end (" + api::system_reason() + ")",
                            api::system_remedy("free some space, or set TMPDIR to another folder"));
  }
}

}  // namespace

InputFile::InputFile(const std::filesystem::path& named) : path_(named) {
  if (named == "-") {
    folder_.emplace();
    path_ = folder_->path() / name;
    copy_standard_input(path_);
  }
}

api::Error InputFile::named(const api::Error& error) const {
  const std::string path = api::shown(path_);
  const bool is_copy = folder_ && error.where().starts_with(path);
  return is_copy ? error.at(name + error.where().substr(path.size())) : error;
}

}  // namespace chainmail::command_line
