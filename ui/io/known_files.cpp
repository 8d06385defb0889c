#include "io/known_files.h"

#include <sys/stat.h>

#include "common/as_path.h"

namespace chainmail {

std::optional<FileState> stateOf(const QString& path) {
  struct stat status {};
  if (stat(asPath(path).c_str(), &status) != 0) {
    return std::nullopt;
  }
  return FileState{std::uint64_t(status.st_dev), std::uint64_t(status.st_ino), std::uint64_t(status.st_size),
                   std::int64_t(status.st_mtim.tv_sec), std::int64_t(status.st_mtim.tv_nsec)};
}

void KnownFiles::know(const QString& path, const std::optional<FileState>& state) {
  if (state) {
    known_[path] = *state;
  } else {
    known_.erase(path);
  }
}

bool KnownFiles::isChanged(const QString& path) const {
  const auto known = known_.find(path);
  const auto now = stateOf(path);
  return known != known_.end() && now && *now != known->second;
}

}  // namespace chainmail
