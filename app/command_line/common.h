#pragma once

#include <CLI/CLI.hpp>
#include <algorithm>
#include <filesystem>
#include <functional>
#include <iterator>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

#include "command_line/progress_line.h"
#include "files/mesh/input_file.h"
#include "files/text/outputs.h"
#include "files/text/regular_file.h"
#include "files/text/text.h"
#include "mesh/described.h"
#include "mesh/error.h"
#include "mesh/parameters.h"
#include "report/table/machine.h"
#include "solver/algorithms.h"
#include "solver/deformer.h"

namespace chainmail::command_line {

/// Parses the arguments and runs the command. Throws Error for bad usage and bad input.
void run(int argc, char** argv);

/// A subcommand: its parser and the function that runs it.
struct Command {
  CLI::App* app;
  std::function<void()> run;
};
Command add_generate(CLI::App& root);
Command add_convert(CLI::App& root);
Command add_fill(CLI::App& root);
Command add_repair(CLI::App& root);
Command add_simplify(CLI::App& root);
Command add_info(CLI::App& root);
Command add_deform(CLI::App& root);
// `command_line` is shown in the report.
Command add_compare(CLI::App& root, const std::string& command_line);
Command add_ramp(CLI::App& root, const std::string& command_line);
Command add_calibrate(CLI::App& root);
/// Adds the command that prints a script with which a shell completes subcommands, options and values. The script is
/// made from the options of all commands of `root`.
Command add_completion(CLI::App& root);

// Options and their values

/// Throws Error unless a condition of the user's input holds.
void require(bool holds, const std::string& where, const std::string& problem, const std::string& remedy);

/// The words of an option, and what they stand for.
template <class Value>
using Choices = std::vector<std::pair<std::string, Value>>;
inline const Choices<bool> on_or_off{{"on", true}, {"off", false}};
/// The numbers of coordinates of a mesh.
inline const Choices<int> spaces{{"1", 1}, {"2", 2}, {"3", 3}};

/// Returns the names of the rows of a table of core, and what `value` makes of each row.
template <class Rows, class Of>
auto choices_of(const Rows& rows, Of value) {
  Choices<std::decay_t<std::invoke_result_t<Of, decltype(*std::begin(rows))>>> all;
  for (const auto& row : rows) {
    all.emplace_back(row.name, std::invoke(value, row));
  }
  return all;
}
/// Returns the words, in their order.
template <class Value>
std::vector<std::string> names_of(const Choices<Value>& choices) {
  std::vector<std::string> names;
  for (const auto& choice : choices) {
    names.push_back(choice.first);
  }
  return names;
}
/// Throws Error, with the list of words, if the word is not one of them.
void check_word(const std::string& where, const std::string& word, const std::vector<std::string>& words);
/// Returns what a word stands for. Throws Error, with the list of words, for another word.
template <class Value>
Value chosen(const std::string& where, const std::string& word, const Choices<Value>& choices) {
  check_word(where, word, names_of(choices));
  return std::ranges::find(choices, word, &Choices<Value>::value_type::first)->second;
}

/// Splits a text at each mark. Between two marks, and at both ends, a part may be empty.
std::vector<std::string_view> split(std::string_view text, char mark = ',');
/// Splits a list at its commas. Throws Error if a word occurs twice.
std::vector<std::string> words_of(const std::string& where, const std::string& list);
/// Returns the finite number in `text`. `where` is its option, for error messages.
double parse_number_of(const std::string& where, std::string_view text);
/// Returns a function that parses a whole number in these limits.
std::function<std::uint32_t(const std::string& where, const std::string& text)> count_from(
    std::uint32_t lowest, std::uint32_t highest = std::uint32_t(parameters::highest_count));
/// Returns a function that parses a number in the range of a parameter.
std::function<double(const std::string& where, const std::string& text)> number_in(const Parameter& parameter);
/// Returns the numbers that a text gives for a member of a described struct; those of an array are separated by x, or
/// one stands for all. Throws Error, with the option, if they are not such numbers.
std::vector<double> numbers_of(const MemberInfo& member, const std::string& where, const std::string& text);
/// Returns the option of a parameter.
std::string option_of(const Parameter& parameter);
/// Throws Error, with the option of the parameter, if the value is out of range.
void check_option(const Parameter& parameter, double value);
/// Returns the help of a number, with its default.
std::string help_of(std::string_view help, double default_value);

/// Adds an option with one value, or a positional argument. Values are stored as text, so that our code does all checks
/// and writes all messages.
CLI::Option* add_value(CLI::App& app, const std::string& name, const std::string& type, const std::string& help);
/// Returns the value of an option or positional argument; none if it is missing. Throws Error if it was given twice.
std::optional<std::string> value_of(const CLI::Option* option);

/// Options that set values. What a value has before is the default; it must not move. They are read when the subcommand
/// runs, because an option that is missing or does not exist is an earlier error than a wrong value.
class Options {
 public:
  explicit Options(CLI::App& app) : app_(&app) {}

