#include "files/formats/msh.h"

#include <algorithm>
#include <array>
#include <string>
#include <unordered_set>

#include "files/formats/mesh_pieces.h"
#include "files/text/text.h"
#include "files/text/words.h"

namespace chainmail {
namespace {

constexpr MshType divided_type(int number, DividedKind kind) { return {number, corner_count(kind), kind}; }

}  // namespace

const MshType* msh_type(int number) {
  using enum DividedKind;
  static constexpr std::array types{
      MshType{msh_point, 1, {}},      MshType{msh_line, 2, {}},        MshType{msh_triangle, 3, {}},
      MshType{msh_quadrangle, 4, {}}, MshType{msh_tetrahedron, 4, {}}, MshType{msh_hexahedron, 8, {}},
      divided_type(6, prism),         divided_type(7, pyramid),        divided_type(8, line3),
      divided_type(9, triangle6),     divided_type(10, quadrangle9),   divided_type(11, tetrahedron10),
      divided_type(12, hexahedron27), divided_type(13, prism18),       divided_type(14, pyramid14),
      divided_type(16, quadrangle8),  divided_type(17, hexahedron20),  divided_type(18, prism15),
      divided_type(19, pyramid13)};
  const auto* const found =
      std::find_if(types.begin(), types.end(), [number](const MshType& type) { return type.number == number; });
  return found == types.end() ? nullptr : found;
}

namespace {

/// Passes through the nodes and elements of a file, as Gmsh does.
class MshCheck {
 public:
  MshCheck(std::string_view text, const std::filesystem::path& path) : words_(text, path, nobody_) {}

  void run() {
    for (auto word = words_.next(); !word.empty(); word = words_.next()) {
      if (word == "$MeshFormat" && !read_format()) {
        return;
      }
      if (word == "$Nodes") {
        is_version_4_ ? read_blocks("node", &MshCheck::read_node_block)
                      : read_rows(words_.count(rows), "node", &MshCheck::read_node);
      } else if (word == "$Elements") {
        is_version_4_ ? read_blocks("element", &MshCheck::read_element_block)
                      : read_rows(words_.count(rows), "element", &MshCheck::read_element);
      }
    }
  }

 private:
  static constexpr const char* rows = "the number of rows";

  /// Returns false if the rest is not known here.
  bool read_format() {
    const std::string_view version = words_.next();
    is_version_4_ = version == "4.1";
    return (is_version_4_ || version == "2" || version.starts_with("2.")) && words_.next() == "0";
  }

  /// Looks at rows, and at the end of their section.
  void read_rows(std::uint32_t count, const char* what, void (MshCheck::*read)()) {
    for (std::uint32_t i = 0; i < count; ++i) {
      expect_more(i, count, what);
      (this->*read)();
    }
    end(what);
  }

  void read_blocks(const char* what, void (MshCheck::*read)()) {
    const std::uint32_t blocks = words_.count("the number of blocks");
    for (const char* head : {rows, "the lowest tag", "the highest tag"}) {
      words_.count(head);
    }
    for (std::uint32_t i = 0; i < blocks; ++i) {
      expect_more(i, blocks, "block");
      words_.count("a dimension");
      words_.count("the tag of an entity");
      (this->*read)();
    }
    end(what);
  }

  void expect_more(std::uint32_t done, std::uint32_t stated, const std::string& what) {
    if (const auto word = words_.peek(); word.empty() || word.starts_with('$')) {
      words_.next();
      words_.fail(std::to_string(stated) + " " + what + "s are stated, but there are " + std::to_string(done),
                  "export it again");
    }
  }

  void end(const std::string& what) {
    if (const auto word = words_.next(); !word.starts_with("$End")) {
      words_.fail("there are more " + what + "s than stated", "export it again");
    }
  }

  void read_point() {
    for (int axis = 0; axis < 3; ++axis) {
      words_.coordinate();
    }
  }

