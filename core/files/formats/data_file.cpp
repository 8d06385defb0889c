#include "files/formats/data_file.h"

#include <algorithm>

#include "files/text/regular_file.h"
#include "files/text/text.h"
#include "mesh/error.h"

namespace chainmail {
namespace {

namespace fs = std::filesystem;

bool is_beneath(const fs::path& path, const fs::path& folder) {
  return std::mismatch(folder.begin(), folder.end(), path.begin(), path.end()).first == folder.end();
}

}  // namespace

fs::path data_file(const fs::path& header, const std::string& name, bool outside) {
  if (name.empty()) {
    throw Error(shown(header), "it does not name a data file", "export it again");
  }
  fs::path path = header.parent_path() / name;
  if (outside) {
    return path;
  }
  fs::path target = resolved(path);
  if (!is_beneath(target, resolved(header.has_parent_path() ? header.parent_path() : "."))) {
    throw Error(shown(header), "its data are outside its folder, in " + in_quotes(name),
                "copy them into that folder, or use --data-outside allow on the command line");
  }
  return target;
}

}  // namespace chainmail
