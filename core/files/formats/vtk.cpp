#include "files/formats/vtk.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

#include "files/formats/vtk_cells.h"
#include "files/text/limits.h"
#include "files/text/number_type.h"
#include "files/text/text.h"
#include "mesh/error.h"

namespace chainmail {
namespace {

/// Reads words and numbers of a legacy VTK file. Words are text; numbers are text or binary.
class VtkCursor {
 public:
  VtkCursor(std::string_view bytes, const std::filesystem::path& path, const Progress& progress)
      : bytes_(bytes), path_(path), progress_(progress) {}

  /// Throws Error at the current line.
  [[noreturn]] void fail(const std::string& problem, const std::string& remedy) const;

  void set_binary(bool binary) { binary_ = binary; }
  /// Size of the file (bytes).
  std::size_t size() const { return bytes_.size(); }
  /// Returns the rest of the line, and moves to the next line.
  std::string_view line();
  /// Returns the next word, on this or a later line; empty at the end.
  std::string_view word();
  /// Returns the next word as a whole number. `what` describes it in error messages.
  std::uint64_t count(const std::string& what);

  /// Returns the next word as a number, also in a binary file.
  double number();
  /// Returns `count` numbers of a type. Before it takes memory, it checks that the file has enough bytes.
  std::vector<double> reals(std::uint64_t count, std::string_view type);
  /// Returns `count` whole numbers from 0.
  std::vector<std::uint64_t> wholes(std::uint64_t count, std::string_view type);
  /// Moves past a field, which may also have strings or bits.
  void skip_field(std::uint64_t count, std::string_view type);
  /// Moves to the line after the next blank line.
  void skip_block();

 private:
  template <class Visit>
  void visit_numbers(std::uint64_t count, std::string_view type, Visit visit);
  template <class Visit>
  void visit_binary(std::uint64_t count, std::string_view type, Visit visit);
  void skip_bytes(std::uint64_t count);
  void skip_string();

  std::string_view bytes_;
  const std::filesystem::path& path_;
  const Progress& progress_;
  std::size_t at_ = 0;
  bool binary_ = false;
};

constexpr std::string_view vtk_blanks = " \t\r\n";

/// Types of numbers, with the sizes that VTK's legacy readers use on 64-bit machines.
constexpr std::array vtk_types{
    number_type<float>("float"),
    number_type<double>("double"),
    number_type<std::int32_t>("int"),
    number_type<std::uint32_t>("unsigned_int"),
    number_type<std::int64_t>("long"),
    number_type<std::uint64_t>("unsigned_long"),
    number_type<std::int64_t>("vtktypeint64"),
    number_type<std::uint64_t>("vtktypeuint64"),
    number_type<std::int64_t>("vtkidtype"),
    number_type<std::int16_t>("short"),
    number_type<std::uint16_t>("unsigned_short"),
    number_type<std::int8_t>("char"),
    number_type<std::uint8_t>("unsigned_char"),
};

void VtkCursor::fail(const std::string& problem, const std::string& remedy) const {
  const auto lines = std::count(bytes_.begin(), bytes_.begin() + std::ptrdiff_t(std::min(at_, bytes_.size())), '\n');
  // In a binary file, lines have no meaning.
  throw Error(binary_ ? shown(path_) : shown(path_, static_cast<std::size_t>(lines) + 1), problem, remedy);
}

std::string_view VtkCursor::line() {
  const std::size_t end = std::min(bytes_.find('\n', at_), bytes_.size());
  std::string_view result = bytes_.substr(std::min(at_, end), end - std::min(at_, end));
  at_ = std::min(end + 1, bytes_.size());
  if (result.ends_with('\r')) {
    result.remove_suffix(1);
  }
  return result;
}

std::string_view VtkCursor::word() {
  at_ = std::min(bytes_.find_first_not_of(vtk_blanks, at_), bytes_.size());
  const std::size_t end = std::min(bytes_.find_first_of(vtk_blanks, at_), bytes_.size());
  const std::string_view result = bytes_.substr(at_, end - at_);
  at_ = end;
  return result;
}

std::uint64_t VtkCursor::count(const std::string& what) {
  const auto text = word();
  const auto number = parse_count(text);
  if (!number) {
    fail((text.empty() ? "a number is missing: " : in_quotes(text) + " is not ") + what, "write a whole number");
  }
  return *number;
}

double VtkCursor::number() {
  const auto text = word();
  const auto number = parse_number(text);
  if (!number) {
    fail(text.empty() ? "it ends within its numbers" : in_quotes(text) + " is not a number", number_remedy(text));
  }
  return *number;
}

template <class Visit>
void VtkCursor::visit_binary(std::uint64_t count, std::string_view type, Visit visit) {
  const NumberType* found = find_number_type(vtk_types, lower_case(type));
  if (found == nullptr) {
    fail("numbers of type " + in_quotes(type) + " are not known", "save it with floats or doubles");
  }
  line();  // the numbers begin on the next line
  if (count > (bytes_.size() - at_) / found->bytes) {
    fail("it ends within its numbers", "export it again");
  }
  for (std::uint64_t i = 0; i < count; ++i, at_ += found->bytes) {
    progress_.report(at_, bytes_.size());
    constexpr bool big_endian = true;
    visit(found->read(bytes_.data() + at_, big_endian));
  }
}

template <class Visit>
void VtkCursor::visit_numbers(std::uint64_t count, std::string_view type, Visit visit) {
  if (binary_) {
    return visit_binary(count, type, visit);
  }
  if (count > (bytes_.size() - at_ + 1) / 2) {
    fail("it ends within its numbers", "export it again");
  }
  for (std::uint64_t i = 0; i < count; ++i) {
    progress_.report(i, count);
    visit(number());
  }
}

std::vector<double> VtkCursor::reals(std::uint64_t count, std::string_view type) {
  std::vector<double> numbers;
  visit_numbers(count, type, [&](double number) { numbers.push_back(number); });
  return numbers;
}

std::vector<std::uint64_t> VtkCursor::wholes(std::uint64_t count, std::string_view type) {
  static constexpr double largest = 1e15;  // smaller whole numbers are exact in double
  std::vector<std::uint64_t> numbers;
  visit_numbers(count, type, [&](double number) {
    if (!(number >= 0 && number <= largest) || number != std::floor(number)) {
      fail("a number is not a whole number from 0", "export it again");
    }
    numbers.push_back(static_cast<std::uint64_t>(number));
  });
  return numbers;
}

void VtkCursor::skip_field(std::uint64_t count, std::string_view type) {
  if (type == "string") {
    line();
    for (std::uint64_t i = 0; i < count; ++i) {
      skip_string();
    }
  } else if (type == "bit" && binary_) {
    line();
    skip_bytes(count / 8 + (count % 8 > 0 ? 1 : 0));
  } else {
    visit_numbers(count, type, [](double) {});
  }
}

void VtkCursor::skip_bytes(std::uint64_t count) {
  if (count > bytes_.size() - at_) {
    fail("it ends within a field", "export it again");
  }
  at_ += count;
}

/// In a binary file, the two highest bits of the first byte say how many bytes the length has, big end first.
void VtkCursor::skip_string() {
  if (at_ == bytes_.size()) {
    fail("it ends within a field", "export it again");
  }
  if (!binary_) {
    line();
    return;
  }
  const auto first = static_cast<unsigned char>(bytes_[at_]);
  const std::size_t bytes = std::size_t{1} << (3U - (first >> 6U));
  std::uint64_t length = first & 63U;
  for (std::size_t i = 1; i < std::min(bytes, bytes_.size() - at_); ++i) {
    length = length << 8U | static_cast<unsigned char>(bytes_[at_ + i]);
  }
  skip_bytes(bytes);
  skip_bytes(length);
}

void VtkCursor::skip_block() {
  line();
  while (at_ < bytes_.size() && !line().empty()) {
  }
}

class VtkReader {
 public:
  VtkReader(std::string_view bytes, const std::filesystem::path& path, const Progress& progress)
      : cursor_(bytes, path, progress) {}

