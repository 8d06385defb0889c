#include "files/formats/stl.h"

#include <Eigen/Geometry>
#include <array>
#include <cmath>
#include <cstdint>
#include <string>
#include <unordered_map>
#include <vector>

#include "files/formats/mesh_pieces.h"
#include "files/formats/seeded_hash.h"
#include "files/text/number_type.h"
#include "files/text/text.h"
#include "mesh/error.h"
#include "mesh/mesh.h"
#include "mesh/polygon_triangles.h"

namespace chainmail {
namespace {

/// Gives equal positions one id, in the order in which they first appear. For formats that list faces by positions.
class PointIds {
 public:
  /// The points get into `points`.
  explicit PointIds(std::vector<Point>& points) : points_(points) {}

  ElementId of(const Point& point) {
    const std::array key{point.x() + 0.0, point.y() + 0.0, point.z() + 0.0};  // -0 is 0
    const auto [found, is_new] = ids_.try_emplace(key, static_cast<ElementId>(points_.size()));
    if (is_new) {
      points_.push_back(point);
    }
    return found->second;
  }

 private:
  std::vector<Point>& points_;
  std::unordered_map<std::array<double, 3>, ElementId, SeededHash> ids_;
};

constexpr std::size_t header_bytes = 84, facet_bytes = 50;
constexpr double rounding_of_corners = 1e-7;

constexpr auto real = number_type<float>("float"), whole = number_type<std::uint32_t>("uint");

/// Returns the number of facets that the header of a binary file states.
std::uint64_t stated_facets(std::string_view bytes) {
  return bytes.size() < header_bytes ? 0 : std::uint64_t(whole.read(bytes.data() + header_bytes - 4, false));
}

/// True if a file is binary, also if its header begins with 'solid' or bytes follow its facets. In a text, the bytes of
/// the count are letters, which are a count that no file can have.
bool is_binary(std::string_view bytes) {
  const std::uint64_t facets = stated_facets(bytes);
  return facets > 0 && facets <= (bytes.size() - header_bytes) / facet_bytes;
}

bool begins_with_solid(std::string_view bytes) {
  Lines lines(bytes.substr(0, std::min<std::size_t>(bytes.size(), 4096)));
  while (lines.next()) {
    std::string_view rest = lines.line();
    if (const auto word = take_word(rest); is_word(word, "solid") || is_word(word, "facet")) {
      return true;
    }
  }
  return false;
}

/// Collects facets.
class Facets {
 public:
  Facets() { mesh_.joins_within = rounding_of_corners; }

  /// True if a coordinate is a number that an object may have.
  static bool allows(double coordinate) { return std::abs(coordinate) <= coordinate_limit; }
  bool is_full() const { return mesh_.parts.rest.size() + 3 > element_limit; }
  std::size_t count() const { return mesh_.parts.triangles.size(); }
  void add(const std::array<Point, 3>& corners) {
    mesh_.parts.triangles.push_back({ids_.of(corners[0]), ids_.of(corners[1]), ids_.of(corners[2])});
  }
  ImportedMesh take() { return std::move(mesh_); }

 private:
  ImportedMesh mesh_;
  PointIds ids_{mesh_.parts.rest};
};

/// Reads as many facets as are stated, or all if there are none: some programs leave the count at 0.
ImportedMesh read_binary(std::string_view bytes, const std::filesystem::path& path, const Progress& progress) {
  Facets facets;
  const std::uint64_t present = (bytes.size() - header_bytes) / facet_bytes, counted = stated_facets(bytes),
                      stated = counted > 0 ? counted : present;
  if (stated > present) {
    throw Error(shown(path), "it ends after " + std::to_string(present) + " of " + std::to_string(stated) + " facets",
                "export it again");
  }
  for (std::uint64_t facet = 0; facet < stated; ++facet) {
    progress.report(facet, stated);
    const char* at = bytes.data() + header_bytes + facet * facet_bytes + 3 * sizeof(float);  // behind the normal
    std::array<Point, 3> corners;
    for (Point& corner : corners) {
      for (int axis = 0; axis < 3; ++axis, at += sizeof(float)) {
        corner[axis] = real.read(at, false);
        if (!Facets::allows(corner[axis])) {
          throw Error(shown(path), "facet " + std::to_string(facet + 1) + " has a coordinate that is not a number",
                      "export it again");
        }
      }
    }
    if (facets.is_full()) {
      throw Error(shown(path), "it has more than " + std::to_string(element_limit) + " points", "use a smaller mesh");
    }
    facets.add(corners);
  }
  return facets.take();
}

class TextStl {
 public:
  explicit TextStl(const std::filesystem::path& path) : path_(path) {}

  ImportedMesh read(std::string_view text, const Progress& progress) {
    Lines lines(text);
    while (lines.next()) {
      line_ = lines.number();
      lines.report(progress);
      read_line(lines.line());
    }
    if (corners_ > 0) {
      fail("it ends within a facet", "export it again");
    }
    return facets_.take();
  }