  /// Adds an option with a value that `parse` makes of the name of the option and of its text.
  template <class Value, class Parse>
  CLI::Option* add(const std::string& name, const std::string& type, const std::string& help, Value& value,
                   Parse parse) {
    CLI::Option* option = add_value(*app_, name, type, help);
    readers_.push_back([=, &value] {
      if (const auto text = value_of(option)) {
        value = Value(parse(option->get_name(), *text));
      }
    });
    return option;
  }
  /// Adds an option for a number of the parameter table, with its default in the help.
  template <class Value>
  CLI::Option* add(const Parameter& parameter, Value& value) {
    return add(option_of(parameter), "NUMBER", help_of(parameter.help, parameter.default_value), value,
               number_in(parameter));
  }
  /// Adds an option for a number, or the numbers along the axes, of a described struct.
  template <class Struct>
  void add(const Member<Struct>& member, Struct& all) {
    const char* type = member.count > 1 ? "N|NxN[xN]" : member.is_whole ? "N" : "NUMBER";
    const CLI::Option* option =
        add_value(*app_, option_of(*member.number), type, help_of(member.help, member.get(all, 0)));
    readers_.push_back([=, &member, &all] {
      const auto text = value_of(option);
      for (std::size_t i = 0; text && i < member.count; ++i) {
        member.set(all, i, numbers_of(member, option->get_name(), *text)[i]);
      }
    });
  }
  /// Adds an option whose value is one of these words.
  template <class Choice, class Value>
  CLI::Option* add(const std::string& name, const Choices<Choice>& choices, const std::string& help, Value& value) {
    return add(name, joined_words(names_of(choices), "|"), help, value,
               [choices](const std::string& where, const std::string& word) { return chosen(where, word, choices); });
  }
  /// Adds an option for a file that is read, which must be there.
  CLI::Option* add_input(const std::string& name, const std::string& help, std::optional<std::string>& path) {
    return add(name, "FILE", help, path, [](const std::string&, const std::string& text) {
      require_file(text);
      return text;
    });
  }
  /// Adds an option for a text, mostly the name of a file.
  CLI::Option* add(const std::string& name, const std::string& type, const std::string& help,
                   std::optional<std::string>& value) {
    return add(name, type, help, value, [](const std::string&, const std::string& text) { return text; });
  }

  /// Adds an option for each number of a described struct, or for those with these keys.
  template <class Struct>
  void add_numbers(Struct& all, const std::vector<std::string_view>& keys = {}) {
    for (const Member<Struct>& member : members_of<Struct>) {
      if (member.number && (keys.empty() || std::ranges::count(keys, member.key) > 0)) {
        add(member, all);
      }
    }
  }

  CLI::App& app() const { return *app_; }
  bool has(const std::string& name) const { return app_->count(name) > 0; }
  void read() const {
    std::ranges::for_each(readers_, [](const auto& read) { read(); });
  }

 private:
  CLI::App* app_;
  std::vector<std::function<void()>> readers_;
};

// Options that several subcommands have. The help names the value that there is without them.

void add_precision(Options& options, Precision& precision);
/// `sweeps_only`: without the schemes that do not sweep.
void add_relaxation(Options& options, bool sweeps_only, RelaxationScheme& scheme);
/// A list of some algorithms, separated by commas. `offered` returns all, with those that a subcommand registers.
void add_algorithms(Options& options, const std::string& help, std::span<const AlgorithmInfo> (*offered)(),
                    std::vector<Algorithm>& algorithms);

/// Returns the names that the command line offers for these algorithms.
std::vector<std::string> names_of(std::span<const AlgorithmInfo> offered);
/// Returns a help text: one line per algorithm with its name and a sentence.
std::string algorithms_help(std::span<const AlgorithmInfo> offered);
/// Returns the algorithm with this name or alias. Throws Error, with the list of names, if it is not in `offered`.
Algorithm algorithm_of(const std::string& where, const std::string& name, std::span<const AlgorithmInfo> offered);
/// Returns the algorithms of a list separated by commas.
std::vector<Algorithm> algorithms_of(const std::string& where, const std::string& list,
                                     std::span<const AlgorithmInfo> offered);

// Meshes and their files

/// A mesh that is read, and its options. Those of the subcommand may be among them.
struct MeshArguments {
  Options options;
  ReadOptions how = {};

