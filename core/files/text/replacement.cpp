#include "files/text/replacement.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>
#if defined(__linux__)
#include <sys/xattr.h>
#endif

#include <array>
#include <cerrno>
#include <chrono>
#include <cstddef>
#include <cstdio>
#include <mutex>
#include <random>
#include <set>
#include <streambuf>
#include <string_view>
#include <system_error>
#include <utility>
#include <vector>

#include "files/text/text.h"

namespace chainmail {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view temporary_prefix = ".chainmail-", temporary_suffix = ".tmp";
constexpr std::chrono::hours leftover_age{24};

bool is_temporary(const fs::path& path) {
  const std::string name = path.filename().string();
  return name.starts_with(temporary_prefix) && name.ends_with(temporary_suffix);
}

/// Removes the temporary files that killed programs of this user left in a folder a day ago or earlier.
void remove_leftovers(const fs::path& folder) {
  std::error_code error;
  const auto now = fs::file_time_type::clock::now();
  for (fs::directory_iterator entry(folder, error), end; !error && entry != end; entry.increment(error)) {
    struct stat status {};
    std::error_code ignored;
    if (is_temporary(entry->path()) && lstat(entry->path().c_str(), &status) == 0 && S_ISREG(status.st_mode) &&
        status.st_uid == geteuid() && now - entry->last_write_time(ignored) > leftover_age && !ignored) {
      fs::remove(entry->path(), ignored);
    }
  }
}

/// Removes leftovers at the first write of this program into a folder.
void remove_leftovers_once(const fs::path& folder) {
  static std::mutex mutex;
  static std::set<fs::path> done;
  const std::lock_guard lock(mutex);
  if (done.insert(folder).second) {
    remove_leftovers(folder);
  }
}

/// Writes all bytes. Returns false if the system refuses, with the reason in errno.
bool write_all(int descriptor, const char* bytes, std::size_t size) {
  while (size > 0) {
    const ssize_t written = write(descriptor, bytes, size);
    if (written < 0 && errno != EINTR) {
      return false;
    }
    bytes += written > 0 ? written : 0;
    size -= static_cast<std::size_t>(written > 0 ? written : 0);
  }
  return true;
}

/// Waits until the disk has what was written. Some file systems cannot say so, which is no error.
bool sync(int descriptor) {
  int result = 0;
  do {
    result = fsync(descriptor);
  } while (result != 0 && errno == EINTR);
  return result == 0 || errno == EINVAL || errno == ENOTSUP || errno == ENOSYS;
}

/// Copies extended attributes, access control lists among them, as far as the system allows it. Not capabilities: new
/// content must not inherit the rights of the old one.
void copy_attributes([[maybe_unused]] const fs::path& from, [[maybe_unused]] int to) {
#if defined(__linux__)
  const ssize_t size = listxattr(from.c_str(), nullptr, 0);
  if (size <= 0) {
    return;
  }
  std::string names(static_cast<std::size_t>(size), '\0');
  const ssize_t used = listxattr(from.c_str(), names.data(), names.size());
  for (std::size_t at = 0; used > 0 && at < static_cast<std::size_t>(used);) {
    const std::string name(names.c_str() + at);
    at += name.size() + 1;
    const ssize_t length = name == "security.capability" ? -1 : getxattr(from.c_str(), name.c_str(), nullptr, 0);
    std::vector<char> value(static_cast<std::size_t>(length > 0 ? length : 0));
    if (length >= 0 && getxattr(from.c_str(), name.c_str(), value.data(), value.size()) == length) {
      static_cast<void>(fsetxattr(to, name.c_str(), value.data(), value.size(), 0));
    }
  }
#endif
}

/// Gives a file the owner, the group and the permissions of another one. Without its group, the permissions of the
/// group would go to strangers, so they become those of all others.
void copy_access(const struct stat& from, int to) {
  mode_t mode = from.st_mode & 0777U;
  if (fchown(to, from.st_uid, from.st_gid) != 0 && fchown(to, static_cast<uid_t>(-1), from.st_gid) != 0) {
    mode = (mode & ~070U) | ((mode & 07U) << 3U);
  }
  static_cast<void>(fchmod(to, mode));
}

/// The user may not make or replace files in the folder, whatever the disk holds.
bool is_refusal(int error) {
  return error == EACCES || error == EPERM || error == EROFS || error == EBUSY || error == EXDEV || error == ETXTBSY;
}

}  // namespace

/// Buffers what is written to a descriptor.
class Replacement::Buffer : public std::streambuf {
 public:
  explicit Buffer(int descriptor) : descriptor_(descriptor) { setp(block_.data(), block_.data() + block_.size()); }

