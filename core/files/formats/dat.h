#pragma once

#include <filesystem>
#include <ostream>
#include <string_view>

#include "files/formats/read_options.h"
#include "mesh/cuts.h"
#include "mesh/mesh.h"
#include "mesh/progress.h"
#include "solve/solver.h"

namespace chainmail {

/// Reads the thesis' format (Dean 2004, 4.3): a row `id count neighbour…` an element, in any order;
/// neighbours keep the row's order. It holds no positions: elements stand in a lattice, whose size comes
/// from the options, else from a comment `# size W [H [D]]`, else from a file name that is exactly
/// WxH[xD].dat. `path` gives that name and appears in errors; `text` is what the file holds.
MeshPointer read_dat(std::string_view text, const std::filesystem::path& path, const ReadOptions& options,
                     const Progress& progress = {});

/// Writes the lattice's size and spacing as comments, and the links that are not cut. Throws Error for a
/// mesh that stands in no lattice.
void write_dat(std::ostream& out, const Mesh& mesh, const Cuts& cuts, const Progress& progress = {});

}  // namespace chainmail
