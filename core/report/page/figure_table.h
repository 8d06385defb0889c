#pragma once

#include <ostream>
#include <string>
#include <vector>

namespace chainmail::report {

/// A table of figures in words, as a page and a terminal show it.
struct FigureTable {
  struct Column {
    std::string group;  // of neighbouring columns
    std::string name;
  };
  struct Row {
    std::string label;
    std::vector<std::string> cells;  // one a column; none where there is a refusal
    std::string refusal;
  };

  std::string caption, about;
  std::string style;   // its class in the page: main, detail
  std::string corner;  // over the labels
  std::vector<Column> columns;
  std::vector<Row> rows;
};

/// As part of a page, in a box that scrolls sideways.
void write_html(std::ostream& out, const FigureTable& table);

/// Columns as wide as their widest cell, the first one to the left. A row of two is a name and a sentence.
void write_columns(std::ostream& out, const std::vector<std::vector<std::string>>& rows);

}  // namespace chainmail::report
