#include "command_line/samples.h"

#include "files/text/program_folder.h"

namespace chainmail::command_line {

std::filesystem::path samples_folder() { return program_folder() / DATA_FOLDER "/meshes"; }

}  // namespace chainmail::command_line