  ImportedMesh read() {
    read_head();
    while (read_section()) {
    }
    if (grid_[0] > 0) {
      add_grid();
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
  void add(VtkCells::Corners corners, int type);
  void read_size();
  void read_axis(std::size_t axis);
  Point read_point();
  void take_point(const Point& point);
  void add_grid();
  void add_grid_points();
  void add_grid_cell(std::uint64_t point);

  VtkCursor cursor_;
  bool has_offsets_ = false;                 // true for version 5 and later
  CellRows cells_;                           // cells of an unstructured grid; their types follow in the file
  std::array<std::uint64_t, 3> grid_{};      // points along each axis of a grid
  std::array<std::vector<double>, 3> axes_;  // of a rectilinear grid
  std::string kind_;                         // of the dataset
  Point origin_ = Point::Zero(), spacing_ = Point::Ones();
  ImportedMesh mesh_;
  VtkCells into_{mesh_};
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
  kind_ = upper_case(cursor_.word());
  static constexpr std::array<std::string_view, 5> kinds{"POLYDATA", "UNSTRUCTURED_GRID", "STRUCTURED_GRID",
                                                         "RECTILINEAR_GRID", "STRUCTURED_POINTS"};
  if (std::find(kinds.begin(), kinds.end(), kind_) == kinds.end()) {
    cursor_.fail("a dataset " + in_quotes(kind_) + " is not supported", "save it as an unstructured grid");
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
  } else if (section == "DIMENSIONS") {
    read_size();
  } else if (section == "ORIGIN") {
    origin_ = read_point();
  } else if (section == "SPACING" || section == "ASPECT_RATIO") {
    spacing_ = read_point();
  } else if (section == "X_COORDINATES" || section == "Y_COORDINATES" || section == "Z_COORDINATES") {
    read_axis(std::size_t(section[0] - 'X'));
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
    take_point({numbers[i], numbers[i + 1], numbers[i + 2]});
  }
}

void VtkReader::take_point(const Point& point) {
  if (!point.allFinite() || !(point.cwiseAbs().maxCoeff() <= coordinate_limit)) {
    cursor_.fail("point " + std::to_string(mesh_.parts.rest.size()) +
                     " has a coordinate that is not a number, or is beyond 1e100",
                 "use finite coordinates");
  }
  mesh_.parts.rest.push_back(point);
}

Point VtkReader::read_point() {
  const double x = cursor_.number(), y = cursor_.number();
  return {x, y, cursor_.number()};
}

void VtkReader::read_size() {
  std::uint64_t points = 1;
  for (std::uint64_t& size : grid_) {
    size = cursor_.count("the number of points along an axis");
    if (size == 0 || size > element_limit || (points *= size) > element_limit) {
      cursor_.fail("the grid has no points, or more than " + std::to_string(element_limit), "use a smaller grid");
    }
  }
}

void VtkReader::read_axis(std::size_t axis) {
  const std::uint64_t count = cursor_.count("the number of coordinates");
  axes_[axis] = cursor_.reals(count, cursor_.word());
  if (count != grid_[axis]) {
    cursor_.fail("there are " + std::to_string(count) + " coordinates for " + std::to_string(grid_[axis]) + " points",
                 "export it again");
  }
}

/// Adds what a grid does not list: its cells, and unless it is a structured grid, its points.
void VtkReader::add_grid() {
  const std::uint64_t count = grid_[0] * grid_[1] * grid_[2];
  if (mesh_.parts.rest.empty()) {
    add_grid_points();
  }
  if (mesh_.parts.rest.size() != count) {
    cursor_.fail("it has " + std::to_string(mesh_.parts.rest.size()) + " points, but its dimensions give " +
                     std::to_string(count),
                 "export it again");
  }
  for (std::uint64_t z = 0; z < std::max<std::uint64_t>(grid_[2] - 1, 1); ++z) {
    for (std::uint64_t y = 0; y < std::max<std::uint64_t>(grid_[1] - 1, 1); ++y) {
      for (std::uint64_t x = 0; x < std::max<std::uint64_t>(grid_[0] - 1, 1); ++x) {
        add_grid_cell(x + grid_[0] * (y + grid_[1] * z));
      }
    }
  }
}

/// A file that states neither points nor values for them could name any number of points in a few bytes.
void VtkReader::add_grid_points() {
  if (kind_ == "STRUCTURED_GRID") {
    cursor_.fail("the section POINTS is missing", "export it again");
  }
  if (kind_ == "RECTILINEAR_GRID" && std::ranges::any_of(axes_, [](const auto& axis) { return axis.empty(); })) {
    cursor_.fail("the coordinates of an axis are missing", "give X_COORDINATES, Y_COORDINATES and Z_COORDINATES");
  }
  if (grid_[0] * grid_[1] * grid_[2] > std::max<std::uint64_t>(limits::points_without_values, cursor_.size())) {
    cursor_.fail("it has fewer bytes than its grid has points, which are more than " +
                     std::to_string(limits::points_without_values),
                 "use a smaller grid, or save it as an unstructured grid");
  }
  const auto place = [&](std::size_t axis, std::uint64_t i) {
    const auto& own = axes_[axis];
    return own.empty() ? origin_[Eigen::Index(axis)] + spacing_[Eigen::Index(axis)] * double(i) : own[i];
  };
  for (std::uint64_t z = 0; z < grid_[2]; ++z) {
    for (std::uint64_t y = 0; y < grid_[1]; ++y) {
      for (std::uint64_t x = 0; x < grid_[0]; ++x) {
        take_point({place(0, x), place(1, y), place(2, z)});
      }
    }
  }
}

/// Adds the cell behind a point: along each axis with more than one point it reaches to the next.
void VtkReader::add_grid_cell(std::uint64_t point) {
  static constexpr std::array<int, 9> types{0, 0, VtkCells::line, 0, VtkCells::pixel, 0, 0, 0, VtkCells::voxel};
  std::vector<std::uint64_t> corners{point};
  std::uint64_t step = 1;
  for (const std::uint64_t size : grid_) {
    const std::size_t before = size > 1 ? corners.size() : 0;
    for (std::size_t i = 0; i < before; ++i) {
      corners.push_back(corners[i] + step);
    }
    step *= size;
  }
  if (corners.size() > 1) {
    add(corners, types[corners.size()]);
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
    cursor_.skip_field(components * tuples, cursor_.word());
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
    add(cells_[i], int(std::min<std::uint64_t>(types[i], 1000)));
  }
}

/// Adds a cell; an error gets its line.
void VtkReader::add(VtkCells::Corners corners, int type) {
  try {
    into_.add(corners, type);
  } catch (const Error& error) {
    cursor_.fail(error.problem(), error.remedy());
  }
}

void VtkReader::add_all(const CellRows& rows, int type) {
  for (std::size_t i = 0; i < rows.count(); ++i) {
    add(rows[i], type);
  }
}

}  // namespace

ImportedMesh read_vtk(std::string_view bytes, const std::filesystem::path& path, const Progress& progress) {
  return VtkReader(bytes, path, progress).read();
}

}  // namespace chainmail
