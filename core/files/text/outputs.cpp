#include "files/text/outputs.h"

#include <algorithm>
#include <cerrno>
#include <fstream>
#include <iostream>
#include <string>
#include <system_error>

#include "files/text/regular_file.h"
#include "files/text/text.h"

namespace chainmail {
namespace {

namespace fs = std::filesystem;

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

void Outputs::refuse_twice(const fs::path& path, const fs::path& target) {
  if (!targets_.insert(target).second) {
    throw Error(path == "-" ? "standard output" : shown(path), "two outputs have this name",
                "use a different file for each");
  }
}

void Outputs::keep(const fs::path& input) { inputs_.push_back(input == "-" ? "/dev/stdin" : input); }

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
  auto file = std::make_unique<Replacement>(path, target, readers);
  writer(file->stream());
  file->finish();
  files_.push_back(std::move(file));
}

void Outputs::take(const fs::path& path, const fs::path& made) {
  const fs::path target = resolved(path);
  refuse_twice(path, target);
  refuse_unwritable(path, target, fs::status(path));
  auto file = std::make_unique<Replacement>(path, target, made);
  file->finish();
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

void Outputs::replace_all() {
  for (const auto& file : files_) {
    file->name();
  }
  auto next = files_.begin();
  try {
    for (; next != files_.end(); ++next) {
      (*next)->put(files_.size() > 1);
    }
  } catch (...) {
    while (next != files_.begin()) {
      (*--next)->take_back();
    }
    throw;
  }
}

void Outputs::sync_folders() {
  std::set<fs::path> synced;
  for (const auto& file : files_) {
    if (synced.insert(file->folder()).second) {
      file->sync_folder();
    }
  }
}

void Outputs::commit() {
  write_streams();
  replace_all();
  sync_folders();
  files_.clear();
  targets_.clear();
}

void write_file(const fs::path& path, const Outputs::Writer& writer, Readers readers) {
  Outputs outputs;
  outputs.add(path, writer, readers);
  outputs.commit();
}

}  // namespace chainmail
