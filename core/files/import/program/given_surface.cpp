#include "files/import/program/given_surface.h"

#include <fstream>
#include <iterator>
#include <span>
#include <variant>
#include <vector>

#include "files/import/handover.h"
#include "files/import/program/tasks.h"

namespace chainmail::import {

ImportedMesh read_surface(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  const std::vector<char> letters{std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
  auto imported = decode_imported(std::as_bytes(std::span(letters)), path);
  auto* mesh = std::get_if<ImportedMesh>(&imported);
  if (mesh == nullptr) {
    refuse("it contains no surface", "use a surface");
  }
  return std::move(*mesh);
}

}  // namespace chainmail::import
