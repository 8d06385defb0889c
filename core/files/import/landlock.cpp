#include "files/import/landlock.h"

#ifdef __linux__

#include <fcntl.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdint>

namespace chainmail::import {
namespace {

// The kernel's interface, which never changes (linux/landlock.h). Headers that are older than the kernel lack a part.
// The numbers of these calls are the same on all processors that ChainMail supports.
constexpr long create_ruleset = 444, add_rule = 445, restrict_self = 446;
constexpr unsigned ask_version = 1;  // a flag of create_ruleset
constexpr int path_beneath = 1;      // a kind of rule
constexpr std::uint64_t read_file = 1U << 2U, read_folder = 1U << 3U;

struct Ruleset {
  std::uint64_t handled;  // accesses that are denied without a rule
};
struct [[gnu::packed]] PathRule {
  std::uint64_t allowed;
  std::int32_t parent;  // the descriptor of a file, or of a folder and what is in it
};

/// Returns all accesses to files that a version knows, one bit for each.
std::uint64_t accesses(int version) {
  const int count = version >= 5 ? 16 : version >= 3 ? 15 : version == 2 ? 14 : 13;
  return (std::uint64_t{1} << unsigned(count)) - 1;
}

/// The rules, in a descriptor. Remembers errors.
class Rules {
 public:
  explicit Rules(int version) {
    const Ruleset all{accesses(version)};
    descriptor_ = int(syscall(create_ruleset, &all, sizeof all, 0));
    good_ = descriptor_ >= 0;
  }
  Rules(const Rules&) = delete;
  Rules& operator=(const Rules&) = delete;
  ~Rules() { close(descriptor_); }

  void allow(std::uint64_t access, int parent) {
    const PathRule rule{access, parent};
    const bool added = syscall(add_rule, descriptor_, path_beneath, &rule, 0) == 0;
    good_ = good_ && (added || errno == EBADFD);  // a file without a path, such as one in memory, needs no rule
  }
  void allow_folder(const std::filesystem::path& folder) {
    const int parent = open(folder.c_str(), O_PATH | O_DIRECTORY | O_CLOEXEC);
    allow(read_file | read_folder, parent);
    close(parent);
  }
  bool apply() const { return good_ && syscall(restrict_self, descriptor_, 0) == 0; }

 private:
  int descriptor_ = -1;
  bool good_ = false;
};

}  // namespace

int landlock_version() { return std::max(0, int(syscall(create_ruleset, nullptr, 0, ask_version))); }

bool give_up_files(const std::filesystem::path& folder, std::span<const int> files) {
  Rules rules(landlock_version());
  rules.allow_folder(folder);
  std::for_each(files.begin(), files.end(), [&](int file) { rules.allow(read_file, file); });
  return rules.apply();
}

}  // namespace chainmail::import

#endif
