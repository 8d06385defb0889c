#include <chainmail/chainmail.h>

#include <iostream>

namespace cm = chainmail::api;

// A program that uses the installed library. It pulls the corner of a 3x3 grid two mesh units to the left.
int main() {
  cm::Deformer deformer(cm::make_grid(3, 3), "natural-queue");
  const cm::MoveResult result = deformer.move(0, {-2, 0, 0});
  std::cout << "chainmail " << cm::version() << ": " << result.moved << " moved\n";
  return cm::violation(deformer.body()).max < 1e-12 ? 0 : 1;
}
