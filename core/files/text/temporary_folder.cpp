#include "files/text/temporary_folder.h"

#include <cstdlib>
#include <string>

#include "files/text/text.h"
#include "mesh/error.h"

namespace chainmail {
namespace {

std::filesystem::path folder_for_temporary_files() {
  std::error_code error;
  std::filesystem::path folder = std::filesystem::temp_directory_path(error);
  if (error) {
    const char* given = std::getenv("TMPDIR");
    throw Error(given != nullptr ? shown(given) : "TMPDIR", "it cannot take temporary files (" + error.message() + ")",
                "set TMPDIR to a folder");
  }
  return folder;
}

}  // namespace

TemporaryFolder::TemporaryFolder() {
  std::string name = (folder_for_temporary_files() / "chainmail-XXXXXX").string();
  if (mkdtemp(name.data()) == nullptr) {
    throw Error(shown(name), "the folder cannot be created (" + system_reason() + ")",
                "free some space, or set TMPDIR to another folder");
  }
  path_ = name;
}

TemporaryFolder::~TemporaryFolder() {
  std::error_code none;
  std::filesystem::remove_all(path_, none);
}

}  // namespace chainmail
