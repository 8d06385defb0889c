#include "files/formats/medit.h"

#include <algorithm>
#include <array>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "files/formats/divided_cells.h"
#include "files/text/text.h"
#include "files/text/words.h"
#include "mesh/error.h"

namespace chainmail {
namespace {

/// A list of lines, faces or cells of the file.
struct MeditList {
  std::string_view keyword;
  std::size_t corners;
  std::optional<DividedKind> divided = {};
  std::span<const int> order = {};  // the corner of Medit for each of Gmsh's, where they differ
};

constexpr std::array<int, 10> tetrahedron_order{0, 1, 2, 3, 4,
                                                5, 6, 7, 9, 8};  // the corner of Medit for each of Gmsh's

constexpr std::array<MeditList, 12> read_lists{{{"Edges", 2},
                                                {"Triangles", 3},
                                                {"Quadrilaterals", 4},
                                                {"Tetrahedra", 4},
                                                {"Hexahedra", 8},
                                                {"Hexaedra", 8},  // the spelling of older programs
                                                {"Prisms", 6, DividedKind::prism},
                                                {"Pyramids", 5, DividedKind::pyramid},
                                                {"EdgesP2", 3, DividedKind::line3},
                                                {"TrianglesP2", 6, DividedKind::triangle6},
                                                {"QuadrilateralsQ2", 9, DividedKind::quadrangle9},
                                                {"TetrahedraP2", 10, DividedKind::tetrahedron10, tetrahedron_order}}};

/// True if a keyword is that of cells of second or higher order, such as HexahedraQ2 or TetrahedraP3.
bool is_of_higher_order(std::string_view keyword) {
  return std::ranges::any_of(read_lists, [keyword](const MeditList& list) {
    const std::string_view behind = keyword.substr(std::min(list.keyword.size(), keyword.size()));
    return keyword.starts_with(list.keyword) && behind.size() == 2 && (behind[0] == 'P' || behind[0] == 'Q');
  });
}

class MeditReader {
 public:
  MeditReader(std::string_view text, const std::filesystem::path& path, const Progress& progress)
      : words_(text, path, progress) {}

  ImportedMesh read() {
    read_head();
    for (std::string_view keyword = words_.next(); !keyword.empty() && keyword != "End"; keyword = words_.next()) {
      read_list(keyword);
    }
    return std::move(mesh_);
  }

 private:
  void read_head() {
    if (words_.next() != "MeshVersionFormatted") {
      words_.fail("it does not begin as a Medit mesh, with MeshVersionFormatted", "export it again as a mesh");
    }
    const std::uint32_t version = words_.count("the version of the format");
    if (version > 4) {  // bamg and FreeFem write 0
      words_.fail("version " + std::to_string(version) + " of Medit's format is not known", "save it as version 2");
    }
  }

  void read_list(std::string_view keyword) {
    const auto found = std::find_if(read_lists.begin(), read_lists.end(),
                                    [keyword](const MeditList& list) { return list.keyword == keyword; });
    if (keyword == "Dimension") {
      read_dimension();
    } else if (keyword == "Vertices") {
      read_vertices();
    } else if (found != read_lists.end()) {
      read_pieces(*found);
    } else if (parse_number(keyword)) {
      words_.fail(in_quotes(keyword) + " stands where a keyword is expected", "correct the count before it");
    } else if (is_of_higher_order(keyword)) {
      words_.fail("it contains " + std::string(keyword) + ", whose corners have no agreed order",
                  "save it as .vtu or .msh, or with cells of first order");
    } else {
      words_.skip_numbers();
    }
  }

  void read_dimension() {
    dimension_ = words_.count("the dimension");
    if (dimension_ != 2 && dimension_ != 3) {
      words_.fail("its vertices have " + std::to_string(dimension_) + " coordinates", "use 2 or 3 coordinates");
    }
  }

  /// Returns the count of a list of rows with `numbers` numbers each. A row takes at least two bytes per number, so a
  /// count cannot claim more rows than the file has.
  std::uint32_t read_count(std::size_t numbers) {
    const std::uint32_t count = words_.count("the number of rows");
    if (count > words_.left() / (2 * numbers) || count > element_limit) {
      words_.fail(std::to_string(count) + " rows are more than the file contains, or more than " +
                      std::to_string(element_limit),
                  "correct the count");
    }
    return count;
  }

  void read_vertices() {
    if (dimension_ == 0 || !mesh_.parts.rest.empty()) {
      words_.fail(dimension_ == 0 ? "the dimension is missing" : "there are two lists of vertices",
                  "write Dimension and then Vertices, once each");
    }
    const std::uint32_t count = read_count(dimension_);
    mesh_.parts.rest.reserve(count);
    for (std::uint32_t i = 0; i < count; ++i) {
      const double x = words_.coordinate(), y = words_.coordinate();
      mesh_.parts.rest.emplace_back(x, y, dimension_ == 3 ? words_.coordinate() : 0.0);
      skip_reference();
    }
  }

  void read_pieces(const MeditList& list) {
    const std::uint32_t count = read_count(list.corners);
    std::vector<ElementId> corners(list.corners);
    for (std::uint32_t i = 0; i < count; ++i) {
      std::ranges::generate(corners, [this] { return read_corner(); });
      skip_reference();
      add_piece(list, corners);
    }
  }

  ElementId read_corner() {
    const std::uint32_t number = words_.count("the number of a vertex");
    if (number < 1 || number > mesh_.parts.rest.size()) {
      words_.fail("there is no vertex " + std::to_string(number),
                  "use the numbers of the vertices before it, from 1 to " + std::to_string(mesh_.parts.rest.size()));
    }
    return number - 1;
  }

  /// Skips the reference number that ends a row.
  void skip_reference() {
    const std::string_view word = words_.next();
    if (!parse_number(word)) {
      words_.fail(word.empty() ? "it ends in the middle of a list"
                               : in_quotes(word) + " stands where the reference number of a row is expected",
                  "correct the row or the count");
    }
  }

  void add_piece(const MeditList& list, const std::vector<ElementId>& corners) {
    MeshParts& parts = mesh_.parts;
    if (list.divided) {
      add_divided(mesh_, *list.divided, in_order(corners, list.order));
    } else if (list.keyword == "Tetrahedra") {
      parts.tetrahedra.push_back({corners[0], corners[1], corners[2], corners[3]});
    } else if (list.corners == 8) {
      std::ranges::copy(corners, parts.hexahedra.emplace_back().begin());
    } else {
      add_face(parts, corners);
    }
  }

  Words words_;
  ImportedMesh mesh_;
  std::uint32_t dimension_ = 0;
};

}  // namespace

ImportedMesh read_medit(std::string_view text, const std::filesystem::path& path, const Progress& progress) {
  return MeditReader(text, path, progress).read();
}

}  // namespace chainmail
