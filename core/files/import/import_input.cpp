#include "files/import/import_input.h"

#include <unistd.h>

#include <cassert>
#include <cerrno>
#include <fstream>
#include <numeric>
#include <utility>

#include "files/import/channels.h"
#include "files/text/outputs.h"
#include "files/text/text.h"

namespace chainmail {
namespace {

[[noreturn]] void fail_writing(const std::filesystem::path& path, const std::string& problem) {
  const std::string why = system_reason();
  throw WriteFailure(shown(path), problem + " (" + why + ")",
                     system_remedy("free some space, or set TMPDIR to another folder"));
}

}  // namespace

void ImportInput::link(const std::string& name, RegularFile file) {
  const int channel = import::first_input + static_cast<int>(linked_.size());
  assert(channel <= import::last_input);
  const auto path = folder() / name;
  if (symlink(("/proc/self/fd/" + std::to_string(channel)).c_str(), path.c_str()) != 0) {
    fail_writing(path, "a link cannot be created");
  }
  linked_.push_back(std::move(file));
  name_first(name);
}

void ImportInput::write(const std::string& name, std::string_view bytes) {
  const auto path = folder() / name;
  errno = 0;
  std::ofstream file(path, std::ios::binary);
  if (!file.write(bytes.data(), static_cast<std::streamsize>(bytes.size())).flush()) {
    fail_writing(path, "it cannot be written to its end");
  }
  name_first(name);
}

std::uint64_t ImportInput::linked_size() const {
  return std::accumulate(linked_.begin(), linked_.end(), std::uint64_t{0},
                         [](std::uint64_t sum, const RegularFile& file) { return sum + file.size(); });
}

void ImportInput::name_first(const std::string& name) {
  if (main_name_.empty()) {
    main_name_ = name;
  }
}

}  // namespace chainmail
