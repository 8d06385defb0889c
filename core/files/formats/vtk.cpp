#include "files/formats/vtk.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <span>
#include <string>
#include <vector>

#include "files/formats/vtk_cursor.h"
#include "files/text/text.h"
#include "mesh/error.h"

namespace chainmail {
namespace {

/// Adds cells of legacy VTK to a mesh that already has its points.
class VtkCells {
 public:
  /// VTK's numbers of the cell types.
  enum Type {
    vertex = 1,
    vertices,
    line,
    lines,
    triangle,
    strip,
    polygon,
    pixel,
    quad,
    tetrahedron,
    voxel,
    hexahedron
  };

  using Corners = std::span<const std::uint64_t>;

  /// `cursor` provides the line for error messages.
  VtkCells(MeshParts& parts, const VtkCursor& cursor) : parts_(parts), cursor_(cursor) {}

  /// Adds a cell. Throws Error if the corners do not fit the type, or if the type is not supported.
  void add(Corners corners, int type);

 private:
  void add_chain(Corners corners);
  void add_face(Corners corners);
  template <std::size_t Size>
  void add_group(std::vector<std::array<ElementId, Size>>& groups, Corners corners, const std::array<int, Size>& order);
  ElementId id(std::uint64_t point) const;

  MeshParts& parts_;
  const VtkCursor& cursor_;
};

ElementId VtkCells::id(std::uint64_t point) const {
  if (point >= parts_.rest.size()) {
    cursor_.fail("a cell names point " + std::to_string(point) + ", which does not exist", "export it again");
  }
  return static_cast<ElementId>(point);
}

void VtkCells::add_chain(Corners corners) {
  for (std::size_t i = 1; i < corners.size(); ++i) {
    parts_.links.push_back({id(corners[i - 1]), id(corners[i])});
  }
}

void VtkCells::add_face(Corners corners) {
  if (corners.size() < 3) {
    cursor_.fail("a face has fewer than 3 corners", "export it again");
  }
  if (corners.size() == 3) {
    parts_.triangles.push_back({id(corners[0]), id(corners[1]), id(corners[2])});
    return;
  }
  parts_.polygons.push_back(static_cast<ElementId>(corners.size()));
  for (const std::uint64_t corner : corners) {
    parts_.polygons.push_back(id(corner));
  }
}

template <std::size_t Size>
void VtkCells::add_group(std::vector<std::array<ElementId, Size>>& groups, Corners corners,
                         const std::array<int, Size>& order) {
  if (corners.size() != Size) {
    cursor_.fail("a cell has " + std::to_string(corners.size()) + " corners, but its type has " + std::to_string(Size),
                 "export it again");
  }
  std::array<ElementId, Size> group{};
  std::transform(order.begin(), order.end(), group.begin(), [&](int place) { return id(corners[place]); });
  groups.push_back(group);
}

void VtkCells::add(Corners corners, int type) {
  switch (type) {
    case vertex:
    case vertices:
      return;
    case line:
    case lines:
      return add_chain(corners);
    case strip:
      for (std::size_t i = 2; i < corners.size(); ++i) {
        add_face(corners.subspan(i - 2, 3));
      }
      return;
    case triangle:
    case polygon:
    case quad:
      return add_face(corners);
    case pixel:
      if (corners.size() == 4) {
        return add_face(std::array{corners[0], corners[1], corners[3], corners[2]});
      }
      return add_face(corners);
    case tetrahedron:
      return add_group(parts_.tetrahedra, corners, {0, 1, 2, 3});
    case voxel:
      return add_group(parts_.hexahedra, corners, {0, 1, 3, 2, 4, 5, 7, 6});
    case hexahedron:
      return add_group(parts_.hexahedra, corners, {0, 1, 2, 3, 4, 5, 6, 7});
    default:
      cursor_.fail("it contains cells of VTK's type " + std::to_string(type),
                   "split them into tetrahedra, or save them as cells of first order");
  }
}

/// The corners of cells: cell i has the corners ids[first[i] .. first[i + 1]).
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
  /// Reads the next section. Returns false at the end of the file, or if only fields follow.
  bool read_section();
  void read_points();
  void read_field();
  CellRows read_rows();
  CellRows read_old_rows(std::uint64_t cells, std::uint64_t size);
  CellRows read_offsets(std::uint64_t offsets, std::uint64_t size);
  void read_types();
  void add_all(const CellRows& rows, int type);