 private:
  [[noreturn]] void fail(const std::string& problem, const std::string& remedy) const {
    throw Error(shown(path_, line_), problem, remedy);
  }

  void read_line(std::string_view rest);
  void read_corner(std::string_view& rest);
  void end_facet();

  const std::filesystem::path& path_;
  std::size_t line_ = 0;
  bool has_begun_ = false;
  std::size_t corners_ = 0;  // of the present facet
  std::array<Point, 3> corner_;
  Facets facets_;
};

/// Reads a line, which may contain several statements. A name behind `solid` may contain any words.
void TextStl::read_line(std::string_view rest) {
  for (auto word = take_word(rest); !word.empty(); word = take_word(rest)) {
    if (is_word(word, "solid") || is_word(word, "endsolid")) {
      has_begun_ = true;
      return;
    }
    if (is_word(word, "vertex")) {
      read_corner(rest);
    } else if (is_word(word, "endfacet")) {
      end_facet();
    } else if (is_word(word, "facet")) {
      has_begun_ = true;
      if (corners_ > 0) {
        fail("a facet begins within another one", "export it again");
      }
      take_word(rest);  // normal, and its numbers, which may be missing or not numbers
      for (int i = 0; i < 3; ++i) {
        take_word(rest);
      }
    } else if (!has_begun_ || word.front() == '#') {
      return;  // comments
    } else if (!is_word(word, "outer") && !is_word(word, "loop") && !is_word(word, "endloop")) {
      fail(in_quotes(word) + " is not a statement of STL", "export it again");
    }
  }
}

void TextStl::read_corner(std::string_view& rest) {
  Point corner;
  for (int axis = 0; axis < 3; ++axis) {
    const auto word = take_word(rest);
    const auto number = parse_number(word);
    if (!number || !Facets::allows(*number)) {
      fail(word.empty() ? "a vertex has fewer than 3 coordinates" : in_quotes(word) + " is not a valid coordinate",
           number_remedy(word));
    }
    corner[axis] = *number;
  }
  if (corners_ == corner_.size()) {
    fail("a facet has more than 3 corners", "divide it into triangles");
  }
  corner_[corners_++] = corner;
}

void TextStl::end_facet() {
  if (corners_ != corner_.size()) {
    fail("a facet has " + std::to_string(corners_) + " of its 3 corners", "export it again");
  }
  if (facets_.is_full()) {
    fail("there are more than " + std::to_string(element_limit) + " points", "use a smaller mesh");
  }
  facets_.add(corner_);
  corners_ = 0;
}

void write_point(TextBlocks& text, std::string_view name, const Point& point) {
  text << name << ' ' << point.x() << ' ' << point.y() << ' ' << point.z() << '\n';
}

/// Writes the triangles of a face.
void write_facets(TextBlocks& text, const MeshState& state, MeshPieces::Corners corners) {
  std::vector<Point> rest;
  for (const ElementId corner : corners) {
    rest.push_back(state.mesh.rest_position(corner));
  }
  std::vector<std::array<ElementId, 3>> triangles;
  divide_polygon(corners, rest, triangles);
  for (const auto& triangle : triangles) {
    const auto at = [&](std::size_t i) { return point_of(state.mesh, state.positions, triangle[i]); };
    const Point normal = (at(1) - at(0)).cross(at(2) - at(0)).stableNormalized();
    write_point(text, "facet normal", normal.allFinite() ? normal : Point(Point::Zero()));
    text << "outer loop\n";
    for (const std::size_t i : {0, 1, 2}) {
      write_point(text, "vertex", at(i));
    }
    text << "endloop\nendfacet\n";
  }
}

}  // namespace

ImportedMesh read_stl(std::string_view bytes, const std::filesystem::path& path, const Progress& progress) {
  if (!is_binary(bytes) && begins_with_solid(bytes)) {
    auto mesh = TextStl(path).read(bytes.substr(0, bytes.find('\0')), progress);
    if (!mesh.parts.rest.empty() || bytes.size() < header_bytes || bytes.find('\0') > header_bytes) {
      return mesh;
    }
  }
  if (bytes.size() < header_bytes) {
    throw Error(shown(path), "it is neither text that begins with 'solid', nor long enough for binary STL",
                "export it again");
  }
  return read_binary(bytes, path, progress);
}

void write_stl(std::ostream& out, const MeshState& state, const Progress& progress) {
  const MeshPieces pieces(state.mesh, state.cuts, {.cells = false}, progress.part(0, 0.5));
  TextBlocks text(out);
  text << "solid chainmail\n";
  double from = 0.5;
  for (const Piece piece : {Piece::triangle, Piece::polygon, Piece::side}) {
    pieces.for_each(
        piece, [&](MeshPieces::Corners corners) { write_facets(text, state, corners); },
        progress.part(from, from + 0.15));
    from += 0.15;
  }
  text << "endsolid chainmail\n";
  text.flush();
}

}  // namespace chainmail
