#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <span>

#include "files/formats/vtk.h"
#include "files/formats/vtk_cells.h"
#include "files/formats/vtk_cursor.h"
#include "files/text/text.h"
#include "mesh/error.h"

namespace chainmail {
namespace {

/// Cells one after another: cell i has the corners ids[first[i] .. first[i + 1]).
struct CellRows {
  std::vector<std::uint64_t> first{0};
  std::vector<std::uint64_t> ids;

  std::size_t count() const { return first.size() - 1; }
  VtkCells::Corners operator[](std::size_t i) const {
    return VtkCells::Corners(ids).subspan(first[i], first[i + 1] - first[i]);
  }
};

class VtkReader {
 public:
  VtkReader(std::string_view bytes, const std::filesystem::path& path, const Progress& progress)
      : cursor_(bytes, path, progress) {}

  ImportedMesh read() {
    read_head();
    while (read_section()) {
    }
    return std::move(mesh_);
  }

 private:
  void read_head();
  /// False where nothing comes any more that says what there is.
  bool read_section();
  void read_points();
  void read_field();
  CellRows read_rows();
  CellRows read_old_rows(std::uint64_t cells, std::uint64_t size);
  CellRows read_offsets(std::uint64_t offsets, std::uint64_t size);
  void read_types();
  void add_all(const CellRows& rows, int type);

