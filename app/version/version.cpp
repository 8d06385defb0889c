#include "version/version.h"

#include "commit.h"

namespace chainmail {

std::string version_in_words(const std::string& program) {
  return program + " " CHAINMAIL_VERSION " (" CHAINMAIL_COMMIT ", " CHAINMAIL_BUILD_TYPE ")";
}

}  // namespace chainmail
