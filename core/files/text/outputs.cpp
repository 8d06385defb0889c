#include "files/text/outputs.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <fstream>
#include <iostream>
#include <random>
#include <streambuf>
#include <string>
#include <system_error>
#include <utility>

#include "files/text/regular_file.h"
#include "files/text/text.h"

namespace chainmail {
namespace {

namespace fs = std::filesystem;

/// Waits until the disk has what was written. Some file systems cannot say so, which is no error.
bool sync(int descriptor) {
  int result = 0;
  do {
    result = fsync(descriptor);
  } while (result != 0 && errno == EINTR);
  return result == 0 || errno == EINVAL || errno == ENOTSUP || errno == ENOSYS;
}

/// Buffers what is written to a descriptor.
class Buffer : public std::streambuf {
 public:
  explicit Buffer(int descriptor) : descriptor_(descriptor) { setp(block_.data(), block_.data() + block_.size()); }

  /// The reason of the first failure, as in errno; 0 for none.
  int error() const { return error_; }

 protected:
  int_type overflow(int_type character) override {
    if (sync() != 0) {
      return traits_type::eof();
    }
    if (!traits_type::eq_int_type(character, traits_type::eof())) {
      sputc(traits_type::to_char_type(character));
    }
    return traits_type::not_eof(character);
  }
  int sync() override {
    for (const char* from = pbase(); from < pptr() && error_ == 0;) {
      const ssize_t written = write(descriptor_, from, std::size_t(pptr() - from));
      from += std::max<ssize_t>(written, 0);
      error_ = written < 0 && errno != EINTR ? errno : 0;
    }
    setp(block_.data(), block_.data() + block_.size());
    return error_ == 0 ? 0 : -1;
  }

 private:
  int descriptor_;
  int error_ = 0;
  std::array<char, std::size_t{1} << 16> block_;
};

void refuse_unwritable(const fs::path& path, const fs::path& target, const fs::file_status& status) {
  if (fs::is_directory(status) || !target.has_filename()) {
    throw Error(shown(path), "it is a folder", "use a file");
  }
  std::error_code error;
  if (target.has_parent_path() && !fs::is_directory(target.parent_path(), error)) {
    throw Error(shown(path), "its folder does not exist", "create the folder first");
  }
  // The later rename would replace even a write-protected file.
  if (fs::exists(status) && !std::ofstream(target, std::ios::app)) {
    throw Error(shown(path), "it cannot be written (" + system_reason() + ")", "check its permissions");
  }
}

void write_stream(std::ostream& out, const fs::path& path, const Outputs::Writer& writer) {
  errno = 0;
  writer(out);
  out.flush();
  if (!out) {
    throw WriteFailure(path == "-" ? "standard output" : shown(path),
                       "it cannot be written to its end (" + system_reason() + ")",
                       "free disk space, or check the program that reads the pipe");
  }
}

}  // namespace

/// The new content of one file, beside it.
class Outputs::Replacement {
 public:
  /// `path` is what the user entered, for messages; `target` is the same without symbolic links.
  Replacement(fs::path path, fs::path target) : path_(std::move(path)), target_(std::move(target)) {}
  Replacement(const Replacement&) = delete;
  Replacement& operator=(const Replacement&) = delete;
  /// Removes the new content unless it was put in place.
  ~Replacement() {
    std::error_code ignored;
    if (!made_.empty()) {
      fs::remove(made_, ignored);
    }
  }

