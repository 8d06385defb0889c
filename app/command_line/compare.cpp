#include "report/compare.h"

#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <ctime>
#include <iostream>

#include "command_line/common.h"
#include "command_line/folder.h"
#include "files/moves.h"
#include "files/outputs.h"
#include "files/report_json.h"
#include "files/text.h"
#include "mesh/error.h"
#include "report/html.h"
#include "report/runner.h"
#include "report/table.h"

namespace chainmail::command_line {
namespace {

struct Options {
  CLI::App* app = nullptr;
  CLI::Option *meshes, *output;
  CLI::Option *algorithms, *relax, *relaxation, *relax_step, *precision, *repetitions;
  CLI::Option *compression, *stretch, *shear, *moves;
};

constexpr const char* footer =
    "Without a MESH: six objects, a minute or two. Each object is dragged three times: locally, as a whole, and\n"
    "back and forth, from rest. FOLDER receives report.html, report.json and report.csv; the main table is printed.\n\n"
    "A script of moves is JSON; pin, unpin, cut, uncut and softness are commands as well:\n"
    "  {\"version\": 1, \"commands\": [{\"do\": \"pin\", \"elements\": [0]}, {\"do\": \"grab\", \"element\": 5},\n"
    "    {\"do\": \"drag\", \"target\": [1, 2, 0]}, {\"do\": \"drag\", \"target\": [2, 3, 0]}]}\n\n"
    "Example:\n"
    "  chainmail compare cloth.obj --algorithms natural-queue,exact --relax 0,10 -o report";

/// The words of a list parted by commas; each once.
std::vector<std::string> words_of(const std::string& where, const std::string& list) {
  std::vector<std::string> words;
  for (std::size_t begin = 0; begin <= list.size();) {
    const std::size_t end = std::min(list.find(',', begin), list.size());
    const std::string word = list.substr(begin, end - begin);
    if (std::find(words.begin(), words.end(), word) != words.end()) {
      throw Error(where, in_quotes(word) + " stands there twice", "name each once");
    }
    words.push_back(word);
    begin = end + 1;
  }
  return words;
}

std::vector<Algorithm> read_algorithms(const Options& options) {
  std::vector<std::string> names;
  for (const AlgorithmInfo& one : algorithms()) {
    names.emplace_back(one.name);
  }
  std::vector<Algorithm> chosen;
  if (const auto list = value_of(options.algorithms)) {
    for (const std::string& word : words_of("--algorithms", *list)) {
      check_word("--algorithms", word, names);
      chosen.push_back(*find_algorithm(word));
    }
  }
  return chosen;
}

std::vector<int> read_sweeps(const Options& options) {
  constexpr std::uint32_t most_sweeps = 1'000'000;
  std::vector<int> sweeps;
  for (const std::string& word : words_of("--relax", value_of(options.relax).value_or("0,10"))) {
    const auto count = parse_count(word);
    if (!count || *count > most_sweeps) {
      throw Error("--relax", in_quotes(word) + " is not a number of sweeps",
                  "write whole numbers up to 1000000, parted by commas");
    }
    sweeps.push_back(static_cast<int>(*count));
  }
  return sweeps;
}

report::CompareOptions read_options(const Options& options) {
  report::CompareOptions result;
  result.algorithms = read_algorithms(options);
  result.sweeps = read_sweeps(options);
  const std::string scheme = value_of(options.relaxation).value_or("mean");
  check_word("--relaxation", scheme, {"mean", "link"});
  result.scheme = scheme == "mean" ? RelaxationScheme::mean : RelaxationScheme::link;
  result.relax_step = value_of(options.relax_step, parameters::relax_step);
  const std::string precision = value_of(options.precision).value_or("float");
  check_word("--precision", precision, {"float", "double"});
  result.precision = precision == "float" ? Precision::single_precision : Precision::double_precision;
  if (options.repetitions->count() > 0) {
    result.repetitions = static_cast<int>(whole_number_of(options.repetitions, 1, 1));
  }
  return result;
}

/// The drags of an object: those recorded in a file, or the three that are made for it.
std::vector<report::RecordedMoves> drags_of(const report::Case& object, const std::optional<std::string>& recorded) {
  if (!recorded) {
    return report::three_drags(object);
  }
  const std::filesystem::path path = *recorded;
  report::RecordedMoves moves{"recorded", "as " + printable(path.filename().string()) + " has it",
                              read_moves(path, *object.mesh)};
  if (report::count_moves(moves) == 0) {
    throw Error(printable(*recorded), "there is no move in it", "write a grab and a drag, as compare --help has them");
  }
  return {std::move(moves)};
}

std::vector<report::Case> read_cases(const Options& options) {
  const LinkSoftness softness{value_of(options.compression, parameters::compression),
                              value_of(options.stretch, parameters::stretch),
                              value_of(options.shear, parameters::shear)};
  const auto recorded = value_of(options.moves);
  if (options.meshes->count() == 0 && recorded) {
    throw Error("--moves", "the mesh that they were recorded on is missing", "name its file");
  }
  if (options.meshes->count() == 0) {
    return report::default_cases(softness);
  }
  std::vector<report::Case> cases;
  for (const std::string& name : options.meshes->results()) {
    const std::filesystem::path path = name;
    OpenedMesh opened = chainmail::open_mesh(path);
    report::Case object{printable(path.filename().string()),
                        "as the file has it",
                        opened.mesh,
                        {},
                        {},
                        {softness, std::move(opened.softness)},
                        {}};
    object.drags = drags_of(object, recorded);
    cases.push_back(std::move(object));
  }
  return cases;
}

/// A line on standard error, where that is a terminal.
class ProgressLine {
 public:
  void show(double fraction, const std::string& text) {
    const auto now = std::chrono::steady_clock::now();
    if (is_terminal_ && (now - last_ > std::chrono::milliseconds(200) || fraction == 1)) {
      std::cerr << "\r\x1b[K" << (fraction == 1 ? "" : std::to_string(int(100 * fraction)) + "% " + text) << std::flush;
      last_ = now;
    }
  }

