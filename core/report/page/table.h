#pragma once

#include <optional>
#include <ostream>
#include <string>
#include <vector>

#include "report/run/compare.h"

namespace chainmail::report {

/// A contestant in the main table: its times drag by drag, and the worst of its errors over the drags.
struct MainRow {
  std::string contestant;
  std::string refusal;  // where it did not take part
  std::vector<std::optional<double>> ms_per_move;
  Violation violation;
  std::optional<Distance> to_exact;
};

/// A row's figures as they are shown.
std::vector<std::string> cells_of(const MainRow& row);

/// The main table of one object.
struct MainTable {
  std::string object;
  std::string about;  // the object in words, its elements and links
  std::vector<std::string> drags;
  std::vector<MainRow> rows;
};
std::vector<MainTable> main_tables(const Comparison& comparison);

/// The main table as aligned text.
void write_text(std::ostream& out, const Comparison& comparison);

}  // namespace chainmail::report
