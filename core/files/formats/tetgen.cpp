#include "files/formats/tetgen.h"

#include <array>
#include <cmath>
#include <string>
#include <utility>

#include "files/text/text.h"
#include "mesh/error.h"

namespace chainmail {
namespace {

/// Reads the rows of one of the two files: a header with their number, then numbered rows.
class TetGenTable {
 public:
  TetGenTable(const NamedText& file, const char* rows, const Progress& progress)
      : path_(file.path), size_(file.text.size()), rows_(rows), progress_(progress), lines_(file.text) {
    if (!next()) {
      fail("it contains no row", "begin with the number of " + std::string(rows_));
    }
    count_ = whole("the number of " + std::string(rows_));
    // Each row has at least two characters, so a header cannot claim more rows.
    if (count_ > size_ / 2 || count_ > element_limit) {
      fail(std::to_string(count_) + " " + rows_ + " are more than the file contains, or more than " +
               std::to_string(element_limit),
           "correct the count");
    }
  }

  [[noreturn]] void fail(const std::string& problem, const std::string& remedy) const {
    throw Error(shown(path_, std::max<std::size_t>(lines_.number(), 1)), problem, remedy);
  }

  /// Moves to the next line that is not blank or a comment. Returns false at the end.
  bool next() {
    while (lines_.next()) {
      lines_.report(progress_);
      rest_ = lines_.line().substr(0, lines_.line().find('#'));
      std::string_view look = rest_;
      if (!take_word(look).empty()) {
        return true;
      }
    }
    return false;
  }
  /// Moves to the next row. Fails if its number is not `number`.
  void next_row(std::uint64_t number) {
    if (!next()) {
      fail("it ends before row " + std::to_string(number) + " of its " + std::to_string(count_) + " " + rows_,
           "add the rows or correct the count");
    }
    if (whole("the number of a row") != number) {
      fail("this row is not numbered " + std::to_string(number), "number rows one after another, from 0 or 1");
    }
  }

  std::uint32_t whole(const std::string& what) {
    const auto word = take_word(rest_);
    const auto number = parse_count(word);
    if (!number) {
      fail((word.empty() ? "a number is missing: " : in_quotes(word) + " is not ") + what, "write a whole number");
    }
    return *number;
  }
  double coordinate() {
    const auto word = take_word(rest_);
    const auto number = parse_number(word);
    if (!number || std::abs(*number) > coordinate_limit) {
      fail(in_quotes(word) + " is not a valid coordinate", "write a finite decimal number");
    }
    return *number;
  }
  /// Returns the number of the first row without reading the row.
  std::uint32_t first_number() const {
    TetGenTable ahead = *this;
    return ahead.next() ? ahead.whole("the number of a row") : 0;
  }
  std::uint32_t count() const { return count_; }

 private:
  const std::filesystem::path& path_;
  std::size_t size_;
  const char* rows_;
  const Progress& progress_;
  Lines lines_;
  std::string_view rest_;
  std::uint32_t count_ = 0;
};

std::uint32_t read_tetgen_points(const NamedText& nodes, MeshParts& parts, const Progress& progress) {
  TetGenTable table(nodes, "points", progress);
  if (table.whole("the dimension") != 3) {
    table.fail("its points do not have 3 coordinates", "use points with 3 coordinates");
  }
  const std::uint32_t first = table.first_number();
  if (first > 1) {
    table.fail("the first row is numbered " + std::to_string(first), "number rows from 0 or 1");
  }
  parts.rest.reserve(table.count());
  for (std::uint32_t i = 0; i < table.count(); ++i) {
    table.next_row(std::uint64_t{first} + i);
    const double x = table.coordinate(), y = table.coordinate();
    parts.rest.emplace_back(x, y, table.coordinate());
  }
  return first;
}

void read_tetgen_cells(const NamedText& elements, std::uint32_t first_point, MeshParts& parts,
                       const Progress& progress) {
  TetGenTable table(elements, "tetrahedra", progress);
  if (table.whole("the number of corners") != 4) {
    table.fail("its tetrahedra do not have 4 corners", "save them with elements of first order");
  }
  const std::uint32_t first = table.first_number();
  for (std::uint32_t i = 0; i < table.count(); ++i) {
    table.next_row(std::uint64_t{first} + i);
    std::array<ElementId, 4> cell{};
    for (ElementId& corner : cell) {
      const std::uint32_t point = table.whole("the number of a point");
      if (point < first_point || point - first_point >= parts.rest.size()) {
        table.fail("there is no point " + std::to_string(point), "use the numbers of the .node file");
      }
      corner = point - first_point;
    }
    parts.tetrahedra.push_back(cell);
  }
}

/// Returns the path of the other file of the pair, which has this ending.
std::filesystem::path other_of_pair(const std::filesystem::path& path, const char* ending) {
  auto file = path;
  file.replace_extension(ending);
  std::error_code none;
  if (!std::filesystem::exists(file, none)) {
    throw Error(shown(path), "the other file of the pair, " + shown(file.filename()) + ", is missing",
                "put the .node and the .ele file into one folder");
  }
  return file;
}

}  // namespace

ImportedMesh read_tetgen(const NamedText& nodes, const NamedText& elements, const Progress& progress) {
  ImportedMesh mesh;
  const std::uint32_t first = read_tetgen_points(nodes, mesh.parts, progress.part(0, 0.5));
  read_tetgen_cells(elements, first, mesh.parts, progress.part(0.5, 1));
  return mesh;
}

ImportedMesh read_tetgen(RegularFile one, const Progress& progress) {
  const bool has_points = lower_case(one.path().extension().string()) == ".node";
  RegularFile other(other_of_pair(one.path(), has_points ? ".ele" : ".node"));
  RegularFile &nodes = has_points ? one : other, &elements = has_points ? other : one;
  const std::filesystem::path nodes_path = nodes.path(), elements_path = elements.path();
  const std::string points = read_text(std::move(nodes), "points", progress.part(0, 0.2));
  const std::string cells = read_text(std::move(elements), "tetrahedra", progress.part(0.2, 0.4));
  return read_tetgen({points, nodes_path}, {cells, elements_path}, progress.part(0.4, 1));
}

}  // namespace chainmail