  VtkCursor cursor_;
  bool has_offsets_ = false;  // from version 5 on
  CellRows cells_;            // of an unstructured grid, whose types come behind
  ImportedMesh mesh_;
  VtkCells into_{mesh_.parts, cursor_};
};

std::string capitals(std::string_view word) {
  std::string result(word);
  std::transform(result.begin(), result.end(), result.begin(),
                 [](unsigned char c) { return static_cast<char>(std::toupper(c)); });
  return result;
}

void VtkReader::read_head() {
  const auto mark = cursor_.line();
  static constexpr std::string_view version = "Version ";
  const std::size_t at = mark.find(version);
  has_offsets_ = at != std::string_view::npos && parse_number(mark.substr(at + version.size(), 1)).value_or(0) >= 5;
  cursor_.line();
  const std::string format = capitals(cursor_.word());
  if (format != "ASCII" && format != "BINARY") {
    cursor_.fail(in_quotes(format) + " is neither ASCII nor BINARY", "write one of them in the third line");
  }
  cursor_.set_binary(format == "BINARY");
  if (capitals(cursor_.word()) != "DATASET") {
    cursor_.fail("it does not say what DATASET it is", "export it anew");
  }
  const std::string kind = capitals(cursor_.word());
  if (kind != "POLYDATA" && kind != "UNSTRUCTURED_GRID") {
    cursor_.fail("a dataset " + in_quotes(kind) + " has no links of its own", "save it as an unstructured grid");
  }
}

bool VtkReader::read_section() {
  const std::string section = capitals(cursor_.word());
  if (section.empty() || section == "POINT_DATA" || section == "CELL_DATA") {
    return false;
  }
  if (section == "POINTS") {
    read_points();
  } else if (section == "CELLS") {
    cells_ = read_rows();
  } else if (section == "CELL_TYPES") {
    read_types();
  } else if (section == "LINES") {
    add_all(read_rows(), VtkCells::lines);
  } else if (section == "POLYGONS") {
    add_all(read_rows(), VtkCells::polygon);
  } else if (section == "TRIANGLE_STRIPS") {
    add_all(read_rows(), VtkCells::strip);
  } else if (section == "VERTICES") {
    read_rows();
  } else if (section == "FIELD") {
    read_field();
  } else if (section == "METADATA") {
    cursor_.skip_block();
  } else {
    cursor_.fail(in_quotes(section) + " is no section of a mesh", "export it anew");
  }
  return true;
}

void VtkReader::read_points() {
  const std::uint64_t count = cursor_.count("how many points there are");
  if (count > element_limit) {
    cursor_.fail("there are more than " + std::to_string(element_limit) + " points", "use a smaller mesh");
  }
  const auto numbers = cursor_.reals(3 * count, cursor_.word());
  for (std::size_t i = 0; i < numbers.size(); i += 3) {
    const Point point(numbers[i], numbers[i + 1], numbers[i + 2]);
    if (!point.allFinite() || !(point.cwiseAbs().maxCoeff() <= coordinate_limit)) {
      cursor_.fail("point " + std::to_string(i / 3) + " has a coordinate that is no number, or beyond 1e100",
                   "give finite coordinates");
    }
    mesh_.parts.rest.push_back(point);
  }
}

/// Fields, say of time, which are passed over.
void VtkReader::read_field() {
  cursor_.word();
  const std::uint64_t arrays = cursor_.count("how many arrays there are");
  for (std::uint64_t i = 0; i < arrays; ++i) {
    auto name = cursor_.word();
    if (name == "METADATA") {
      cursor_.skip_block();
      name = cursor_.word();
    }
    const std::uint64_t components = cursor_.count("how many components a field has");
    const std::uint64_t tuples = cursor_.count("how many rows a field has");
    cursor_.skip_numbers(components * tuples, cursor_.word());
  }
}

CellRows VtkReader::read_rows() {
  const std::uint64_t cells = cursor_.count("how many cells there are");
  const std::uint64_t size = cursor_.count("how many numbers they take");
  return has_offsets_ ? read_offsets(cells, size) : read_old_rows(cells, size);
}

/// Each cell as how many corners it has, and these.
CellRows VtkReader::read_old_rows(std::uint64_t cells, std::uint64_t size) {
  const auto numbers = cursor_.wholes(size, "int");
  CellRows rows;
  for (std::size_t at = 0; at < numbers.size(); at += numbers[at] + 1) {
    if (numbers[at] >= numbers.size() - at) {
      cursor_.fail("a cell has more corners than are given", "export it anew");
    }
    const auto corners = numbers.begin() + std::ptrdiff_t(at) + 1;
    rows.ids.insert(rows.ids.end(), corners, corners + std::ptrdiff_t(numbers[at]));
    rows.first.push_back(rows.ids.size());
  }
  if (rows.count() != cells) {
    cursor_.fail("it gives " + std::to_string(rows.count()) + " of " + std::to_string(cells) + " cells",
                 "export it anew");
  }
  return rows;
}

CellRows VtkReader::read_offsets(std::uint64_t offsets, std::uint64_t size) {
  const auto expect = [this](const char* what) {
    if (capitals(cursor_.word()) != what) {
      cursor_.fail(std::string("its ") + what + " are missing", "export it anew");
    }
    return cursor_.word();
  };
  CellRows rows;
  const auto offset_type = expect("OFFSETS");
  rows.first = cursor_.wholes(offsets, offset_type);
  const auto id_type = expect("CONNECTIVITY");
  rows.ids = cursor_.wholes(size, id_type);
  if (rows.first.empty()) {
    rows.first = {0};
  }
  if (rows.first.front() != 0 || !std::is_sorted(rows.first.begin(), rows.first.end()) || rows.first.back() != size) {
    cursor_.fail("its offsets do not part its corners", "export it anew");
  }
  return rows;
}

void VtkReader::read_types() {
  const std::uint64_t count = cursor_.count("how many types there are");
  if (count != cells_.count()) {
    cursor_.fail("there are " + std::to_string(count) + " types of " + std::to_string(cells_.count()) + " cells",
                 "export it anew");
  }
  const auto types = cursor_.wholes(count, "int");
  for (std::size_t i = 0; i < types.size(); ++i) {
    into_.add(cells_[i], int(std::min<std::uint64_t>(types[i], 1000)));
  }
}

void VtkReader::add_all(const CellRows& rows, int type) {
  for (std::size_t i = 0; i < rows.count(); ++i) {
    into_.add(rows[i], type);
  }
}

}  // namespace

ImportedMesh read_vtk(std::string_view bytes, const std::filesystem::path& path, const Progress& progress) {
  return VtkReader(bytes, path, progress).read();
}

}  // namespace chainmail
