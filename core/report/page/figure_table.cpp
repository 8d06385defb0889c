#include "report/page/figure_table.h"

#include <algorithm>

#include "report/table/format.h"

namespace chainmail::report {
namespace {

void write_head(std::ostream& out, const FigureTable& table) {
  const auto& columns = table.columns;
  out << "<thead><tr><th></th>";
  for (std::size_t i = 0; i < columns.size();) {
    std::size_t end = i;
    while (end < columns.size() && columns[end].group == columns[i].group) {
      ++end;
    }
    out << "<th class=\"group\" colspan=\"" << end - i << "\">" << escaped(columns[i].group) << "</th>";
    i = end;
  }
  out << "</tr>\n<tr><th scope=\"col\">" << escaped(table.corner) << "</th>";
  for (const FigureTable::Column& column : columns) {
    out << "<th scope=\"col\">" << escaped(column.name) << "</th>";
  }
  out << "</tr></thead>\n";
}

/// Returns the cells of all rows, with the figures of each column aligned.
std::vector<std::vector<std::string>> aligned_cells(const FigureTable& table) {
  std::vector<std::vector<std::string>> rows(table.rows.size());
  for (std::size_t column = 0; column < table.columns.size(); ++column) {
    std::vector<std::string> cells;
    for (const FigureTable::Row& row : table.rows) {
      cells.push_back(column < row.cells.size() ? row.cells[column] : "");
    }
    cells = aligned(std::move(cells));
    for (std::size_t row = 0; row < rows.size(); ++row) {
      if (column < table.rows[row].cells.size()) {
        rows[row].push_back(cells[row]);
      }
    }
  }
  return rows;
}

/// Counts characters, not bytes.
std::size_t width_of(const std::string& text) {
  return static_cast<std::size_t>(std::ranges::count_if(text, [](char c) { return (c & 0xC0) != 0x80; }));
}

}  // namespace

void write_html(std::ostream& out, const FigureTable& table) {
  out << "<div class=\"wide\"><table class=\"" << table.style << "\">\n<caption><div>" << escaped(table.caption)
      << " <span class=\"faint\">" << escaped(table.about) << "</span></div></caption>\n";
  write_head(out, table);
  out << "<tbody>\n";
  const auto cells = aligned_cells(table);
  for (std::size_t i = 0; i < table.rows.size(); ++i) {
    const FigureTable::Row& row = table.rows[i];
    out << "<tr><th scope=\"row\">" << escaped(row.label) << "</th>";
    if (!row.refusal.empty()) {
      out << "<td class=\"refusal\" colspan=\"" << table.columns.size() << "\">" << escaped(row.refusal) << "</td>";
    }
    for (const std::string& cell : cells[i]) {
      out << "<td>" << escaped(cell) << "</td>";
    }
    out << "</tr>\n";
  }
  out << "</tbody></table></div>\n";
}

void write_text(std::ostream& out, const FigureTable& table) {
  std::vector<std::vector<std::string>> rows{{""}, {table.corner}};
  std::string group;
  for (const FigureTable::Column& column : table.columns) {
    rows[0].push_back(column.group == group ? "" : column.group);
    rows[1].push_back(column.name);
    group = column.group;
  }
  for (const FigureTable::Row& row : table.rows) {
    rows.push_back({row.label});
    rows.back().insert(rows.back().end(), row.cells.begin(), row.cells.end());
    if (!row.refusal.empty()) {
      rows.back().push_back(row.refusal);
    }
  }
  out << '\n' << table.caption << ": " << table.about << '\n';
  write_columns(out, rows);
}

void write_columns(std::ostream& out, const std::vector<std::vector<std::string>>& rows) {
  std::vector<std::size_t> widths;
  for (const auto& row : rows) {
    widths.resize(std::max(widths.size(), row.size()));
    for (std::size_t i = 0; i < row.size(); ++i) {
      // The second cell of a row of two is a sentence. It may be wider than the columns.
      widths[i] = std::max(widths[i], row.size() == 2 && i == 1 ? 0 : width_of(row[i]));
    }
  }
  for (const auto& row : rows) {
    for (std::size_t i = 0; i < row.size(); ++i) {
      const std::string blanks(widths[i] - std::min(widths[i], width_of(row[i])), ' ');
      out << (i == 0 ? "  " + row[i] + blanks : "  " + (row.size() == 2 ? "" : blanks) + row[i]);
    }
    out << '\n';
  }
}

namespace {

/// Returns the elements of each level, as on the first of the drags, and the largest change on that level.
std::string about_levels(const std::vector<Convergence>& references) {
  std::string text;
  for (std::size_t level = 0;; ++level) {
    std::uint64_t elements = 0;
    double change = 0;
    for (const Convergence& one : references) {
      if (level < one.levels.size()) {
        elements = elements == 0 ? one.levels[level].elements : elements;
        change = std::max(change, one.levels[level].change.value_or(0));
      }
    }
    if (elements == 0) {
      return text;
    }
    text += (level == 0 ? "" : ", ") + thousands(elements) + (level == 0 ? "" : " (" + percent(change) + ")");
  }
}

std::string about_orders(const std::vector<Convergence>& references) {
  std::vector<double> orders;
  for (const Convergence& one : references) {
    if (one.order) {
      orders.push_back(*one.order);
    }
  }
  if (orders.empty()) {
    return {};
  }
  const auto [low, high] = std::ranges::minmax(orders);
  return "; observed order " + figure(low) + " to " + figure(high);
}

}  // namespace

std::string convergence_in_words(const std::vector<Convergence>& references) {
  const auto converged = std::ranges::count(references, true, &Convergence::converged);
  const auto other = std::ranges::find(references, false, &Convergence::converged);
  return "elements of the reference on refined cells (largest change from the level before): " +
         about_levels(references) + "; below " + percent(converged_change) + " in " + std::to_string(converged) +
         " of " + std::to_string(references.size()) + " drags" +
         (other == references.end() ? "" : ", in others not, because " + other->end) + about_orders(references);
}

}  // namespace chainmail::report
