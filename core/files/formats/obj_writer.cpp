#include "files/formats/mesh_pieces.h"
#include "files/formats/obj.h"
#include "files/formats/space.h"
#include "files/text/text.h"

namespace chainmail {
namespace {

void write_vertices(TextBlocks& text, const Mesh& mesh, const PositionView& positions, const Progress& progress) {
  for (ElementId element = 0; element < mesh.element_count(); ++element) {
    progress.report(element, mesh.element_count());
    text << 'v';
    for (const double coordinate : point_of(mesh, positions, element)) {
      text << ' ' << coordinate;
    }
    text << '\n';
  }
}

}  // namespace

void write_obj(std::ostream& out, const Mesh& mesh, const Cuts& cuts, const PositionView& positions,
               const Progress& progress) {
  const MeshPieces pieces(mesh, cuts, {.cells = false}, progress.part(0, 0.3));
  TextBlocks text(out);
  text << space_comment(mesh, positions);
  write_vertices(text, mesh, positions, progress.part(0.3, 0.6));
  const auto write = [&](Piece piece, char kind, const Progress& part) {
    pieces.for_each(
        piece,
        [&](MeshPieces::Corners corners) {
          text << kind;
          for (const ElementId corner : corners) {
            text << ' ' << corner + 1;
          }
          text << '\n';
        },
        part);
  };
  write(Piece::triangle, 'f', progress.part(0.6, 0.7));
  write(Piece::polygon, 'f', progress.part(0.7, 0.8));
  write(Piece::line, 'l', progress.part(0.8, 1));
  text.flush();
}

}  // namespace chainmail
