// Loads a mesh, pins its bottom, and drags its top to the side, as one rigid body.
//   drag MESH [OUTPUT]
#include <chainmail/chainmail.h>

#include <iostream>

namespace cm = chainmail::api;

int main(int argc, char** argv) {
  if (argc < 2) {
    std::cerr << "use: drag MESH [OUTPUT]\n";
    return 2;
  }
  try {
    const cm::Mesh mesh = cm::read_mesh(argv[1]);
    std::cout << mesh.element_count() << " elements, " << mesh.link_count() << " links\n";

    cm::Deformer deformer(mesh, "exact");
    deformer.body().pin(mesh.side("bottom"));
    cm::Handle handle = deformer.grab(mesh.side("top"));

    // Ten moves, as a mouse would make them. Each one is a pass.
    for (int step = 1; step <= 10; ++step) {
      const cm::MoveResult result = deformer.move(handle, handle.after({{0.1 * step, 0.05 * step, 0}, {}}));
      std::cout << "move " << step << ": " << result.moved << " elements followed" << (result.stopped ? ", taut" : "")
                << "\n";
    }

    const cm::Violation violation = cm::violation(deformer.body());
    std::cout << "largest violation " << violation.max << " of rest length\n";
    if (argc > 2) {
      cm::write_mesh(argv[2], deformer.body());
    }
    return violation.fraction == 0 ? 0 : 1;
  } catch (const cm::Error& error) {
    std::cerr << error.what() << "\n";
    return 1;
  }
}
