#pragma once

#include <optional>
#include <ostream>
#include <string>
#include <vector>

#include "report/run/compare.h"

namespace chainmail::report {

/// A contestant in the main table: its time for each drag, and its worst errors over all drags.
struct MainRow {
  std::string contestant;
  std::string refusal;  // reason why it did not take part; else empty
  std::vector<std::optional<double>> ms_per_move;
  Violation violation;
  std::optional<Distance> to_exact;
};

/// Returns the figures of a row as text.
std::vector<std::string> cells_of(const MainRow& row);

/// The main table of one object.
struct MainTable {
  std::string object;
  std::string about;  // description of the object, with its numbers of elements and links
  std::vector<std::string> drags;
  std::vector<MainRow> rows;
};
std::vector<MainTable> main_tables(const Comparison& comparison);

/// Writes the main table as aligned text.
void write_text(std::ostream& out, const Comparison& comparison);

}  // namespace chainmail::report
