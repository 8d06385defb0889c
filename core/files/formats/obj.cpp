#include "files/formats/obj.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <string>
#include <vector>

#include "files/formats/mesh_pieces.h"
#include "files/text/text.h"
#include "mesh/error.h"

namespace chainmail {
namespace {

/// Statements that define no elements or links. Lines with other statements are passed over, too, but counted.
constexpr std::array<std::string_view, 31> known_statements{
    "vn",    "vt",       "vp",       "g",    "o",    "s",      "mg",  "mtllib",     "usemtl",   "maplib", "usemap",
    "bevel", "c_interp", "d_interp", "lod",  "p",    "cstype", "deg", "bmat",       "step",     "curv",   "curv2",
    "surf",  "parm",     "trim",     "hole", "scrv", "sp",     "end", "shadow_obj", "trace_obj"};

std::optional<std::int64_t> parse_index(std::string_view word) {
  std::int64_t number = 0;
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), number);
  const bool whole = error == std::errc() && end == word.data() + word.size();
  return whole && number != 0 ? std::optional(number) : std::nullopt;
}

/// Returns the vertex index of a corner `v`, `v/t`, `v//n` or `v/t/n`. Texture coordinates and normals are not read, so
/// they may be missing or 0.
std::optional<std::int64_t> parse_corner(std::string_view word) {
  const std::size_t end = std::min(word.find('/'), word.size());
  const bool fits = word.find_first_not_of("0123456789-+/", end) == std::string_view::npos;
  return fits ? parse_index(word.substr(0, end)) : std::nullopt;
}

class ObjReader {
 public:
  explicit ObjReader(const std::filesystem::path& path) : path_(path) { result_.may_lack_links = true; }

  ImportedMesh read(std::string_view text, const Progress& progress);

 private:
  [[noreturn]] void fail(std::size_t line, const std::string& problem, const std::string& remedy) const {
    throw Error(shown(path_, line), problem, remedy);
  }
  void read_line(std::string_view line);
  void read_space(std::string_view line);
  void read_vertex(std::string_view rest);
  void read_corners(std::string_view rest);
  ElementId read_corner(std::string_view word);
  void add_corners_as_face();
  void check_farthest() const;

  const std::filesystem::path& path_;
  std::size_t line_ = 0;
  ImportedMesh result_;
  std::vector<ElementId> corners_;  // corners in the current line
  // The largest index that a line uses before its vertex is defined. The vertex may follow.
  ElementId farthest_ = 0;
  std::size_t farthest_line_ = 0;
};

ImportedMesh ObjReader::read(std::string_view text, const Progress& progress) {
  Lines lines(text, Lines::Backslash::joins);
  while (lines.next()) {
    line_ = lines.number();
    lines.report(progress);
    read_line(lines.line());
  }
  if (result_.parts.rest.empty()) {
    throw Error(shown(path_), "it contains no vertices", "write 'v x y z' for each element");
  }
  check_farthest();
  return std::move(result_);
}

void ObjReader::read_line(std::string_view line) {
  read_space(line);
  std::string_view rest = line.substr(0, line.find('#'));
  const auto word = take_word(rest);
  if (word == "v") {
    read_vertex(rest);
  } else if (word == "f") {
    read_corners(rest);
    add_corners_as_face();
  } else if (word == "l") {
    read_corners(rest);
    for (std::size_t i = 1; i < corners_.size(); ++i) {
      result_.parts.links.push_back({corners_[i - 1], corners_[i]});
    }
  } else if (!word.empty() &&
             std::find(known_statements.begin(), known_statements.end(), word) == known_statements.end()) {
    ++result_.skipped;
  }
}

void ObjReader::read_space(std::string_view line) {
  if (const auto space = stated_space(line, path_, line_)) {
    if (result_.space && result_.space->value != *space) {
      fail(line_, "the space dimension differs from that of line " + std::to_string(result_.space->line),
           "write it once");
    }
    result_.space = {*space, line_};
  }
}

