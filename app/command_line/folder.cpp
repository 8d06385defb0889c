#include "command_line/folder.h"

#include <unistd.h>

#include <cerrno>
#include <system_error>

#include "command_line/common.h"
#include "report/page/physics_plot.h"

namespace chainmail::command_line {

namespace fs = std::filesystem;

OutputFolder::OutputFolder(fs::path path) : path_(std::move(path)) {
  if (path_.empty()) {
    throw Error("-o", "the folder's name is empty", "use the name of a folder");
  }
  std::error_code error;
  fs::path there = path_;
  while (!fs::exists(there, error) && there != there.root_path()) {
    there = there.has_parent_path() ? there.parent_path() : fs::path(".");
  }
  if (!fs::is_directory(there, error)) {
    throw Error("-o", shown(there) + " is not a folder", "use the name of a folder");
  }
  errno = 0;
  if (access(there.c_str(), W_OK | X_OK) != 0) {
    throw Error("-o", shown(there) + " cannot be written to (" + system_reason() + ")", "check its permissions");
  }
}

OutputFolder::~OutputFolder() {
  std::error_code ignored;
  for (auto folder = made_.rbegin(); folder != made_.rend(); ++folder) {
    fs::remove(*folder, ignored);  // keeps the folder if another program wrote into it
  }
}

void OutputFolder::make() {
  std::error_code error;
  std::vector<fs::path> missing;
  for (fs::path folder = fs::absolute(path_, error); !fs::exists(folder, error) && folder.has_relative_path();
       folder = folder.parent_path()) {
    missing.insert(missing.begin(), folder);
  }
  for (const fs::path& folder : missing) {
    if (fs::create_directory(folder, error)) {
      made_.push_back(folder);
    }
    if (error) {
      throw Error("-o", shown(folder) + " cannot be created (" + error.message() + ")",
                  "check the name and permissions");
    }
  }
}

void OutputFolder::say_older_plots(const std::set<std::string>& written) const {
  std::set<std::string> names{"overview.svg",    "fresh-grab.svg",     "after-cut.svg",
                              "growth-time.svg", "growth-prepare.svg", "growth-error.svg"};
  std::error_code error;
  for (std::size_t i = 1; fs::exists(path_ / report::object_plot(i), error); ++i) {
    names.insert(report::object_plot(i));
  }
  std::string older;
  for (const std::string& name : names) {
    if (!written.contains(name) && fs::exists(path_ / name, error)) {
      older += (older.empty() ? "" : ", ") + name;
    }
  }
  if (!older.empty()) {
    say_note(shown(path_) + " also has plots of an earlier report: " + older);
  }
}

}  // namespace chainmail::command_line
