#include "files/text/temporary_folder.h"

#include <cstdlib>
#include <string>

#include "files/text/text.h"
#include "mesh/error.h"

namespace chainmail {

TemporaryFolder::TemporaryFolder() {
  std::error_code none;
  std::string name = (std::filesystem::temp_directory_path(none) / "chainmail-XXXXXX").string();
  if (mkdtemp(name.data()) == nullptr) {
    throw Error(shown(name), "the folder cannot be created", "free some space, or set TMPDIR to another folder");
  }
  path_ = name;
}

TemporaryFolder::~TemporaryFolder() {
  std::error_code none;
  std::filesystem::remove_all(path_, none);
}

}  // namespace chainmail
