#include "command_line/version.h"

#include "commit.h"

namespace chainmail::command_line {

std::string version_in_words() {
  return "chainmail " CHAINMAIL_VERSION " (" CHAINMAIL_COMMIT ", " CHAINMAIL_BUILD_TYPE ")";
}

}  // namespace chainmail::command_line
