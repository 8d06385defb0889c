#include "files/formats/ply.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "files/formats/mesh_pieces.h"
#include "files/text/number_type.h"
#include "files/text/text.h"
#include "mesh/error.h"

namespace chainmail {
namespace {

struct PlyProperty {
  std::string name;
  const NumberType* type = nullptr;
  const NumberType* count = nullptr;  // type of a list's length; null if it is not a list
};

struct PlyElement {
  std::string name;
  std::uint64_t count = 0;
  std::vector<PlyProperty> properties;
};

enum class PlyForm { text, little_endian, big_endian };

/// The header of a PLY file: the elements that follow, and the properties of each.
struct PlyHead {
  PlyForm form = PlyForm::text;
  std::vector<PlyElement> elements;
  std::size_t length = 0;  // length of the header (bytes)
  std::size_t lines = 0;
  std::size_t skipped = 0;  // lines that the format does not have
};

constexpr std::array ply_types{
    number_type<std::int8_t>("char"),     number_type<std::int8_t>("int8"),     number_type<std::uint8_t>("uchar"),
    number_type<std::uint8_t>("uint8"),   number_type<std::int16_t>("short"),   number_type<std::int16_t>("int16"),
    number_type<std::uint16_t>("ushort"), number_type<std::uint16_t>("uint16"), number_type<std::int32_t>("int"),
    number_type<std::int32_t>("int32"),   number_type<std::uint32_t>("uint"),   number_type<std::uint32_t>("uint32"),
    number_type<float>("float"),          number_type<float>("float32"),        number_type<double>("double"),
    number_type<double>("float64"),
};

class PlyHeadReader {
 public:
  PlyHeadReader(std::string_view bytes, const std::filesystem::path& path) : bytes_(bytes), path_(path) {}

  PlyHead read() {
    head_.length = mark_length(bytes_);
    ends_ = bytes_.substr(0, bytes_.find("end_header")).find('\n') == std::string_view::npos ? '\r' : '\n';
    if (trimmed(line()) != "ply") {
      fail("it does not begin with 'ply'", "use a PLY file");
    }
    while (take(line())) {
    }
    if (!has_form_) {
      fail("its header has no line 'format …'", "export it again");
    }
    return std::move(head_);
  }

 private:
  [[noreturn]] void fail(const std::string& problem, const std::string& remedy) const {
    throw Error(shown(path_, std::max<std::size_t>(head_.lines, 1)), problem, remedy);
  }

  std::string_view line();
  /// Reads a line of the header. Returns false at the end of the header.
  bool take(std::string_view line);
  void take_form(std::string_view rest);
  void take_element(std::string_view rest);
  void take_property(std::string_view rest);
  const NumberType& type_of(std::string_view name) const;

