#include "files/formats/ply.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <span>
#include <string>
#include <vector>

#include "files/formats/mesh_pieces.h"
#include "files/formats/ply_head.h"
#include "files/text/number_type.h"
#include "files/text/text.h"
#include "mesh/error.h"

namespace chainmail {
namespace {

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
