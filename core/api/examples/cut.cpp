// Cuts a sheet in two while dragging it: the part without the handle stays behind.
#include <chainmail/chainmail.h>

#include <iostream>

namespace cm = chainmail::api;

int main() {
  const cm::Mesh sheet = cm::make_grid(20, 10);
  cm::Deformer deformer(sheet, "natural-queue");
  cm::Handle handle = deformer.grab({0});

  for (int step = 1; step <= 40; ++step) {
    const cm::MoveResult result = deformer.move(handle, handle.after({{-0.5 * step, 0, 0}, {}}));
    if (step == 20) {
      std::cout << "before the cut, " << result.moved << " elements follow\n";
      // Nothing is prepared again: the next move goes around the cut.
      for (cm::ElementId row = 0; row < 10; ++row) {
        deformer.body().cut(20 * row + 9, 20 * row + 10);
      }
    }
    if (step == 40) {
      std::cout << "after the cut, " << result.moved << " elements follow\n";
    }
  }

  const cm::Vector3 left = deformer.body().position(9), right = deformer.body().position(10);
  std::cout << "the gap is " << right.x - left.x << " wide\n";
  return 0;
}