  std::string_view bytes_;
  const std::filesystem::path& path_;
  bool has_form_ = false;
  char ends_ = '\n';  // the last character of each line
  PlyHead head_;
};

std::string_view PlyHeadReader::line() {
  const std::size_t end = bytes_.find(ends_, head_.length);
  ++head_.lines;
  if (end == std::string_view::npos) {
    fail("its header does not end", "export it again");
  }
  std::string_view line = bytes_.substr(head_.length, end - head_.length);
  head_.length = end + 1;
  if (line.ends_with('\r')) {
    line.remove_suffix(1);
  }
  return line;
}

bool PlyHeadReader::take(std::string_view line) {
  const std::string_view word = take_word(line);
  if (word == "end_header") {
    return false;
  }
  if (word == "format") {
    take_form(line);
  } else if (word == "element") {
    take_element(line);
  } else if (word == "property") {
    take_property(line);
  } else if (!word.empty() && word != "comment" && word != "obj_info") {
    ++head_.skipped;  // Blender 2.47 forgot the word 'comment'
  }
  return true;
}

void PlyHeadReader::take_form(std::string_view rest) {
  const std::string_view form = take_word(rest);
  if (form == "ascii") {
    head_.form = PlyForm::text;
  } else if (form == "binary_little_endian") {
    head_.form = PlyForm::little_endian;
  } else if (form == "binary_big_endian") {
    head_.form = PlyForm::big_endian;
  } else {
    fail("the format " + in_quotes(form) + " is not known", "save it as ascii or binary_little_endian");
  }
  has_form_ = true;
}

void PlyHeadReader::take_element(std::string_view rest) {
  PlyElement element;
  element.name = take_word(rest);
  const auto count = parse_count(take_word(rest));
  if (element.name.empty() || !count) {
    fail("an 'element' line has no name, or its count is not a whole number", "write 'element NAME COUNT'");
  }
  element.count = *count;
  head_.elements.push_back(std::move(element));
}

void PlyHeadReader::take_property(std::string_view rest) {
  if (head_.elements.empty()) {
    fail("a 'property' line comes before the first 'element' line", "write 'element NAME COUNT' before it");
  }
  PlyProperty property;
  std::string_view name = take_word(rest);
  if (name == "list") {
    property.count = &type_of(take_word(rest));
    name = take_word(rest);
  }
  property.type = &type_of(name);
  property.name = take_word(rest);
  head_.elements.back().properties.push_back(std::move(property));
}

const NumberType& PlyHeadReader::type_of(std::string_view name) const {
  const NumberType* found = find_number_type(ply_types, name);
  if (found == nullptr) {
    fail("numbers of type " + in_quotes(name) + " are not known", "save it with floats and ints");
  }
  return *found;
}

/// Reads the header. Throws Error, with the line.
PlyHead read_ply_head(std::string_view bytes, const std::filesystem::path& path) {
  return PlyHeadReader(bytes, path).read();
}

constexpr std::string_view ply_blanks = " \t\r\n";

/// Returns true for words like `nan` and `inf`, and for `-1.#IND` and `1.#QNAN00`, as earlier libraries of Microsoft
/// spell them. Properties other than positions may have them.
bool is_no_number(std::string_view word) {
  word.remove_prefix(word.starts_with('-') || word.starts_with('+') ? 1 : 0);
  return is_word(word.substr(0, 3), "nan") || is_word(word.substr(0, 3), "inf") || word.starts_with("1.#");
}

class PlyReader {
 public:
  PlyReader(std::string_view bytes, const std::filesystem::path& path, const Progress& progress)
      : bytes_(bytes), path_(path), progress_(progress), head_(read_ply_head(bytes, path)), at_(head_.length) {
    std::uint64_t elements = 0;
    for (const PlyElement& element : head_.elements) {
      elements += element.count;
    }
    const std::string_view body = bytes.substr(head_.length);
    const auto lines = std::max(std::count(body.begin(), body.end(), '\n'), std::count(body.begin(), body.end(), '\r'));
    has_lines_ = head_.form == PlyForm::text && static_cast<std::uint64_t>(lines) >= elements;
  }

  ImportedMesh read() {
    const auto count = double(head_.elements.size());
    for (std::size_t i = 0; i < head_.elements.size(); ++i) {
      read_elements(head_.elements[i], progress_.part(double(i) / count, double(i + 1) / count));
    }
    add_pieces();
    mesh_.skipped = head_.skipped;
    return std::move(mesh_);
  }

 private:
  [[noreturn]] void fail(const std::string& problem, const std::string& remedy) const;

  double number(const NumberType& type);
  double binary_number(const NumberType& type);
  /// Reads the numbers of one property of an element.
  void read_property(const PlyProperty& property);
  void read_elements(const PlyElement& element, const Progress& progress);
  void take_vertex(const PlyElement& element);
  void take_face(const PlyElement& element);
  void take_edge(const PlyElement& element);
  void take_strips(const PlyElement& element);
  /// Returns the numbers of a property of the current element; empty if it has no such property.
  std::span<const double> numbers_of(const PlyElement& element, std::string_view name) const;
  double number_of(const PlyElement& element, std::string_view name) const;
  ElementId id(double number) const;
  void add_pieces();

