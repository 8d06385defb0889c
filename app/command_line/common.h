#pragma once

#include <CLI/CLI.hpp>
#include <filesystem>
#include <functional>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "chainmail/error.h"
#include "chainmail/files.h"
#include "chainmail/job.h"
#include "chainmail/mesh_file.h"
#include "chainmail/method.h"
#include "chainmail/options.h"
#include "chainmail/text.h"

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

/// Adds an option with one value, or a positional argument. Values are stored as text, so that our code does all checks
/// and writes all messages.
CLI::Option* add_value(CLI::App& app, const std::string& name, const std::string& type, const std::string& help);
/// Adds an option for a number of the parameter table, with its default in the help.
CLI::Option* add_parameter(CLI::App& app, const api::Parameter& parameter);
/// Returns the help of a parameter, with its default.
std::string help_of(const api::Parameter& parameter);

/// Returns the value of an option or positional argument; none if it is missing. Throws Error if it was given twice.
std::optional<std::string> value_of(const CLI::Option* option);

/// Returns the finite number in `text`. `where` is its option, for error messages.
double parse_number_of(const std::string& where, std::string_view text);
/// Returns the value of a parameter, or its default. Throws Error if it is out of range.
double value_of(const CLI::Option* option, const api::Parameter& parameter);
/// Returns the whole number of an option, or `default_value` if the option is missing. Throws Error if it is out of
/// range.
std::uint32_t whole_number_of(const CLI::Option* option, std::uint32_t lowest, std::uint32_t default_value,
                              std::uint32_t highest = 1'000'000'000);
/// Throws Error, with the list of words, if the word is not one of them.
void check_word(const std::string& where, const std::string& word, const std::vector<std::string>& words);
/// Adds the option --relaxation, with the schemes that sweep or with all. Its help names the one without the option.
CLI::Option* add_relaxation(CLI::App& app, bool sweeps_only, api::RelaxationScheme usual = api::RelaxationScheme::mean);
/// Returns the scheme that --relaxation names; `usual` if it is missing. Throws Error, with the list of names, if it is
/// none of those offered.
api::RelaxationScheme relaxation_of(const CLI::Option* option, bool sweeps_only,
                                    api::RelaxationScheme usual = api::RelaxationScheme::mean);
/// Splits a list at its commas. Throws Error if a word occurs twice.
std::vector<std::string> words_of(const std::string& where, const std::string& list);

/// Number of softness numbers that decide on the valid region of a link: the first ones. The others decide on its
/// energy.
inline constexpr std::size_t region_numbers = 3;

/// Returns the row of a scheme.
const api::RelaxationSchemeInfo& info(api::RelaxationScheme scheme);

/// The option for the kind of energy. Its help names the kind without the option.
CLI::Option* add_energy(CLI::App& app, api::EnergyKind usual);
/// Returns the kind of energy; `usual` without the option. Throws Error if it is not known.
api::EnergyKind energy_of(const CLI::Option* option, api::EnergyKind usual);

/// Returns the methods of the ChainMail family.
std::vector<api::MethodInfo> chainmail_methods();
/// Returns the names of methods.
std::vector<std::string> names_of(const std::vector<api::MethodInfo>& offered);
/// Returns a help text: one line per method with its name and a sentence.
std::string methods_help(const std::vector<api::MethodInfo>& offered);
/// Returns the name of the method with this name or alias. Throws Error, with the list of names, if it is not in
/// `offered`.
std::string method_of(const std::string& where, const std::string& name, const std::vector<api::MethodInfo>& offered);
/// Returns the names of the methods of a list separated by commas; empty if the option is missing.
std::vector<std::string> methods_of(const CLI::Option* option, const std::vector<api::MethodInfo>& offered);
/// The option for the precision of a solver.
CLI::Option* add_precision(CLI::App& app, api::Precision usual);
/// Returns the precision; `usual` without the option. Throws Error if it is not known.
api::Precision precision_of(const CLI::Option* option, api::Precision usual);

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
/// Reads the mesh. Throws Error, with the option.
api::Mesh open_mesh(const MeshOptions& options);

/// Adds the required option -o for a mesh file.
CLI::Option* add_mesh_target(CLI::App& app);
/// Prints a sentence for the user on standard error; nothing if it is empty.
void say_note(const std::string& words);
/// Prints the flaws of a file on standard error, because the result may have other ids or fewer elements.
void say_flaws(const api::Mesh& mesh);
/// Adds a mesh file at rest to the outputs. The file that was read is protected.
void add_mesh_file(api::Outputs& outputs, const MeshOptions& read, const std::string& target, const api::Mesh& mesh);
/// Writes this file as the only output.
void write_mesh_file(const MeshOptions& read, const std::string& target, const api::Mesh& mesh);

/// Returns the folder of the samples that come with the programs. It may be missing.
std::filesystem::path samples_folder();

/// Returns the error with the name of an option instead of the name of a value. `options` maps names of values to
/// options.
api::Error at_option(const api::Error& error, const std::map<std::string, std::string>& options);
/// Calls a function of the library and converts its errors with at_option().
template <class Make>
auto in_options(const std::map<std::string, std::string>& options, Make make) {
  try {
    return make();
  } catch (const api::WriteFailure&) {
    throw;  // not converted, to keep its exit status
  } catch (const api::Error& error) {
    throw at_option(error, options);
  }
}

}  // namespace chainmail::command_line
