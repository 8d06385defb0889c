#include "files/text/regular_file.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <system_error>
#include <utility>

#include "files/text/text.h"
#include "mesh/error.h"

namespace chainmail {
void require_file(const std::filesystem::path& path) {
  using std::filesystem::file_type;
  std::error_code error;
  switch (std::filesystem::status(path, error).type()) {
    case file_type::not_found:
      throw Error(shown(path), "there is no such file", "check the path");
    case file_type::directory:
      throw Error(shown(path), "it is a folder", "use a file");
    case file_type::fifo:
    case file_type::socket:
      throw Error(shown(path), "it is a pipe", "save its content as a file, and use that");
    case file_type::block:
    case file_type::character:
      throw Error(shown(path), "it is a device", "use a file");
    default:
      break;  // a file; opening reports missing permission
  }
}

RegularFile::RegularFile(const std::filesystem::path& path) : path_(path) {
  require_file(path);  // check first: opening a device may have side effects
  descriptor_ = open(path.c_str(), O_RDONLY | O_NONBLOCK | O_CLOEXEC | O_NOCTTY);
  struct stat status {};
  if (descriptor_ < 0 || fstat(descriptor_, &status) != 0) {
    const std::string why = system_reason(), remedy = system_remedy("check its permissions");
    close(descriptor_);
    throw Error(shown(path), "it cannot be read (" + why + ")", remedy);
  }
  if (!S_ISREG(status.st_mode)) {  // it was replaced in the meantime
    close(descriptor_);
    throw Error(shown(path), "it is no longer a file", "check the path");
  }
  size_ = static_cast<std::uint64_t>(status.st_size);
}

RegularFile::RegularFile(RegularFile&& other) noexcept
    : path_(std::move(other.path_)), descriptor_(std::exchange(other.descriptor_, -1)), size_(other.size_) {}

RegularFile::~RegularFile() {
  if (descriptor_ >= 0) {
    close(descriptor_);
  }
}

namespace {

/// Calls `read(done)`, which reads on after the bytes that are done, until all bytes are there or the file ends.
template <class Read>
std::size_t read_all(const std::filesystem::path& path, std::span<char> bytes, Read read) {
  std::size_t done = 0;
  while (done < bytes.size()) {
    const ssize_t got = read(done);
    if (got < 0 && errno != EINTR) {
      throw Error(shown(path), "it cannot be read to its end (" + system_reason() + ")", "check the disk");
    }
    if (got == 0) {
      break;
    }
    done += got > 0 ? static_cast<std::size_t>(got) : 0;
  }
  return done;
}

}  // namespace

std::size_t RegularFile::read(std::span<char> bytes) {
  return read_all(path_, bytes,
                  [&](std::size_t done) { return ::read(descriptor_, bytes.data() + done, bytes.size() - done); });
}

std::size_t RegularFile::read_at(std::uint64_t place, std::span<char> bytes) const {
  return read_all(path_, bytes, [&](std::size_t done) {
    return pread(descriptor_, bytes.data() + done, bytes.size() - done, static_cast<off_t>(place + done));
  });
}

std::filesystem::path resolved(const std::filesystem::path& path) {
  namespace fs = std::filesystem;
  constexpr int max_links = 40;
  std::error_code error;
  fs::path target = fs::weakly_canonical(fs::absolute(path, error), error);
  // A link that points nowhere counts as missing above, so it is followed here.
  for (int links = 0; !error && links < max_links && fs::is_symlink(fs::symlink_status(target, error)); ++links) {
    target = fs::weakly_canonical(target.parent_path() / fs::read_symlink(target, error), error);
  }
  return error && error != std::errc::no_such_file_or_directory ? path : target;
}

}  // namespace chainmail
