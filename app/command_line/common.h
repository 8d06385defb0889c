#pragma once

#include <CLI/CLI.hpp>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <string_view>

#include "files/mesh/open_mesh.h"
#include "files/text/outputs.h"
#include "mesh/error.h"
#include "mesh/parameters.h"

namespace chainmail::command_line {

/// Parses the arguments and carries the command out. Throws Error for bad usage and bad input.
void run(int argc, char** argv);

/// A subcommand: what is parsed for it, and what is then done.
struct Command {
  CLI::App* app;
  std::function<void()> run;
};
Command add_generate(CLI::App& root);
Command add_convert(CLI::App& root);
Command add_fill(CLI::App& root);
Command add_info(CLI::App& root);
Command add_deform(CLI::App& root);
/// `command_line` is what a report says of its own making.
Command add_compare(CLI::App& root, const std::string& command_line);
Command add_calibrate(CLI::App& root);
Command add_ramp(CLI::App& root);

/// Adds an option that takes one value, or a positional. Values are kept as text, so that every check
/// and its sentence is our own.
CLI::Option* add_value(CLI::App& app, const std::string& name, const std::string& type, const std::string& help);
/// The same for a number of the parameter table, with its default in the help.
CLI::Option* add_parameter(CLI::App& app, const Parameter& parameter);

/// The value of an option or positional, if it was given. Throws Error where it was given twice.
std::optional<std::string> value_of(const CLI::Option* option);

/// A finite number; `where` is the option that it belongs to.
double parse_number_of(const std::string& where, std::string_view text);
/// A parameter's value, by default its standard one, within its range.
double value_of(const CLI::Option* option, const Parameter& parameter);
/// A whole number of an option, not below `lowest`.
std::uint32_t whole_number_of(const CLI::Option* option, std::uint32_t lowest, std::uint32_t standard);
/// One of a few words; throws Error, naming them, for any other.
void check_word(const std::string& where, const std::string& word, const std::vector<std::string>& words);
/// The words of a list parted by commas. Throws Error where one comes twice.
std::vector<std::string> words_of(const std::string& where, const std::string& list);
std::optional<int> space_of(const CLI::Option* option);

/// The options with which a mesh is read.
struct MeshOptions {
  CLI::Option* path = nullptr;
  CLI::Option* size = nullptr;
  CLI::Option* spacing = nullptr;
  CLI::Option* space = nullptr;
  CLI::Option* threshold = nullptr;
  CLI::Option* voxels = nullptr;
  CLI::Option* by_density = nullptr;
  CLI::Option* data_outside = nullptr;
};
MeshOptions add_mesh_options(CLI::App& app);
OpenedMesh open_mesh(const MeshOptions& options);

/// The same error, said of the option that the value which it names came from, if any.
Error at_option(const Error& error, const std::map<std::string, std::string>& options);
/// Calls a function of the core and has its errors name the option that a value came from.
template <class Make>
auto in_options(const std::map<std::string, std::string>& options, Make make) {
  try {
    return make();
  } catch (const WriteFailure&) {
    throw;  // it keeps its exit status
  } catch (const Error& error) {
    throw at_option(error, options);
  }
}

}  // namespace chainmail::command_line
