#include "command_line/samples.h"

namespace chainmail::command_line {

std::filesystem::path samples_folder() {
  std::error_code none;
  const std::filesystem::path program = std::filesystem::read_symlink("/proc/self/exe", none);
  return program.parent_path() / DATA_FOLDER "/meshes";
}

}  // namespace chainmail::command_line