  std::string_view bytes_;
  const std::filesystem::path& path_;
  const Progress& progress_;
  PlyHead head_;
  std::size_t at_;
  bool has_lines_ = false;          // true if there are lines enough for one per element
  std::vector<double> numbers_;     // numbers of all properties of the current element
  std::vector<std::size_t> first_;  // index at which each property begins, and the end
  std::vector<double> corners_;     // count and corners of each face
  std::vector<std::array<double, 2>> edges_;
  ImportedMesh mesh_;
};

void PlyReader::fail(const std::string& problem, const std::string& remedy) const {
  const std::string_view read = bytes_.substr(head_.length, at_ - head_.length);
  const auto line = head_.lines + 1 + static_cast<std::size_t>(std::count(read.begin(), read.end(), '\n'));
  throw Error(head_.form == PlyForm::text ? shown(path_, line) : shown(path_), problem, remedy);
}

double PlyReader::binary_number(const NumberType& type) {
  if (bytes_.size() - at_ < type.bytes) {
    fail("it ends before the last element that its header states", "export it again");
  }
  const double number = type.read(bytes_.data() + at_, head_.form == PlyForm::big_endian);
  at_ += type.bytes;
  return number;
}

double PlyReader::number(const NumberType& type) {
  if (head_.form != PlyForm::text) {
    return binary_number(type);
  }
  const std::size_t begin = std::min(bytes_.find_first_not_of(ply_blanks, at_), bytes_.size());
  const std::size_t end = std::min(bytes_.find_first_of(ply_blanks, begin), bytes_.size());
  const auto number = parse_number(bytes_.substr(begin, end - begin));
  if (begin == end) {
    fail("it ends before the last element that its header states", "export it again");
  }
  at_ = begin;
  if (!number && !is_no_number(bytes_.substr(begin, end - begin))) {
    fail(in_quotes(bytes_.substr(begin, end - begin)) + " is not a number", "export it again");
  }
  at_ = end;
  return number.value_or(std::numeric_limits<double>::quiet_NaN());
}

void PlyReader::read_property(const PlyProperty& property) {
  double count = 1;
  if (property.count != nullptr) {
    count = number(*property.count);
    if (!(count >= 0 && count <= double(bytes_.size())) || count != std::floor(count)) {
      fail("the length of a list is not a whole number, or is larger than the rest of the file", "export it again");
    }
  }
  for (auto i = static_cast<std::size_t>(count); i > 0; --i) {
    numbers_.push_back(number(*property.type));
  }
}

void PlyReader::read_elements(const PlyElement& element, const Progress& progress) {
  const auto take = element.name == "vertex"      ? &PlyReader::take_vertex
                    : element.name == "face"      ? &PlyReader::take_face
                    : element.name == "edge"      ? &PlyReader::take_edge
                    : element.name == "tristrips" ? &PlyReader::take_strips
                                                  : nullptr;
  if (element.properties.empty()) {
    return;
  }
  for (std::uint64_t i = 0; i < element.count; ++i) {
    progress.report(i, element.count);
    numbers_.clear();
    first_.clear();
    for (const PlyProperty& property : element.properties) {
      first_.push_back(numbers_.size());
      read_property(property);
    }
    first_.push_back(numbers_.size());
    if (take != nullptr) {
      (this->*take)(element);
    }
    if (has_lines_) {  // some programs write more than their header says
      at_ = std::min(bytes_.find_first_of("\r\n", at_), bytes_.size());
    }
  }
}

std::span<const double> PlyReader::numbers_of(const PlyElement& element, std::string_view name) const {
  for (std::size_t i = 0; i < element.properties.size(); ++i) {
    if (element.properties[i].name == name) {
      return std::span(numbers_).subspan(first_[i], first_[i + 1] - first_[i]);
    }
  }
  return {};
}

double PlyReader::number_of(const PlyElement& element, std::string_view name) const {
  const auto numbers = numbers_of(element, name);
  if (numbers.size() != 1) {
    fail("the PLY element " + in_quotes(element.name) + " has no property " + in_quotes(name), "export it again");
  }
  return numbers.front();
}

void PlyReader::take_vertex(const PlyElement& element) {
  const Point point(number_of(element, "x"), number_of(element, "y"), number_of(element, "z"));
  if (!(point.cwiseAbs().maxCoeff() <= coordinate_limit) || !point.allFinite()) {
    fail("vertex " + std::to_string(mesh_.parts.rest.size()) +
             " has a coordinate that is not a number, or is beyond 1e100",
         "use finite coordinates");
  }
  if (mesh_.parts.rest.size() == element_limit) {
    fail("there are more than " + std::to_string(element_limit) + " vertices", "use a smaller mesh");
  }
  mesh_.parts.rest.push_back(point);
}

void PlyReader::take_face(const PlyElement& element) {
  auto corners = numbers_of(element, "vertex_indices");
  if (corners.empty()) {
    corners = numbers_of(element, "vertex_index");
  }
  mesh_.collapsed += corners.size() < 3 ? 1 : 0;
  if (corners.size() < 2) {
    return;
  }
  corners_.push_back(double(corners.size()));
  corners_.insert(corners_.end(), corners.begin(), corners.end());
}

void PlyReader::take_edge(const PlyElement& element) {
  edges_.push_back({number_of(element, "vertex1"), number_of(element, "vertex2")});
}

/// Reads strips of triangles, one after another; -1 ends a strip. Every second triangle of a strip is listed in the
/// opposite order (Turk 1994).
void PlyReader::take_strips(const PlyElement& element) {
  std::size_t first = 0;
  const auto corners = numbers_of(element, "vertex_indices");
  for (std::size_t i = 0; i < corners.size(); ++i) {
    if (corners[i] == -1) {
      first = i + 1;
    } else if (i >= first + 2) {
      const std::size_t odd = (i - first) % 2;
      corners_.insert(corners_.end(), {3, corners[i - 2], corners[i - 1 + odd], corners[i - odd]});
    }
  }
}

ElementId PlyReader::id(double number) const {
  if (!(number >= 0 && number < double(mesh_.parts.rest.size())) || number != std::floor(number)) {
    std::string text;
    append_number(text, number);
    throw Error(shown(path_), "a face or edge names the vertex " + text + ", which does not exist", "export it again");
  }
  return static_cast<ElementId>(number);
}

/// Adds faces and edges at the end, because vertices may follow them in the file.
void PlyReader::add_pieces() {
  std::vector<ElementId> face;
  for (std::size_t i = 0; i < corners_.size(); i += face.size() + 1) {
    face.clear();
    for (std::size_t k = 1; k <= static_cast<std::size_t>(corners_[i]); ++k) {
      face.push_back(id(corners_[i + k]));
    }
    add_face(mesh_.parts, face);
  }
  for (const auto& [a, b] : edges_) {
    mesh_.parts.links.push_back({id(a), id(b)});
  }
}

/// Returns true if the number of corners of each face fits into a byte, which readers expect.
bool fits_a_byte(const Mesh& mesh) {
  for (std::size_t i = 0; i < mesh.polygons.size(); i += mesh.polygons[i] + 1) {
    if (mesh.polygons[i] > 255) {
      return false;
    }
  }
  return true;
}

/// Writes the element `edge` only if there are edges, because not all readers know it.
void write_ply_header(TextBlocks& text, const Mesh& mesh, const MeshPieces& pieces) {
  text << "ply\nformat ascii 1.0\ncomment positions in mesh units; an edge is a link along no face\nelement vertex "
       << mesh.element_count() << "\nproperty double x\nproperty double y\nproperty double z\nelement face "
       << pieces.count(Piece::triangle) + pieces.count(Piece::polygon) + pieces.count(Piece::side) << "\nproperty list "
       << (fits_a_byte(mesh) ? "uchar" : "uint") << " int vertex_indices\n";
  if (pieces.count(Piece::line) > 0) {
    text << "element edge " << pieces.count(Piece::line) << "\nproperty int vertex1\nproperty int vertex2\n";
  }
  text << "end_header\n";
}

void write_ply_vertices(TextBlocks& text, const MeshState& state, const Progress& progress) {
  for (ElementId element = 0; element < state.mesh.element_count(); ++element) {
    progress.report(element, state.mesh.element_count());
    const Point point = point_of(state.mesh, state.positions, element);
    text << point.x() << ' ' << point.y() << ' ' << point.z() << '\n';
  }
}

void write_ply_faces(TextBlocks& text, const MeshPieces& pieces, Piece piece, const Progress& progress) {
  pieces.for_each(
      piece,
      [&](MeshPieces::Corners corners) {
        text << static_cast<std::uint32_t>(corners.size());
        for (const ElementId corner : corners) {
          text << ' ' << corner;
        }
        text << '\n';
      },
      progress);
}

}  // namespace

ImportedMesh read_ply(std::string_view bytes, const std::filesystem::path& path, const Progress& progress) {
  return PlyReader(bytes, path, progress).read();
}

void write_ply(std::ostream& out, const MeshState& state, const Progress& progress) {
  const MeshPieces pieces(state.mesh, state.cuts, {.cells = false}, progress.part(0, 0.3));
  TextBlocks text(out);
  write_ply_header(text, state.mesh, pieces);
  write_ply_vertices(text, state, progress.part(0.3, 0.6));
  write_ply_faces(text, pieces, Piece::triangle, progress.part(0.6, 0.7));
  write_ply_faces(text, pieces, Piece::polygon, progress.part(0.7, 0.75));
  write_ply_faces(text, pieces, Piece::side, progress.part(0.75, 0.8));
  pieces.for_each(
      Piece::line, [&](MeshPieces::Corners ends) { text << ends[0] << ' ' << ends[1] << '\n'; }, progress.part(0.8, 1));
  text.flush();
}

}  // namespace chainmail
