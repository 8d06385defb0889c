#include <unistd.h>

#include <cerrno>
#include <set>
#include <system_error>

#include "command_line/compare.h"
#include "files/results/results_json.h"
#include "report/page/report.h"
#include "report/page/svg.h"
#include "report/table/summary.h"

namespace chainmail::command_line {

namespace fs = std::filesystem;

namespace {

/// Returns the names of plots of a report in a folder.
std::set<std::string> plots_in(const fs::path& folder) {
  std::error_code error;
  std::set<std::string> names;
  const auto add = [&](const std::string& name) {
    return fs::exists(folder / (name + ".svg"), error) && names.insert(name + ".svg").second;
  };
  for (const report::SpeedAgainstError& speed : report::speeds_against_error()) {
    add(std::string(speed.file));
  }
  for (const char* growth : {"growth-error", "growth-prepare", "growth-time"}) {
    add(growth);
  }
  for (const std::string of_object : {"object-", "violation-", "distance-"}) {
    for (int i = 1; add(of_object + std::to_string(i)); ++i) {
    }
  }
  return names;
}

}  // namespace

OutputFolder::OutputFolder(fs::path path, const std::vector<std::string>& files) : path_(std::move(path)) {
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
  for (const std::string& file : there == path_ ? files : std::vector<std::string>()) {
    check_outputs({}, {path_ / file});
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

void OutputFolder::write(std::vector<OutputFile> files, const std::vector<std::string>& read) {
  make();
  for (OutputFile& file : files) {
    if (file.path != standard_output) {
      file.path = path_ / *file.path;
    }
  }
  write_outputs(read, files);
  made_.clear();
}

void OutputFolder::write_report(const report::Results& results, const std::vector<std::string>& read) {
  const auto plots = plots_of(results);
  std::vector<OutputFile> files{{report_html, [&](std::ostream& out) { write_html(out, results); }},
                                {report_json, [&](std::ostream& out) { write_json(out, results); }},
                                {report_csv, [&](std::ostream& out) { write_csv(out, results); }}};
  for (const report::PlotFile& one : plots) {
    files.push_back({one.name, [&one](std::ostream& out) { write_svg(out, one.plot, report::file_ink); }});
  }
  files.push_back({standard_output, [&](std::ostream& out) { write_text(out, results); }});
  write(files, read);
  std::set<std::string> older = plots_in(path_);
  for (const report::PlotFile& plot : plots) {
    older.erase(plot.name);
  }
  if (!older.empty()) {
    say_note(shown(path_) +
             " also has plots of an earlier report: " + joined_words({older.begin(), older.end()}, ", "));
  }
}

}  // namespace chainmail::command_line