  /// The reason of the first failure, as in errno; 0 for none.
  int error() const { return error_; }

 protected:
  int_type overflow(int_type character) override {
    if (!empty()) {
      return traits_type::eof();
    }
    if (!traits_type::eq_int_type(character, traits_type::eof())) {
      sputc(traits_type::to_char_type(character));
    }
    return traits_type::not_eof(character);
  }
  std::streamsize xsputn(const char* text, std::streamsize size) override {
    if (size < epptr() - pptr()) {
      return std::streambuf::xsputn(text, size);
    }
    return empty() && wrote(text, size) ? size : 0;
  }
  int sync() override { return empty() ? 0 : -1; }

 private:
  bool empty() {
    const bool written = wrote(pbase(), pptr() - pbase());
    setp(block_.data(), block_.data() + block_.size());
    return written;
  }
  bool wrote(const char* text, std::streamsize size) {
    if (error_ == 0 && !write_all(descriptor_, text, static_cast<std::size_t>(size))) {
      error_ = errno;
    }
    return error_ == 0;
  }

  int descriptor_;
  int error_ = 0;
  std::array<char, std::size_t{1} << 13> block_;
};

Replacement::Replacement(fs::path path, fs::path target, Readers readers)
    : path_(std::move(path)), target_(std::move(target)), folder_(target_.parent_path()) {
  if (folder_.empty()) {
    folder_ = ".";
  }
  remove_leftovers_once(folder_);
  struct stat status {};
  const bool exists = stat(target_.c_str(), &status) == 0;
  const int mode = exists || readers == Readers::owner ? 0600 : 0666;  // an existing file's own follow in finish()
  open_unnamed(mode);
  if (descriptor_ < 0) {
    open_named(mode);
  }
  if (descriptor_ < 0) {
    if (is_refusal(errno) && exists) {
      fail_to_replace();
    }
    throw Error(shown(path_), "it cannot be written (" + system_reason() + ")",
                system_remedy("check the name and its folder's permissions"));
  }
  buffer_ = std::make_unique<Buffer>(descriptor_);
  stream_ = std::make_unique<std::ostream>(buffer_.get());
}

Replacement::Replacement(fs::path path, fs::path target, fs::path made)
    : path_(std::move(path)),
      target_(std::move(target)),
      folder_(target_.parent_path()),
      temporary_(std::move(made)),
      descriptor_(open(temporary_.c_str(), O_WRONLY | O_CLOEXEC)),
      state_(State::named) {
  if (folder_.empty()) {
    folder_ = ".";
  }
  if (descriptor_ < 0) {
    throw Error(shown(path_), "it cannot be written (" + system_reason() + ")", "check the permissions of its folder");
  }
}

Replacement::~Replacement() {
  close_descriptor();
  std::error_code ignored;
  for (const fs::path& left : {temporary_, backup_}) {
    if (!left.empty()) {
      fs::remove(left, ignored);
    }
  }
}

void Replacement::close_descriptor() {
  if (descriptor_ >= 0) {
    close(descriptor_);
    descriptor_ = -1;
  }
}

void Replacement::open_unnamed([[maybe_unused]] int mode) {
#if defined(O_TMPFILE)
  if (access("/proc/self/fd", X_OK) == 0) {  // name() needs it
    descriptor_ = open(folder_.c_str(), O_TMPFILE | O_WRONLY | O_CLOEXEC, mode);
  }
#endif
}

void Replacement::open_named(int mode) {
  do {
    temporary_ = free_name();
    descriptor_ = open(temporary_.c_str(), O_CREAT | O_EXCL | O_NOFOLLOW | O_WRONLY | O_CLOEXEC, mode);
  } while (descriptor_ < 0 && errno == EEXIST);
  if (descriptor_ < 0) {
    temporary_.clear();
    return;
  }
  state_ = State::named;
}

fs::path Replacement::free_name() const {
  // The name is short and does not contain the target's name, which may already have the largest possible length.
  static std::mutex mutex;
  static std::random_device random;
  const std::lock_guard lock(mutex);
  return folder_ / (std::string(temporary_prefix) + std::to_string(random()) + std::string(temporary_suffix));
}

std::ostream& Replacement::stream() { return *stream_; }

void Replacement::fail_to_write() const {
  throw WriteFailure(shown(path_), "it cannot be written to its end (" + system_reason() + ")",
                     system_remedy("free disk space, or write to another disk"));
}