  VtkCursor cursor_;
  bool has_offsets_ = false;  // true for version 5 and later
  CellRows cells_;            // cells of an unstructured grid; their types follow in the file
  ImportedMesh mesh_;
  VtkCells into_{mesh_.parts, cursor_};
};

std::string upper_case(std::string_view word) {
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
  const std::string format = upper_case(cursor_.word());
  if (format != "ASCII" && format != "BINARY") {
    cursor_.fail(in_quotes(format) + " is neither ASCII nor BINARY", "write one of them in the third line");
  }
  cursor_.set_binary(format == "BINARY");
  if (upper_case(cursor_.word()) != "DATASET") {
    cursor_.fail("the line 'DATASET …' is missing", "export it again");
  }
  const std::string kind = upper_case(cursor_.word());
  if (kind != "POLYDATA" && kind != "UNSTRUCTURED_GRID") {
    cursor_.fail("a dataset " + in_quotes(kind) + " is not supported", "save it as an unstructured grid");
  }
}

bool VtkReader::read_section() {
  const std::string section = upper_case(cursor_.word());
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
    cursor_.fail(in_quotes(section) + " is not a section of a mesh", "export it again");
  }
  return true;
}

void VtkReader::read_points() {
  const std::uint64_t count = cursor_.count("the number of points");
  if (count > element_limit) {
    cursor_.fail("there are more than " + std::to_string(element_limit) + " points", "use a smaller mesh");
  }
  const auto numbers = cursor_.reals(3 * count, cursor_.word());
  for (std::size_t i = 0; i < numbers.size(); i += 3) {
    const Point point(numbers[i], numbers[i + 1], numbers[i + 2]);
    if (!point.allFinite() || !(point.cwiseAbs().maxCoeff() <= coordinate_limit)) {
      cursor_.fail("point " + std::to_string(i / 3) + " has a coordinate that is not a number, or is beyond 1e100",
                   "use finite coordinates");
    }
    mesh_.parts.rest.push_back(point);
  }
}

/// Skips fields, for example of time.
void VtkReader::read_field() {
  cursor_.word();
  const std::uint64_t arrays = cursor_.count("the number of arrays");
  for (std::uint64_t i = 0; i < arrays; ++i) {
    auto name = cursor_.word();
    if (name == "METADATA") {
      cursor_.skip_block();
      name = cursor_.word();
    }
    const std::uint64_t components = cursor_.count("the number of components of a field");
    const std::uint64_t tuples = cursor_.count("the number of rows of a field");
    cursor_.skip_numbers(components * tuples, cursor_.word());
  }
}

CellRows VtkReader::read_rows() {
  const std::uint64_t cells = cursor_.count("the number of cells");
  const std::uint64_t size = cursor_.count("the length of the cell list");
  return has_offsets_ ? read_offsets(cells, size) : read_old_rows(cells, size);
}

/// Reads cells in the format before version 5: each cell is its number of corners, then the corners.
CellRows VtkReader::read_old_rows(std::uint64_t cells, std::uint64_t size) {
  const auto numbers = cursor_.wholes(size, "int");
  CellRows rows;
  for (std::size_t at = 0; at < numbers.size(); at += numbers[at] + 1) {
    if (numbers[at] >= numbers.size() - at) {
      cursor_.fail("a cell has more corners than the cell list", "export it again");
    }
    const auto corners = numbers.begin() + std::ptrdiff_t(at) + 1;
    rows.ids.insert(rows.ids.end(), corners, corners + std::ptrdiff_t(numbers[at]));
    rows.first.push_back(rows.ids.size());
  }
  if (rows.count() != cells) {
    cursor_.fail("it contains only " + std::to_string(rows.count()) + " of " + std::to_string(cells) + " cells",
                 "export it again");
  }
  return rows;
}

CellRows VtkReader::read_offsets(std::uint64_t offsets, std::uint64_t size) {
  const auto expect = [this](const char* what) {
    if (upper_case(cursor_.word()) != what) {
      cursor_.fail(std::string("its ") + what + " are missing", "export it again");
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
    cursor_.fail("its offsets do not match its corners", "export it again");
  }
  return rows;
}

void VtkReader::read_types() {
  const std::uint64_t count = cursor_.count("the number of types");
  if (count != cells_.count()) {
    cursor_.fail("there are " + std::to_string(count) + " types for " + std::to_string(cells_.count()) + " cells",
                 "export it again");
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
