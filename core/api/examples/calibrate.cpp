// Finds the softness with which a ChainMail bar comes closest to an elastic one, and drags the bar with it.
#include <chainmail/chainmail.h>

#include <iostream>

namespace cm = chainmail::api;

int main() {
  const cm::Mesh bar = cm::make_tetra(7, 3, 3);
  cm::Body body(bar);
  body.pin(bar.side("left"));
  body.set_elasticity({.young = 1, .poisson = 0.4});

  cm::CalibrateOptions options;
  options.drags = 2;
  options.held_out = 2;
  options.evaluations = 30;  // few, so that this takes a second
  const cm::Calibration found = cm::calibrate(body, options);
  std::cout << "compression " << found.softness.compression << ", stretch " << found.softness.stretch << ", shear "
            << found.softness.shear << ", at equilibrium\n"
            << "relative error " << found.held_out.before.relative << " before, " << found.held_out.after.relative
            << " after, on drags that the search did not see\n";

  body.set_softness(found.softness);
  body.set_energy(cm::EnergyKind::corotated);  // which was calibrated
  cm::Deformer deformer(body, options.method);
  const cm::ElementId tip = bar.side("right").back();
  deformer.move(tip, bar.rest_position(tip) + cm::Vector3{0, 1, 0});
  deformer.relax(1000, {.scheme = options.scheme});
  const auto reference = cm::reference_solution(deformer.body(), {tip});
  std::cout << "one drag: relative error " << cm::physical_error(deformer.body(), reference).relative << "\n";
  return found.held_out.after.relative < found.held_out.before.relative ? 0 : 1;
}
