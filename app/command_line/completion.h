#pragma once

#include <CLI/CLI.hpp>

#include "command_line/common.h"

namespace chainmail::command_line {

/// Adds the command that prints a script with which a shell completes subcommands, options and values. The script is
/// made from the options of all commands of `root`.
Command add_completion(CLI::App& root);

}  // namespace chainmail::command_line