void Replacement::fail_to_replace() const {
  throw NotReplaceable(shown(path_), "it cannot be replaced (" + system_reason() + ")",
                       "check the permissions of its folder, or write to another folder");
}

void Replacement::keep_properties() const {
  struct stat status {};
  if (stat(target_.c_str(), &status) == 0) {
    copy_attributes(target_, descriptor_);
    copy_access(status, descriptor_);
  }
}

void Replacement::finish() {
  if (stream_ && !stream_->flush()) {
    errno = buffer_->error();
    fail_to_write();
  }
  keep_properties();
  if (!sync(descriptor_)) {
    fail_to_write();
  }
  if (state_ == State::named) {  // there may be more files than descriptors
    close_descriptor();
  }
}

void Replacement::name() {
  if (state_ != State::unnamed) {
    return;
  }
  const std::string content = "/proc/self/fd/" + std::to_string(descriptor_);
  int result = 0;
  do {
    temporary_ = free_name();
    result = linkat(AT_FDCWD, content.c_str(), AT_FDCWD, temporary_.c_str(), AT_SYMLINK_FOLLOW);
  } while (result != 0 && errno == EEXIST);
  if (result != 0) {
    temporary_.clear();
    is_refusal(errno) ? fail_to_replace() : fail_to_write();
  }
  state_ = State::named;
}

bool Replacement::exchange() const {
#if defined(RENAME_EXCHANGE)
  return renameat2(AT_FDCWD, temporary_.c_str(), AT_FDCWD, target_.c_str(), RENAME_EXCHANGE) == 0;
#else
  return false;
#endif
}

void Replacement::put(bool keeps_old) {
  struct stat status {};
  const bool is_new = lstat(target_.c_str(), &status) != 0;
  if (!is_new && !S_ISREG(status.st_mode)) {  // a folder, for example, has taken its place
    errno = S_ISDIR(status.st_mode) ? EISDIR : EEXIST;
    fail_to_write();
  }
  if (keeps_old && !is_new) {
    if (exchange()) {
      state_ = State::exchanged;
      return;
    }
    backup_ = free_name();
    if (link(target_.c_str(), backup_.c_str()) != 0) {
      backup_.clear();
    }
  }
  if (rename(temporary_.c_str(), target_.c_str()) != 0) {
    is_refusal(errno) && !is_new ? fail_to_replace() : fail_to_write();
  }
  temporary_.clear();
  state_ = is_new ? State::added : backup_.empty() ? State::replaced : State::backed_up;
}

void Replacement::take_back() {
  std::error_code ignored;
  if (state_ == State::exchanged) {
    if (!exchange()) {
      temporary_.clear();  // it has the old content, which must not be removed
    }
  } else if (state_ == State::backed_up) {
    fs::rename(backup_, target_, ignored);
    backup_.clear();
  } else if (state_ == State::added) {
    fs::remove(target_, ignored);
  }
  state_ = State::replaced;
}

void Replacement::sync_folder() const {
  const int folder = open(folder_.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (folder < 0) {
    return;  // a folder that may be written and not listed
  }
  errno = 0;
  const bool synced = sync(folder);
  const int reason = errno;
  close(folder);
  if (!synced) {
    errno = reason;
    throw WriteFailure(shown(path_), "it was written, but the disk does not confirm it (" + system_reason() + ")",
                       "check the disk, and write it to another one as well");
  }
}

void write_in_place(const fs::path& path, const std::string& content) {
  errno = 0;
  const int descriptor = open(path.c_str(), O_WRONLY | O_CLOEXEC);
  struct stat status {};
  bool written = descriptor >= 0 && fstat(descriptor, &status) == 0 && S_ISREG(status.st_mode);
  if (written && static_cast<std::size_t>(status.st_size) < content.size()) {
    const int error = posix_fallocate(descriptor, 0, static_cast<off_t>(content.size()));
    written = error == 0 || error == EINVAL || error == EOPNOTSUPP;  // the last two: it cannot reserve space
    if (!written) {
      static_cast<void>(ftruncate(descriptor, status.st_size));
      errno = error;
    }
  }
  written = written && write_all(descriptor, content.data(), content.size()) &&
            ftruncate(descriptor, static_cast<off_t>(content.size())) == 0 && sync(descriptor);
  const int reason = errno;
  if (descriptor >= 0) {
    close(descriptor);
  }
  if (!written) {
    errno = reason;
    throw WriteFailure(shown(path), "it cannot be written (" + system_reason() + ")",
                       system_remedy("free disk space, or write to another disk"));
  }
}

}  // namespace chainmail
