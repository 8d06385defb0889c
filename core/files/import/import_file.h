#pragma once

#include <filesystem>
#include <string>

#include "files/formats/imported.h"
#include "files/formats/volume.h"
#include "files/text/regular_file.h"
#include "mesh/progress.h"

namespace chainmail {

/// Reads a mesh by a library in the import program. `task` is the program's word for the format. `passes` is the number
/// of times that the library reads the file; `program` is where the import program is, as for run_import. Throws the
/// same as run_import (files/import/import_process.h).
ImportedMesh import_mesh(const std::string& task, RegularFile file, int passes, const Progress& progress,
                         const std::filesystem::path& program = {});

/// Reads an NRRD volume by teem in the import program. The header may name data outside its folder if `outside` is
/// true. Throws the same as run_import.
Volume import_nrrd(RegularFile file, bool outside, const Progress& progress, const std::filesystem::path& program = {});

}  // namespace chainmail
