#include "files/formats/msh.h"

#include <algorithm>
#include <array>
#include <vector>

#include "files/formats/mesh_pieces.h"
#include "files/formats/msh_types.h"
#include "files/text/text.h"

namespace chainmail {
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
