#pragma once

#include <filesystem>
#include <ostream>
#include <string>
#include <string_view>
#include <vector>

#include "mesh/mesh.h"
#include "mesh/progress.h"
#include "simulate/command.h"

namespace chainmail {

/// Recorded moves, as JSON, to be replayed from rest by any algorithm:
///
///     {"version": 1, "commands": [{"do": "grab", "element": 5}, {"do": "drag", "target": [1, 2, 0]},
///       {"do": "release"}, {"do": "cut", "links": [[0, 1]]}, {"do": "uncut", "links": [[0, 1]]},
///       {"do": "pin", "elements": [3]}, {"do": "unpin", "elements": [3]}, {"do": "reset"},
///       {"do": "relax", "sweeps": 3, "step": 1, "scheme": "mean"},
///       {"do": "softness", "compression": 0.8, "stretch": 1.2, "shear": 0.1, "links": [[0, 1, 1, 1, 0]]}]}
///
/// Links are named by their ends. A softness replaces the whole one; its links may be left out.

/// Reads moves of a mesh. `path` appears in errors; `text` is what the file holds. Throws Error for whatever a
/// simulation of this mesh could not carry out from rest, with the number of the command, counted from 0; and
/// Cancelled. Takes linear time, and little memory besides the commands and the text.
std::vector<Command> read_moves(std::string_view text, const std::filesystem::path& path, const Mesh& mesh,
                                const Progress& progress = {});

/// The same from a file.
std::vector<Command> read_moves(const std::filesystem::path& path, const Mesh& mesh, const Progress& progress = {});

/// The same from a part of another file's text; `where` appears in errors.
std::vector<Command> read_moves(std::string_view text, const std::filesystem::path& path, const std::string& where,
                                const Mesh& mesh, const Progress& progress);

/// Writes moves, a line a command. What is not the object's but the solver's (the algorithm, relaxation,
/// states kept for undo) is left out. Throws Error for a change of mesh or state, which no script can hold; and
/// Cancelled.
void write_moves(std::ostream& out, const std::vector<Command>& commands, const Mesh& mesh,
                 const Progress& progress = {});

}  // namespace chainmail
