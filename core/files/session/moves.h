#pragma once

#include <cstdint>
#include <filesystem>
#include <ostream>
#include <string>
#include <string_view>
#include <vector>

#include "mesh/mesh.h"
#include "mesh/progress.h"
#include "simulate/command.h"

namespace chainmail {

inline constexpr std::uint64_t newest_moves_version = 4;

/// Recorded moves as JSON. Any algorithm can replay them from rest:
///
///     {"version": 1, "commands": [{"do": "grab", "element": 5}, {"do": "drag", "target": [1, 2, 0]},
///       {"do": "release"}, {"do": "cut", "links": [[0, 1]]}, {"do": "uncut", "links": [[0, 1]]},
///       {"do": "pin", "elements": [3]}, {"do": "unpin", "elements": [3]}, {"do": "reset"},
///       {"do": "relax", "sweeps": 3, "step": 1, "scheme": "mean"},
///       {"do": "relax", "sweeps": 200, "scheme": "equilibrium", "until": 0.001, "local": true},
///       {"do": "softness", "compression": 0.8, "stretch": 1.2, "shear": 0.1, …, "energy": "corotated",
///        "links": [[0, 1, 1, 1, 0, 1, 1, -1]]}]}
///
/// The version is 2 if moves split the object:
///
///     {"do": "split", "elements": [[a, b, c, s, t] of each new element…], "removed": [index of each triangle…],
///        "triangles": [[three ids of each new one]…], "removed_polygons": [index of each…],
///        "polygons": [count, id… of each new one…]}
///
/// A new element is at a + s (b − a) + t (c − a) at rest, where a, b and c have lower ids. See SplitEdit. The commands
/// after it are about the object after the split.
///
/// It is 3 if moves contain what relaxation in idle time did since the command before, for each panel:
///
///     {"do": "relaxed", "scheme": "mean", "step": 1, "start": "goes on", "awake" or "asleep",
///        "panels": [algorithm…], "slices": [number…], "local": true if the setting had it}
///
/// A slice is an iteration of the scheme `equilibrium`, or a sweep, but at most 20,000 elements of it. Another
/// simulation repeats that of the panel with its algorithm. "awake" and "asleep" say that relaxation began anew before,
/// with all elements or with none.
///
/// It is 4 if moves split cells. Then a split has also these members, each only if it is not empty:
///
///     "removed_cells": [index of each, the tetrahedra first…], "tetrahedra": [[four ids of each new one]…],
///        "hexahedra": [[eight ids of each new one]…]
///
/// Links are named by their ends. A softness has all numbers of softness_numbers and replaces the softness of all
/// links; "links" may be left out. So may "energy", and the numbers after the first three: they have their defaults
/// then.

/// Reads moves of a mesh from the text of a file. `path` appears in errors. Throws Error, with the number of the
/// command from 0, for any command that a simulation of this mesh could not execute from rest; and Cancelled. Takes
/// linear time, and little memory other than the commands and the text.
std::vector<Command> read_moves(std::string_view text, const std::filesystem::path& path, const MeshPointer& mesh,
                                const Progress& progress = {});

/// Reads moves from a file.
std::vector<Command> read_moves(const std::filesystem::path& path, const MeshPointer& mesh,
                                const Progress& progress = {});

/// Reads moves from a part of the text of another file. `where` appears in errors. A softness that does not say its
/// energy has `absent_energy`.
std::vector<Command> read_moves(std::string_view text, const std::filesystem::path& path, const std::string& where,
                                const MeshPointer& mesh, const Progress& progress,
                                EnergyKind absent_energy = link_energy);

/// Writes moves, one line per command. They begin with `mesh`, or with the mesh that the first split of them splits.
/// Commands for the solver (algorithm, relaxation, states for undo) are left out. Throws Error for a change of mesh or
/// state, which recorded moves cannot contain; and Cancelled.
void write_moves(std::ostream& out, const std::vector<Command>& commands, const Mesh& mesh,
                 const Progress& progress = {});

}  // namespace chainmail
