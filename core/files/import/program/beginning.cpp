#include "files/import/program/beginning.h"

#include <algorithm>
#include <array>
#include <fstream>
#include <string_view>

#include "mesh/error.h"

namespace chainmail::import {
namespace {

constexpr std::size_t looked_at = 65536;  // bytes, for a long comment

/// Gmsh tells a mesh by the very first byte: behind a blank line or a byte order mark it sees a script.
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
  std::string text(looked_at, '\0');
  std::ifstream file(path, std::ios::binary);
  file.read(text.data(), looked_at);
  text.resize(static_cast<std::size_t>(file.gcount()));
  if (name == "mesh" ? !begins_as_medit(text) : !begins_as_msh(text)) {
    throw Error("",
                name == "mesh" ? "it does not begin as a Medit mesh, with MeshVersionFormatted"
                               : "it does not begin as a Gmsh mesh, with $MeshFormat or $NOD",
                "export it anew as a mesh; scripts are not run");
  }
}

}  // namespace chainmail::import
