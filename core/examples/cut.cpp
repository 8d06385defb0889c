// Cuts a sheet in two while dragging it: the part without the handle stays behind.
#include <chainmail/chainmail.h>

#include <iostream>

namespace cm = chainmail;

int main() {
  const cm::MeshPointer sheet = cm::generate({cm::MeshKind::grid, {20, 10, 1}});
  cm::Deformer deformer(sheet, cm::Algorithm::natural_queue);

  for (int step = 1; step <= 40; ++step) {
    const cm::PassCount pass = deformer.move(0, {-0.5 * step, 0, 0});
    if (step == 20) {
      std::cout << "before the cut, " << pass.moved << " elements follow\n";
      // Nothing is prepared again: the next move goes around the cut.
      std::vector<cm::LinkId> links;
      for (cm::ElementId row = 0; row < 10; ++row) {
        links.push_back(*cm::find_link(*sheet, 20 * row + 9, 20 * row + 10));
      }
      deformer.cut(links);
    }
    if (step == 40) {
      std::cout << "after the cut, " << pass.moved << " elements follow\n";
    }
  }

  const cm::PositionView at = deformer.body().positions();  // at(element, axis)
  std::cout << "the gap is " << at(10, 0) - at(9, 0) << " wide\n";
  return 0;
}
