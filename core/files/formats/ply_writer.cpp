#include "files/formats/mesh_pieces.h"
#include "files/formats/ply.h"
#include "files/text/text.h"

namespace chainmail {
namespace {

/// Readers expect a byte for the number of a face's corners; it takes more where one has more.
bool fits_a_byte(const Mesh& mesh) {
  for (std::size_t i = 0; i < mesh.polygons.size(); i += mesh.polygons[i] + 1) {
    if (mesh.polygons[i] > 255) {
      return false;
    }
  }
  return true;
}

/// The element `edge` stands there only with edges: not all readers know it.
void write_header(TextBlocks& text, const Mesh& mesh, const MeshPieces& pieces) {
  text << "ply\nformat ascii 1.0\ncomment positions in mesh units; an edge is a link along no face\nelement vertex "
       << mesh.element_count() << "\nproperty double x\nproperty double y\nproperty double z\nelement face "
       << pieces.count(Piece::triangle) + pieces.count(Piece::polygon) << "\nproperty list "
       << (fits_a_byte(mesh) ? "uchar" : "uint") << " int vertex_indices\n";
  if (pieces.count(Piece::line) > 0) {
    text << "element edge " << pieces.count(Piece::line) << "\nproperty int vertex1\nproperty int vertex2\n";
  }
  text << "end_header\n";
}

void write_vertices(TextBlocks& text, const MeshState& state, const Progress& progress) {
  for (ElementId element = 0; element < state.mesh.element_count(); ++element) {
    progress.report(element, state.mesh.element_count());
    const Point point = point_of(state.mesh, state.positions, element);
    text << point.x() << ' ' << point.y() << ' ' << point.z() << '\n';
  }
}

void write_faces(TextBlocks& text, const MeshPieces& pieces, Piece piece, const Progress& progress) {
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

void write_ply(std::ostream& out, const MeshState& state, const Progress& progress) {
  const MeshPieces pieces(state.mesh, state.cuts, {.cells = false}, progress.part(0, 0.3));
  TextBlocks text(out);
  write_header(text, state.mesh, pieces);
  write_vertices(text, state, progress.part(0.3, 0.6));
  write_faces(text, pieces, Piece::triangle, progress.part(0.6, 0.7));
  write_faces(text, pieces, Piece::polygon, progress.part(0.7, 0.8));
  pieces.for_each(
      Piece::line, [&](MeshPieces::Corners ends) { text << ends[0] << ' ' << ends[1] << '\n'; }, progress.part(0.8, 1));
  text.flush();
}

}  // namespace chainmail
