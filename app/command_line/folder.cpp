#include <unistd.h>

#include <cerrno>
#include <system_error>

#include "command_line/compare.h"

namespace chainmail::command_line {

namespace fs = std::filesystem;

OutputFolder::OutputFolder(fs::path path) : path_(std::move(path)) {
  require(!path_.empty(), "-o", "the folder's name is empty", "use the name of a folder");
  std::error_code error;
  fs::path there = path_;
  while (!fs::exists(there, error) && there != there.root_path()) {
    there = there.has_parent_path() ? there.parent_path() : fs::path(".");
  }
  require(fs::is_directory(there, error), "-o", shown(there) + " is not a folder", "use the name of a folder");
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
    require(!error, "-o", shown(folder) + " cannot be created (" + error.message() + ")",
            "check the name and permissions");
  }
}

void OutputFolder::say_older_plots(const std::set<std::string>& written) const {
  std::set<std::string> names{report::physics_plots.begin(), report::physics_plots.end()};
  for (const report::SpeedAgainstError& measure : report::speeds_against_error) {
    names.insert(std::string(measure.file) + ".svg");
  }
  std::error_code error;
  for (std::size_t i = 1; fs::exists(path_ / report::object_plot(i), error); ++i) {
    names.insert(report::object_plot(i));
  }
  std::vector<std::string> older;
  std::ranges::copy_if(names, std::back_inserter(older), [&](const std::string& name) {
    return !written.contains(name) && fs::exists(path_ / name, error);
  });
  if (!older.empty()) {
    say_note(shown(path_) + " also has plots of an earlier report: " + joined_words(older, ", "));
  }
}

void OutputFolder::write(const std::vector<std::pair<std::string, Outputs::Writer>>& files, const Outputs::Writer& text,
                         const std::vector<std::string>& read) {
  make();
  std::vector<OutputFile> outputs;
  std::set<std::string> written;
  for (const auto& [name, writer] : files) {
    outputs.push_back({path_ / name, writer});
    written.insert(name);
  }
  if (text) {
    outputs.push_back({standard_output, text});
  }
  write_outputs(read, outputs);
  made_.clear();
  if (text) {
    say_older_plots(written);
  }
}

}  // namespace chainmail::command_line