  void read_node() {
    tags_.insert(words_.count("the tag of a node"));
    read_point();
  }

  /// All tags stand before all points.
  void read_node_block() {
    const bool is_parametric = words_.next() != "0";
    const std::uint32_t count = words_.count(rows);
    for (std::uint32_t i = 0; i < count; ++i) {
      expect_more(i, count, "node");
      tags_.insert(words_.count("the tag of a node"));
    }
    for (std::uint32_t i = 0; i < count; ++i) {
      expect_more(i, count, "point");
      read_point();
      if (is_parametric) {
        words_.skip_line();
      }
    }
  }

  void read_element() {
    words_.count("the tag of an element");
    const std::uint32_t type = words_.count("the type of an element");
    for (std::uint32_t left = words_.count("the number of tags"); left > 0 && !words_.ends_line(); --left) {
      words_.next();
    }
    read_corners(type);
  }

  void read_corners(std::uint32_t type) {
    const MshType* const known = msh_type(int(type));
    if (known == nullptr) {
      words_.fail("Gmsh's type " + std::to_string(type) + " is of higher order, or unknown",
                  "save it with elements of first or second order");
    }
    for (std::size_t i = 0; i < known->corners; ++i) {
      if (words_.ends_line()) {
        words_.fail("an element of Gmsh's type " + std::to_string(type) + " has " + std::to_string(i) +
                        " corners, but needs " + std::to_string(known->corners),
                    "export it again");
      }
      if (const std::uint32_t tag = words_.count("the tag of a node"); !tags_.contains(tag)) {
        words_.fail("there is no node " + std::to_string(tag), "export it again");
      }
    }
  }

  void read_element_block() {
    const std::uint32_t type = words_.count("the type of an element");
    const std::uint32_t count = words_.count(rows);
    for (std::uint32_t i = 0; i < count; ++i) {
      expect_more(i, count, "element");
      words_.count("the tag of an element");
      read_corners(type);
    }
  }

  Progress nobody_;
  Words words_;
  std::unordered_set<std::uint32_t> tags_;
  bool is_version_4_ = false;
};

}  // namespace

void check_msh(std::string_view text, const std::filesystem::path& path) { MshCheck(text, path).run(); }

namespace {

/// Gmsh's numbers for a kind of piece: the dimension of its entity, and its type.
struct PieceType {
  Piece piece;
  std::uint32_t dimension;
  std::uint32_t type;
};
constexpr std::array piece_types{PieceType{Piece::line, 1, msh_line}, PieceType{Piece::triangle, 2, msh_triangle},
                                 PieceType{Piece::polygon, 2, msh_quadrangle},
                                 PieceType{Piece::tetrahedron, 3, msh_tetrahedron},
                                 PieceType{Piece::hexahedron, 3, msh_hexahedron}};
constexpr std::size_t max_msh_corners = 4;

class MshWriter {
 public:
  MshWriter(std::ostream& out, const MeshState& state, const Progress& progress)
      : text_(out), state_(state), pieces_(state.mesh, state.cuts, {.max_corners = max_msh_corners}, progress) {}

  void write_entities(const Progress& progress);
  void write_nodes(const Progress& progress);
  void write_elements(const Progress& progress);

 private:
  bool has_dimension(std::uint32_t dimension) const;
  /// Returns the dimension of the entity of the nodes: the highest dimension of all pieces, or 1 (a curve) if there are
  /// no pieces.
  std::uint32_t node_dimension() const;
  std::array<Point, 2> box(const Progress& progress) const;

