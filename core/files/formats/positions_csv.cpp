#include "files/formats/positions_csv.h"

#include "files/text/text.h"

namespace chainmail {

void write_positions_csv(std::ostream& out, const MeshState& state, const Progress& progress) {
  TextBlocks text(out);
  text << "id,x,y,z\n";
  const ElementId count = state.mesh.element_count();
  for (ElementId element = 0; element < count; ++element) {
    progress.report(element, count);
    text << element;
    for (const double coordinate : point_of(state.mesh, state.positions, element)) {
      text << ',' << coordinate;
    }
    text << '\n';
  }
  text.flush();
}

}  // namespace chainmail
