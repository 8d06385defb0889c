#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string_view>
#include <vector>

#include "files/formats/space.h"
#include "mesh/mesh.h"

namespace chainmail {

/// What a .dat file says, line by line, before rows are looked at together.
struct DatRows {
  struct Row {
    ElementId id;
    std::size_t line;
    std::size_t first, last;  // of its neighbours
  };

  std::vector<Row> rows;
  std::vector<ElementId> neighbours;  // row after row, in the file's order
  std::optional<Stated<std::array<std::uint32_t, 3>>> size;
  std::optional<Stated<double>> spacing;
  std::optional<Stated<int>> space;
  std::size_t last_line = 0;
};

/// Throws Error, with its line, where a row or a statement is not well formed, where two statements
/// differ, and where an element is linked to itself.
DatRows parse_dat(std::string_view text, const std::filesystem::path& path, const Progress& progress);

}  // namespace chainmail
