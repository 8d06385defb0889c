#include "files/mesh/foreign.h"

#include <algorithm>
#include <array>

#include "files/text/text.h"
#include "mesh/error.h"

namespace chainmail {
namespace {

struct Foreign {
  std::string_view sign;  // in lower case, if it is text
  const char* what;
  const char* remedy;
};

constexpr auto unpack = "unpack it first", as_utf8 = "save it as UTF-8", open_page = "download the file itself",
               not_picture = "use a mesh; the workbench opens PNG and JPEG pictures as sheets";

constexpr std::array foreigners{
    Foreign{"version https://git-lfs", "it is a pointer of Git LFS, not the file itself",
            "fetch it with 'git lfs pull'"},
    Foreign{"pk\x03\x04", "it is a ZIP archive", unpack},
    Foreign{"\x1f\x8b", "it is compressed by gzip", unpack},
    Foreign{"bzh", "it is compressed by bzip2", unpack},
    Foreign{"\xfd"
            "7zxz",
            "it is compressed by xz", unpack},
    Foreign{"7z\xbc\xaf", "it is a 7-Zip archive", unpack},
    Foreign{"rar!", "it is a RAR archive", unpack},
    Foreign{"\xff\xfe", "it is text in UTF-16", as_utf8},
    Foreign{"\xfe\xff", "it is text in UTF-16", as_utf8},
    Foreign{"<!doctype html", "it is a web page", open_page},
    Foreign{"<html", "it is a web page", open_page},
    Foreign{"<?xml", "it is XML", "save it as .vtu, OBJ or PLY"},
    Foreign{"\x89png", "it is a picture", not_picture},
    Foreign{"\xff\xd8\xff", "it is a picture", not_picture},
    Foreign{"gif8", "it is a picture", not_picture},
    Foreign{"iso-10303-21", "it is a CAD model (STEP)",
            "divide its surface into triangles first, for example with Gmsh"},
    Foreign{"gltf", "it is a binary glTF scene", "save it as OBJ, PLY or STL"},
    Foreign{"%pdf", "it is a PDF document", "use a mesh"},
};

}  // namespace

void refuse_foreign(std::string_view beginning, const std::filesystem::path& path) {
  beginning.remove_prefix(mark_length(beginning));
  beginning.remove_prefix(std::min(beginning.find_first_not_of(" \t\r\n"), beginning.size()));
  for (const Foreign& one : foreigners) {
    if (lower_case(beginning.substr(0, one.sign.size())) == one.sign) {
      throw Error(shown(path), one.what, one.remedy);
    }
  }
}

}  // namespace chainmail