  TextBlocks text_;
  const MeshState& state_;
  MeshPieces pieces_;
};

bool MshWriter::has_dimension(std::uint32_t dimension) const {
  return std::any_of(piece_types.begin(), piece_types.end(), [&](const PieceType& kind) {
    return kind.dimension == dimension && pieces_.count(kind.piece) > 0;
  });
}

std::uint32_t MshWriter::node_dimension() const { return has_dimension(3) ? 3 : has_dimension(2) ? 2 : 1; }

std::array<Point, 2> MshWriter::box(const Progress& progress) const {
  const auto& [mesh, cuts, positions, softness] = state_;
  std::array<Point, 2> box{Point::Zero(), Point::Zero()};
  for (ElementId element = 0; element < mesh.element_count(); ++element) {
    progress.report(element, mesh.element_count());
    const Point point = point_of(mesh, positions, element);
    box =
        element == 0 ? std::array{point, point} : std::array<Point, 2>{box[0].cwiseMin(point), box[1].cwiseMax(point)};
  }
  return box;
}

/// Writes one entity per dimension, with its bounding box, no physical group and no boundary.
void MshWriter::write_entities(const Progress& progress) {
  text_ << "$MeshFormat\n4.1 0 8\n$EndMeshFormat\n$Entities\n0";
  const std::uint32_t of_nodes = node_dimension();
  const auto is_there = [&](std::uint32_t dimension) { return dimension == of_nodes || has_dimension(dimension); };
  for (std::uint32_t dimension = 1; dimension <= 3; ++dimension) {
    text_ << ' ' << std::uint32_t{is_there(dimension) ? 1U : 0U};
  }
  text_ << '\n';
  const auto corners = box(progress);
  for (std::uint32_t dimension = 1; dimension <= 3; ++dimension) {
    if (is_there(dimension)) {
      text_ << '1';
      for (const Point& corner : corners) {
        text_ << ' ' << corner.x() << ' ' << corner.y() << ' ' << corner.z();
      }
      text_ << " 0 0\n";
    }
  }
  text_ << "$EndEntities\n";
}

void MshWriter::write_nodes(const Progress& progress) {
  const ElementId count = state_.mesh.element_count();
  text_ << "$Nodes\n1 " << count << " 1 " << count << '\n' << node_dimension() << " 1 0 " << count << '\n';
  for (ElementId element = 0; element < count; ++element) {
    text_ << element + 1 << '\n';
  }
  for (ElementId element = 0; element < count; ++element) {
    progress.report(element, count);
    const Point point = point_of(state_.mesh, state_.positions, element);
    text_ << point.x() << ' ' << point.y() << ' ' << point.z() << '\n';
  }
  text_ << "$EndNodes\n";
}

void MshWriter::write_elements(const Progress& progress) {
  std::uint32_t blocks = 0, count = 0;
  for (const PieceType& kind : piece_types) {
    blocks += pieces_.count(kind.piece) > 0 ? 1 : 0;
    count += pieces_.count(kind.piece);
  }
  text_ << "$Elements\n" << blocks << ' ' << count << ' ' << std::uint32_t{count > 0 ? 1U : 0U} << ' ' << count << '\n';
  std::uint32_t tag = 0;
  for (const PieceType& kind : piece_types) {
    if (pieces_.count(kind.piece) == 0) {
      continue;
    }
    text_ << kind.dimension << " 1 " << kind.type << ' ' << pieces_.count(kind.piece) << '\n';
    const auto write = [&](MeshPieces::Corners corners) {
      text_ << ++tag;
      for (const ElementId corner : corners) {
        text_ << ' ' << corner + 1;
      }
      text_ << '\n';
    };
    pieces_.for_each(kind.piece, write,
                     progress.part(double(tag) / count, double(tag + pieces_.count(kind.piece)) / count));
  }
  text_ << "$EndElements\n";
  text_.flush();
}

}  // namespace

void write_msh(std::ostream& out, const MeshState& state, const Progress& progress) {
  MshWriter writer(out, state, progress.part(0, 0.3));
  writer.write_entities(progress.part(0.3, 0.4));
  writer.write_nodes(progress.part(0.4, 0.7));
  writer.write_elements(progress.part(0.7, 1));
}

}  // namespace chainmail
