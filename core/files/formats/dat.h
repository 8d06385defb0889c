#pragma once

#include <filesystem>
#include <ostream>
#include <string_view>

#include "files/formats/imported.h"
#include "files/formats/mesh_state.h"
#include "files/formats/read_options.h"
#include "mesh/progress.h"

namespace chainmail {

/// Reads the format of the thesis (Dean 2004, 4.3): a row `id count neighbour…` for each element, in any order.
/// Neighbours keep the order of the row.
///
/// The format has no positions: the elements form a lattice. Its size comes from the options, else from a comment `#
/// size W H D` (one to three numbers), else from a file name that is exactly WxH.dat or WxHxD.dat. `path` is used for
/// that name and in error messages. Throws Error with the line, and Cancelled.
ImportedMesh read_dat(std::string_view text, const std::filesystem::path& path, const ReadOptions& options,
                      const Progress& progress = {});

/// Writes the size and spacing of the lattice as comments, and the uncut links. Throws Error for a mesh without a
/// lattice.
void write_dat(std::ostream& out, const MeshState& state, const Progress& progress = {});

}  // namespace chainmail
