#include "files/import/program/beginning.h"

#include <algorithm>
#include <array>
#include <fstream>
#include <string_view>

#include "mesh/error.h"

namespace chainmail::import {
namespace {

constexpr std::size_t beginning_bytes = 16;  // more than the longest sign

/// Gmsh recognises a mesh by its first byte: after a blank line or a byte order mark it runs the file as a script.
bool begins_as_msh(std::string_view text) {
  static constexpr std::array<std::string_view, 3> signs{"$MeshFormat", "$NOD", "$Comments"};
  return std::any_of(signs.begin(), signs.end(), [text](std::string_view sign) { return text.starts_with(sign); });
}

}  // namespace

void check_beginning(const std::filesystem::path& path) {
  std::array<char, beginning_bytes> bytes{};
  std::ifstream file(path, std::ios::binary);
  file.read(bytes.data(), beginning_bytes);
  if (!begins_as_msh({bytes.data(), static_cast<std::size_t>(file.gcount())})) {
    throw Error("", "it does not begin as a Gmsh mesh, with $MeshFormat or $NOD",
                "export it again as a mesh; scripts are not run");
  }
}

}  // namespace chainmail::import
