#pragma once

#include <CLI/CLI.hpp>
#include <functional>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "equilibrium/relaxation_scheme.h"
#include "files/mesh/open_mesh.h"
#include "files/text/outputs.h"
#include "mesh/error.h"
#include "mesh/parameters.h"
#include "solver/algorithms.h"

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
Command add_thumbnail(CLI::App& root);

/// Adds an option with one value, or a positional argument. Values are stored as text, so that our code does all checks
/// and writes all messages.
CLI::Option* add_value(CLI::App& app, const std::string& name, const std::string& type, const std::string& help);
/// Adds an option for a number of the parameter table, with its default in the help.
CLI::Option* add_parameter(CLI::App& app, const Parameter& parameter);
/// Returns the help of a parameter, with its default.
std::string help_of(const Parameter& parameter);

/// Returns the value of an option or positional argument; none if it is missing. Throws Error if it was given twice.
std::optional<std::string> value_of(const CLI::Option* option);

/// Returns the finite number in `text`. `where` is its option, for error messages.
double parse_number_of(const std::string& where, std::string_view text);
/// Returns the value of a parameter, or its default. Throws Error if it is out of range.
double value_of(const CLI::Option* option, const Parameter& parameter);
/// Returns the whole number of an option, or `default_value` if the option is missing. Throws Error if it is out of
/// range.
std::uint32_t whole_number_of(const CLI::Option* option, std::uint32_t lowest, std::uint32_t default_value,
                              std::uint32_t highest = 1'000'000'000);
/// Throws Error, with the list of words, if the word is not one of them.
void check_word(const std::string& where, const std::string& word, const std::vector<std::string>& words);
/// Adds the option --relaxation, with the schemes that sweep or with all. Its help names the one without the option.
CLI::Option* add_relaxation(CLI::App& app, bool sweeps_only, RelaxationScheme usual = RelaxationScheme::mean);
/// Returns the scheme that --relaxation names; `usual` if it is missing. Throws Error, with the list of names, if it is
/// none of those offered.
RelaxationScheme relaxation_of(const CLI::Option* option, bool sweeps_only,
                               RelaxationScheme usual = RelaxationScheme::mean);
/// Splits a list at its commas. Throws Error if a word occurs twice.
std::vector<std::string> words_of(const std::string& where, const std::string& list);

/// Returns the names that the command line offers for these algorithms.
std::vector<std::string> names_of(std::span<const AlgorithmInfo> offered);
/// Returns a help text: one line per algorithm with its name and a sentence.
std::string algorithms_help(std::span<const AlgorithmInfo> offered);
/// Returns the algorithm with this name or alias. Throws Error, with the list of names, if it is not in `offered`.
Algorithm algorithm_of(const std::string& where, const std::string& name, std::span<const AlgorithmInfo> offered);
/// Returns the algorithms of a list separated by commas; empty if the option is missing.
std::vector<Algorithm> algorithms_of(const CLI::Option* option, std::span<const AlgorithmInfo> offered);

std::optional<int> space_of(const CLI::Option* option);

/// The options for reading a mesh.
struct MeshOptions {
  CLI::Option* path = nullptr;
  CLI::Option* size = nullptr;
  CLI::Option* spacing = nullptr;
  CLI::Option* space = nullptr;
  CLI::Option* threshold = nullptr;
  CLI::Option* voxels = nullptr;
  CLI::Option* by_density = nullptr;
  CLI::Option* data_outside = nullptr;
  CLI::Option* weld = nullptr;
};
/// Whether points are joined when a file is opened, or as a repair.
enum class Welding { by_reader, by_repair };
MeshOptions add_mesh_options(CLI::App& app, Welding welding = Welding::by_reader);
/// Returns the value of --weld (mesh units). Throws Error.
double tolerance_of(const std::string& text);
OpenedMesh open_mesh(const MeshOptions& options);

/// Adds the required option -o for a mesh file.
CLI::Option* add_mesh_target(CLI::App& app);
/// Prints a sentence for the user on standard error; nothing if it is empty.
void say_note(const std::string& words);
/// Prints the flaws of a file on standard error, because the result may have other ids or fewer elements.
void say_flaws(const OpenedMesh& opened);
/// Adds a mesh file at rest to the outputs. The file that was read is protected.
void add_mesh_file(Outputs& outputs, const MeshOptions& read, const std::string& target, const Mesh& mesh,
                   const OwnSoftness& softness);
/// Writes this file as the only output.
void write_mesh_file(const MeshOptions& read, const std::string& target, const Mesh& mesh, const OwnSoftness& softness);

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
