#include "files/import/program/beginning.h"

#include <algorithm>
#include <array>
#include <fstream>
#include <string_view>

#include "mesh/error.h"

namespace chainmail::import {
namespace {

constexpr std::size_t beginning_bytes = 65536;  // enough for a long comment

/// Gmsh recognises a mesh by its first byte: after a blank line or a byte order mark it runs the file as a script.
bool begins_as_msh(std::string_view text) {
  static constexpr std::array<std::string_view, 3> signs{"$MeshFormat", "$NOD", "$Comments"};
  return std::any_of(signs.begin(), signs.end(), [text](std::string_view sign) { return text.starts_with(sign); });
}

/// Medit's format allows blanks and comments before its first word.
bool begins_as_medit(std::string_view text) {
  static constexpr std::string_view byte_order_mark = "\xef\xbb\xbf";
  if (text.starts_with(byte_order_mark)) {
    text.remove_prefix(byte_order_mark.size());
  }
  for (;;) {
    text.remove_prefix(std::min(text.find_first_not_of(" \t\r\n"), text.size()));
    if (!text.starts_with('#')) {
      return text.starts_with("MeshVersionFormatted");
    }
    text.remove_prefix(std::min(text.find('\n'), text.size()));
  }
}

}  // namespace

void check_beginning(const std::string& name, const std::filesystem::path& path) {
  std::string text(beginning_bytes, '\0');
  std::ifstream file(path, std::ios::binary);
  file.read(text.data(), beginning_bytes);
  text.resize(static_cast<std::size_t>(file.gcount()));
  if (name == "mesh" ? !begins_as_medit(text) : !begins_as_msh(text)) {
    throw Error("",
                name == "mesh" ? "it does not begin as a Medit mesh, with MeshVersionFormatted"
                               : "it does not begin as a Gmsh mesh, with $MeshFormat or $NOD",
                "export it again as a mesh; scripts are not run");
  }
}

}  // namespace chainmail::import