  std::string path() const { return *value_of(options.app().get_option("MESH")); }
};
/// Adds a mesh with all its options but the number of coordinates.
std::shared_ptr<MeshArguments> add_mesh(CLI::App& app);
/// Adds a mesh without options.
std::shared_ptr<MeshArguments> add_mesh_path(CLI::App& app);
/// Adds the options of .dat files and of volumes, which have no faces.
void add_layout(MeshArguments& mesh);
/// Adds the option that joins points when a file is opened.
void add_weld(MeshArguments& mesh);
/// Adds the option for the number of coordinates.
void add_space(MeshArguments& mesh);
/// Returns a distance of --weld (mesh units).
double tolerance_of(const std::string& where, const std::string& text);
/// Reads the mesh, with options that were read. Throws Error, with the option.
OpenedMesh open_mesh(const MeshArguments& mesh);
/// The same for an open file.
OpenedMesh open_mesh(const MeshArguments& mesh, InputFile input);
/// Reads a mesh without options.
OpenedMesh open_mesh(const std::string& path);
/// Returns the folder of the samples that come with the programs. It may be missing.
std::filesystem::path samples_folder();

/// Returns where a report comes from, which ends now.
report::Origin origin_of(const std::string& command_line);
/// Prints a sentence for the user on standard error; nothing if it is empty.
void say_note(const std::string& words);
/// Adds the required option for a mesh file.
CLI::Option* add_mesh_target(CLI::App& app, const std::string& name = "-o");
/// Prints the flaws of a file on standard error, because the result may have other ids or fewer elements.
void say_flaws(const OpenedMesh& opened);
/// Throws Error if one of these files cannot be written, or is one of those that are read. Call this before any work.
void check_outputs(const std::vector<std::string>& read, const std::vector<std::optional<std::string>>& paths);
/// The same for the file of a mesh, which also needs a known ending, and another file.
void check_mesh_output(const std::string& read, const std::string& target,
                       const std::optional<std::string>& other = {});
/// Adds a mesh file at rest to the outputs. The file that was read is protected.
void add_mesh_file(Outputs& outputs, const std::string& read, const std::string& target, const MeshPointer& mesh,
                   const OwnSoftness& softness = {});
/// Writes this file as the only output.
void write_mesh_file(const std::string& read, const std::string& target, const MeshPointer& mesh,
                     const OwnSoftness& softness = {});

/// A file that an option names; without the option, none.
struct OutputFile {
  std::optional<std::string> path;
  Outputs::Writer writer;
};
/// Adds the files that are named.
void add_files(Outputs& outputs, const std::vector<OutputFile>& files);
/// Writes the files that are named, all or none. Those that were read are protected.
void write_outputs(const std::vector<std::string>& read, const std::vector<OutputFile>& files);
inline const std::optional<std::string> standard_output = "-";
/// Returns standard output unless one of these files is that.
std::optional<std::string> free_output(const std::vector<std::optional<std::string>>& paths);

// Errors

/// Returns the error with the name of an option instead of the name of a value. `options` maps names of values to
/// options.
Error at_option(const Error& error, const std::map<std::string, std::string>& options);
/// Calls a function of core and converts its errors with at_option().
template <class Make>
auto in_options(const std::map<std::string, std::string>& options, Make make) {
  try {
    return make();
  } catch (const WriteFailure&) {
    throw;  // not converted, to keep its exit status
  } catch (const Error& error) {
    throw at_option(error, options);
  }
}
/// Calls a function of core, whose errors then are at `where`.
template <class Make>
auto error_at(const std::string& where, Make make) {
  try {
    return make();
  } catch (const Error& error) {
    throw error.at(where);
  }
}
/// Calls a long function of core with a line of progress that has this text.
template <class Make>
auto watched(const std::string& text, const std::map<std::string, std::string>& options, Make make) {
  Watch watch(text);
  return in_options(options, [&] { return make(watch.progress()); });
}

}  // namespace chainmail::command_line
