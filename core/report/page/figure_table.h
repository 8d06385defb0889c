#pragma once

#include <ostream>
#include <string>
#include <vector>

#include "measure/converging_reference.h"

namespace chainmail::report {

/// A table of figures as text, for a page or a terminal.
struct FigureTable {
  struct Column {
    std::string group;  // common heading of neighbouring columns
    std::string name;

    bool operator==(const Column&) const = default;
  };
  struct Row {
    std::string label;
    std::vector<std::string> cells;  // one per column; none if there is a refusal
    std::string refusal;
  };

  std::string caption, about = {};
  std::string style = {};  // CSS class: main, detail
  std::string corner;      // head of the column of labels
  std::vector<Column> columns = {};
  std::vector<Row> rows = {};
};

/// Writes the table as part of a page, in a box that scrolls horizontally.
void write_html(std::ostream& out, const FigureTable& table);

/// Writes the table as aligned text, with its caption above it.
void write_text(std::ostream& out, const FigureTable& table);

/// Writes rows as aligned text. Each column is as wide as its widest cell; the first column is left-aligned. A row of
/// two cells is a name and a sentence.
void write_columns(std::ostream& out, const std::vector<std::vector<std::string>>& rows);

/// Describes the levels of the references of some drags, of which there is at least one: elements, changes, how many
/// converged, and the observed orders.
std::string convergence_in_words(const std::vector<Convergence>& references);

}  // namespace chainmail::report