  void write(const Writer& writer, Readers readers) {
    const int descriptor = make(readers == Readers::owner ? 0600 : 0666);
    const Closing closing{descriptor};
    Buffer buffer(descriptor);
    std::ostream out(&buffer);
    writer(out);
    if (!out.flush()) {
      errno = buffer.error();
      fail_to_write();
    }
    finish(descriptor);
  }
  void take(const fs::path& made) {
    made_ = made;
    const int descriptor = open(made_.c_str(), O_WRONLY | O_CLOEXEC);
    const Closing closing{descriptor};
    if (descriptor < 0) {
      fail_to_write();
    }
    finish(descriptor);
  }
  void put() {
    if (rename(made_.c_str(), target_.c_str()) != 0) {
      throw WriteFailure(shown(path_), "it cannot be replaced (" + system_reason() + ")",
                         system_remedy("check the permissions of its folder, or write to another folder"));
    }
    made_.clear();
  }
  /// Waits until the disk has the new name.
  void sync_folder() const {
    const int descriptor = open(folder().c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
    const Closing closing{descriptor};
    if (descriptor >= 0 && !sync(descriptor)) {  // a folder may be written and not listed
      throw WriteFailure(shown(path_), "it was written, but the disk does not confirm it (" + system_reason() + ")",
                         "check the disk, and write it to another one as well");
    }
  }

 private:
  struct Closing {
    int descriptor;
    ~Closing() { static_cast<void>(descriptor >= 0 && close(descriptor)); }
  };

  fs::path folder() const { return target_.has_parent_path() ? target_.parent_path() : "."; }

  /// Makes the file. Its name does not contain that of the target, which may have the largest possible length.
  int make(mode_t mode) {
    std::random_device random;
    int descriptor = -1;
    do {
      made_ = folder() / (".chainmail-" + std::to_string(random()) + ".tmp");
      descriptor = open(made_.c_str(), O_CREAT | O_EXCL | O_NOFOLLOW | O_WRONLY | O_CLOEXEC, mode);
    } while (descriptor < 0 && errno == EEXIST);
    if (descriptor < 0) {
      made_.clear();
      throw Error(shown(path_), "it cannot be written (" + system_reason() + ")",
                  system_remedy("check the name and its folder's permissions"));
    }
    return descriptor;
  }

  /// Gives the content the permissions of the target, but no set-user-ID, and waits until the disk has it.
  void finish(int descriptor) const {
    struct stat status {};
    if (stat(target_.c_str(), &status) == 0) {
      static_cast<void>(fchmod(descriptor, status.st_mode & 0777U));
    }
    if (!sync(descriptor)) {
      fail_to_write();
    }
  }

  [[noreturn]] void fail_to_write() const {
    throw WriteFailure(shown(path_), "it cannot be written to its end (" + system_reason() + ")",
                       system_remedy("free disk space, or write to another disk"));
  }

  fs::path path_, target_;
  fs::path made_;  // the new content
};

Outputs::Outputs() = default;

Outputs::~Outputs() = default;

void Outputs::refuse_twice(const fs::path& path, const fs::path& target) {
  if (!targets_.insert(target).second) {
    throw Error(path == "-" ? "standard output" : shown(path), "two outputs have this name",
                "use a different file for each");
  }
}

void Outputs::keep(const fs::path& input) { inputs_.push_back(input); }

/// True if an output is the file of an input, under whatever name. Devices and pipes may be both.
bool Outputs::is_input(const fs::path& output) const {
  std::error_code ignored;
  return fs::is_regular_file(output, ignored) &&
         std::ranges::any_of(inputs_, [&](const fs::path& input) { return fs::equivalent(input, output, ignored); });
}

void Outputs::add(const fs::path& path, Writer writer, Readers readers) {
  if (path.empty()) {
    throw Error("file name", "it is empty", "use the name of a file, or - for standard output");
  }
  std::error_code error;
  const fs::path target = resolved(path);  // keeps a symbolic link, and replaces the file that it points to
  const auto status = fs::status(path, error);
  if (path != "-" && status.type() == fs::file_type::none) {  // for example a link that leads to itself
    throw Error(shown(path), "it cannot be written (" + error.message() + ")", "check the name");
  }
  refuse_twice(path, target);
  if (path != "-" && is_input(target)) {
    throw Error(shown(path), "it is an input, and this output would replace it", "choose another name for the output");
  }
  if (path == "-" || (fs::exists(status) && !fs::is_regular_file(status) && !fs::is_directory(status))) {
    streams_.push_back({path, std::move(writer)});
    return;
  }
  refuse_unwritable(path, target, status);
  auto file = std::make_unique<Replacement>(path, target);
  file->write(writer, readers);
  files_.push_back(std::move(file));
}

void Outputs::take(const fs::path& path, const fs::path& made) {
  const fs::path target = resolved(path);
  refuse_twice(path, target);
  refuse_unwritable(path, target, fs::status(path));
  auto file = std::make_unique<Replacement>(path, target);
  file->take(made);
  files_.push_back(std::move(file));
}

void Outputs::write_streams() {
  for (const Stream& stream : streams_) {
    if (stream.path == "-") {
      write_stream(std::cout, stream.path, stream.writer);
    } else {
      std::ofstream out(stream.path, std::ios::binary);
      write_stream(out, stream.path, stream.writer);
    }
  }
  streams_.clear();
}

void Outputs::commit() {
  write_streams();
  for (const auto& file : files_) {
    file->put();
  }
  for (const auto& file : files_) {
    file->sync_folder();
  }
  files_.clear();
  targets_.clear();
}

void write_file(const fs::path& path, const Outputs::Writer& writer, Readers readers) {
  Outputs outputs;
  outputs.add(path, writer, readers);
  outputs.commit();
}

}  // namespace chainmail