void ObjReader::read_vertex(std::string_view rest) {
  if (result_.parts.rest.size() == element_limit) {
    fail(line_, "there are more than " + std::to_string(element_limit) + " vertices", "use a smaller mesh");
  }
  Point point;  // a weight or colours may follow
  for (int axis = 0; axis < 3; ++axis) {
    const auto word = take_word(rest);
    const auto number = parse_number(word);
    if (word.empty()) {
      fail(line_, "a vertex has " + std::to_string(axis) + " of its 3 coordinates", "write 'v x y z'");
    }
    if (!number || std::abs(*number) > coordinate_limit) {
      fail(line_, in_quotes(word) + " is not a valid coordinate", number_remedy(word));
    }
    point[axis] = *number;
  }
  result_.parts.rest.push_back(point);
}

void ObjReader::read_corners(std::string_view rest) {
  corners_.clear();
  for (auto word = take_word(rest); !word.empty(); word = take_word(rest)) {
    corners_.push_back(read_corner(word));
  }
}

ElementId ObjReader::read_corner(std::string_view word) {
  const auto index = parse_corner(word);
  if (!index) {
    fail(line_, in_quotes(word) + " is not the index of a vertex",
         "use 1, 2, … from the first vertex, or -1, -2, … from the last one read");
  }
  const auto known = static_cast<std::int64_t>(result_.parts.rest.size());
  const std::int64_t vertex = *index > 0 ? *index - 1 : known + *index;
  if (vertex < 0 || vertex >= static_cast<std::int64_t>(element_limit)) {
    fail(line_, "there is no vertex " + std::to_string(*index), "use the indices of the file's vertices");
  }
  const auto id = static_cast<ElementId>(vertex);
  if (vertex >= known && id > farthest_) {
    farthest_ = id;
    farthest_line_ = line_;
  }
  return id;
}

/// Adds a face. Some programs close it by naming its first corner again.
void ObjReader::add_corners_as_face() {
  if (corners_.size() > 3 && corners_.front() == corners_.back()) {
    corners_.pop_back();
  }
  result_.collapsed += corners_.size() < 3 ? 1 : 0;
  if (corners_.size() >= 2) {
    add_face(result_.parts, corners_);
  }
}

void ObjReader::check_farthest() const {
  if (farthest_line_ != 0 && farthest_ >= result_.parts.rest.size()) {
    fail(farthest_line_, "there is no vertex " + std::to_string(farthest_ + 1),
         "use an index up to " + std::to_string(result_.parts.rest.size()));
  }
}

void write_obj_vertices(TextBlocks& text, const MeshState& state, const Progress& progress) {
  const ElementId count = state.mesh.element_count();
  for (ElementId element = 0; element < count; ++element) {
    progress.report(element, count);
    text << 'v';
    for (const double coordinate : point_of(state.mesh, state.positions, element)) {
      text << ' ' << coordinate;
    }
    text << '\n';
  }
}

/// Writes one statement per piece.
void write_obj_pieces(TextBlocks& text, const MeshPieces& pieces, Piece piece, const Progress& progress) {
  const auto write = [&](MeshPieces::Corners corners) {
    text << (piece == Piece::line ? 'l' : 'f');
    for (const ElementId corner : corners) {
      text << ' ' << corner + 1;
    }
    text << '\n';
  };
  pieces.for_each(piece, write, progress);
}

}  // namespace

ImportedMesh read_obj(std::string_view text, const std::filesystem::path& path, const Progress& progress) {
  return ObjReader(path).read(text, progress);
}

void write_obj(std::ostream& out, const MeshState& state, const Progress& progress) {
  const MeshPieces pieces(state.mesh, state.cuts, {.cells = false}, progress.part(0, 0.3));
  TextBlocks text(out);
  text << space_comment(state.mesh, state.positions);
  write_obj_vertices(text, state, progress.part(0.3, 0.6));
  write_obj_pieces(text, pieces, Piece::triangle, progress.part(0.6, 0.7));
  write_obj_pieces(text, pieces, Piece::polygon, progress.part(0.7, 0.75));
  write_obj_pieces(text, pieces, Piece::side, progress.part(0.75, 0.8));
  write_obj_pieces(text, pieces, Piece::line, progress.part(0.8, 1));
  text.flush();
}

}  // namespace chainmail