 private:
  bool is_terminal_ = isatty(STDERR_FILENO) != 0;
  std::chrono::steady_clock::time_point last_;
};

std::string now_in_words() {
  const std::time_t now = std::time(nullptr);
  std::tm parts{};
  gmtime_r(&now, &parts);
  char text[32];
  std::strftime(text, sizeof text, "%Y-%m-%d %H:%M UTC", &parts);
  return text;
}

void compare(const Options& options, const std::string& command_line) {
  const report::CompareOptions how = read_options(options);
  OutputFolder folder(*value_of(options.output));
  const std::vector<report::Case> cases = read_cases(options);

  ProgressLine line;
  const report::Comparison comparison =
      report::compare(cases, how, [&](double fraction, const std::string& text) { line.show(fraction, text); });
  const report::Origin origin{report::this_machine(), command_line, now_in_words(), "chainmail " CHAINMAIL_VERSION};

  folder.make();
  Outputs outputs;
  outputs.add(folder.path() / "report.html", [&](std::ostream& out) { write_html(out, comparison, origin); });
  outputs.add(folder.path() / "report.json", [&](std::ostream& out) { write_json(out, comparison, origin); });
  outputs.add(folder.path() / "report.csv", [&](std::ostream& out) { write_csv(out, comparison); });
  outputs.add("-", [&](std::ostream& out) { write_text(out, comparison); });
  outputs.commit();
  folder.keep();
}

void add_contest(CLI::App& app, Options& options) {
  options.algorithms = add_value(app, "--algorithms", "A,B,…", "who takes part, by the names of deform [all]");
  options.relax = add_value(app, "--relax", "N,N,…", "each with so many sweeps of relaxation after a move [0,10]");
  options.relaxation = add_value(app, "--relaxation", "mean|link", "how an element relaxes [mean]");
  options.relax_step = add_parameter(app, parameters::relax_step);
  options.precision = add_value(app, "--precision", "float|double", "the numbers to compute in [float]");
  options.repetitions = add_value(app, "--repetitions", "N", "of each drag [as many as 4 s hold, 5 at least]");
}

}  // namespace

Command add_compare(CLI::App& root, const std::string& command_line) {
  CLI::App* app = root.add_subcommand("compare", "Report speed against error");
  Options options{};
  options.app = app;
  const std::string help = "meshes, files " + mesh_endings(FormatUse::read);
  options.meshes = app->add_option("MESH", help)
                       ->type_name("")
                       ->expected(-1)
                       ->allow_extra_args(true)
                       ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
  add_contest(*app, options);
  options.compression = add_parameter(*app, parameters::compression);
  options.stretch = add_parameter(*app, parameters::stretch);
  options.shear = add_parameter(*app, parameters::shear);
  options.moves = add_value(*app, "--moves", "FILE", "drag as recorded in this JSON script, from rest");
  options.output = add_value(*app, "-o", "FOLDER", "where the report goes; made where it is missing")->required();
  app->footer(footer);
  return {app, [options, command_line] { compare(options, command_line); }};
}

}  // namespace chainmail::command_line
