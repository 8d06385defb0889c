#pragma once

#include <CLI/CLI.hpp>
#include <filesystem>
#include <functional>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "files/mesh/input_file.h"
#include "files/text/outputs.h"
#include "files/text/text.h"
#include "mesh/error.h"
#include "mesh/parameters.h"
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
/// `command_line` is shown in the report.
Command add_compare(CLI::App& root, const std::string& command_line);
Command add_calibrate(CLI::App& root);
Command add_ramp(CLI::App& root);
/// Adds the command that prints a script with which a shell completes subcommands, options and values. The script is
/// made from the options of all commands of `root`.
Command add_completion(CLI::App& root);

// Options and their values

/// Adds an option with one value, or a positional argument. Values are stored as text, so that our code does all checks
/// and writes all messages.
CLI::Option* add_value(CLI::App& app, const std::string& name, const std::string& type, const std::string& help);
/// Adds an option for a number of the parameter table, with its default in the help.
CLI::Option* add_parameter(CLI::App& app, const Parameter& parameter);
/// Returns the help of a parameter, with its default.
std::string help_of(const Parameter& parameter);

/// Returns the value of an option or positional argument; none if it is missing or was not added. Throws Error if it
/// was given twice.
std::optional<std::string> value_of(const CLI::Option* option);
/// Returns the value of a parameter, or its default. Throws Error if it is out of range.
double value_of(const CLI::Option* option, const Parameter& parameter);
/// Returns the finite number in `text`. `where` is its option, for error messages.
double parse_number_of(const std::string& where, std::string_view text);
/// Returns the finite number of an option; `default_value` without it.
double number_of(const CLI::Option* option, double default_value);
/// Returns the whole number of an option, or `default_value` if the option is missing. Throws Error if it is out of
/// range.
std::uint32_t whole_number_of(const CLI::Option* option, std::uint32_t lowest, std::uint32_t default_value,
                              std::uint32_t highest = 1'000'000'000);
/// Splits a text at each mark. Between two marks, and at both ends, a part may be empty.
std::vector<std::string_view> split(std::string_view text, char mark = ',');
/// Splits a list at its commas. Throws Error if a word occurs twice.
std::vector<std::string> words_of(const std::string& where, const std::string& list);
/// Throws Error, with the list of words, if the word is not one of them.
void check_word(const std::string& where, const std::string& word, const std::vector<std::string>& words);

/// The words of an option, and what they stand for.
template <class Value>
using Choices = std::vector<std::pair<std::string, Value>>;
inline const Choices<bool> on_or_off{{"on", true}, {"off", false}};

/// Returns the words, in their order.
template <class Value>
std::vector<std::string> names_of(const Choices<Value>& choices) {
  std::vector<std::string> names;
  for (const auto& [name, value] : choices) {
    names.push_back(name);
  }
  return names;
}
/// Adds an option whose value is one of these words.
template <class Value>
CLI::Option* add_choice(CLI::App& app, const std::string& name, const Choices<Value>& choices,
                        const std::string& help) {
  return add_value(app, name, joined_words(names_of(choices), "|"), help);
}
/// Returns what the word of an option stands for; `usual` without it. Throws Error for another word.
template <class Value>
Value choice_of(const CLI::Option* option, const Choices<Value>& choices, Value usual) {
  const auto word = value_of(option);
  if (!word) {
    return usual;
  }
  check_word(option->get_name(), *word, names_of(choices));
  for (const auto& [name, value] : choices) {
    if (name == *word) {
      return value;
    }
  }
  return usual;
}

/// The precisions; the usual one is first.
Choices<Precision> precisions(Precision usual);
/// The option for the precision of a solver.
CLI::Option* add_precision(CLI::App& app, Precision usual);
/// The relaxation schemes: those that sweep, or all.
Choices<RelaxationScheme> schemes(bool sweeps_only);
/// Adds the option --relaxation. Its help names the scheme without the option.
CLI::Option* add_relaxation(CLI::App& app, bool sweeps_only, RelaxationScheme usual = RelaxationScheme::mean);
/// The numbers of coordinates of a mesh.
inline const Choices<std::optional<int>> spaces{{"1", 1}, {"2", 2}, {"3", 3}};
/// The option for the number of coordinates of a mesh that is read.
CLI::Option* add_space(CLI::App& app);

/// Returns the names that the command line offers for these algorithms.
std::vector<std::string> names_of(std::span<const AlgorithmInfo> offered);
/// Returns a help text: one line per algorithm with its name and a sentence.
std::string algorithms_help(std::span<const AlgorithmInfo> offered);
/// Returns the algorithm with this name or alias. Throws Error, with the list of names, if it is not in `offered`.
Algorithm algorithm_of(const std::string& where, const std::string& name, std::span<const AlgorithmInfo> offered);
/// Returns the algorithms of a list separated by commas; empty if the option is missing.
std::vector<Algorithm> algorithms_of(const CLI::Option* option, std::span<const AlgorithmInfo> offered);

// Meshes and their files

/// The options for reading a mesh.
struct MeshOptions {
  CLI::Option *path = nullptr, *size = nullptr, *spacing = nullptr, *space = nullptr, *weld = nullptr;
  CLI::Option *threshold = nullptr, *voxels = nullptr, *by_density = nullptr, *data_outside = nullptr;
};
/// Whether points are joined when a file is opened, or as a repair.
enum class Welding { by_reader, by_repair };
MeshOptions add_mesh_options(CLI::App& app, Welding welding = Welding::by_reader);
/// Returns the value of --weld (mesh units). Throws Error.
double tolerance_of(const std::string& text);
/// Reads the mesh. Throws Error, with the option.
OpenedMesh open_mesh(const MeshOptions& options);
OpenedMesh open_mesh(const MeshOptions& options, InputFile input);
/// Returns the folder of the samples that come with the programs. It may be missing.
std::filesystem::path samples_folder();

/// Adds the required option for a mesh file.
CLI::Option* add_mesh_target(CLI::App& app, const std::string& name = "-o");
/// Prints a sentence for the user on standard error; nothing if it is empty.
void say_note(const std::string& words);
/// Prints the flaws of a file on standard error, because the result may have other ids or fewer elements.
void say_flaws(const OpenedMesh& opened);
/// Adds a mesh file at rest to the outputs. The file that was read is protected.
void add_mesh_file(Outputs& outputs, const MeshOptions& read, const std::string& target, const MeshPointer& mesh,
                   const OwnSoftness& softness = {});
/// Writes this file as the only output.
void write_mesh_file(const MeshOptions& read, const std::string& target, const MeshPointer& mesh,
                     const OwnSoftness& softness = {});

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

}  // namespace chainmail::command_line
