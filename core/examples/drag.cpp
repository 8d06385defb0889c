// Loads a mesh, pins its bottom, and drags its top to the side, as one rigid body.
//   drag MESH [OUTPUT]
#include <chainmail/chainmail.h>

#include <iostream>

namespace cm = chainmail;

int main(int argc, char** argv) {
  if (argc < 2) {
    std::cerr << "use: drag MESH [OUTPUT]\n";
    return 2;
  }
  try {
    const cm::MeshPointer mesh = cm::read_mesh(argv[1]);
    std::cout << mesh->element_count() << " elements, " << mesh->link_count() << " links\n";

    cm::Deformer deformer(mesh, cm::Algorithm::exact);
    deformer.pin(cm::elements_at(*mesh, "bottom"));
    cm::Handle handle(deformer.body(), cm::elements_at(*mesh, "top"));

    // Ten moves, as a mouse would make them. Each one is a pass.
    for (int step = 1; step <= 10; ++step) {
      const cm::Point by(0.1 * step, 0.05 * step, 0);
      const cm::PassCount pass = deformer.move(handle, {handle.grabbed().pivot + by});
      std::cout << "move " << step << ": " << pass.moved << " elements followed" << (pass.stopped ? ", taut" : "")
                << "\n";
    }

    const cm::Body& body = deformer.body();
    const cm::Violation violation = cm::measure_violation(body);
    std::cout << "largest violation " << violation.max << " of rest length\n";
    if (argc > 2) {
      cm::save_mesh(argv[2], {*mesh, body.cuts(), body.positions(), body.softness()});
    }
    return violation.fraction == 0 ? 0 : 1;
  } catch (const cm::Error& error) {
    std::cerr << error.what() << "\n";
    return 1;
  }
}
