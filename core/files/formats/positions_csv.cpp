#include "files/formats/positions_csv.h"

#include "files/text/text.h"

namespace chainmail {

void write_positions_csv(std::ostream& out, const Mesh& mesh, const PositionView& positions, const Progress& progress) {
  TextBlocks text(out);
  text << "id,x,y,z\n";
  for (ElementId element = 0; element < mesh.element_count(); ++element) {
    progress.report(element, mesh.element_count());
    text << element;
    for (const double coordinate : point_of(mesh, positions, element)) {
      text << ',' << coordinate;
    }
    text << '\n';
  }
  text.flush();
}

}  // namespace chainmail
