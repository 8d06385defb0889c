// Finds the softness with which a ChainMail bar comes closest to an elastic one, and drags the bar with it.
#include <chainmail/calibrate/calibrate.h>
#include <chainmail/chainmail.h>
#include <chainmail/measure/physical_error.h>

#include <iostream>

namespace cm = chainmail;

int main() {
  const cm::MeshPointer bar = cm::generate({cm::MeshKind::tetra, {7, 3, 3}});
  cm::CalibrationOptions options;
  options.elastic.material = {.young = 1, .poisson = 0.4};
  options.pins = cm::elements_at(*bar, "left");
  options.drags = 2;
  options.held_out = 2;
  options.evaluations = 30;  // few, so that this takes a second
  const cm::CalibrationResult found = cm::calibrate(bar, cm::Cuts(bar), options);
  std::cout << "compression " << found.softness.compression << ", stretch " << found.softness.stretch << ", shear "
            << found.softness.shear << ", at equilibrium\n"
            << "relative error " << found.held_out.before.relative << " before, " << found.held_out.after.relative
            << " after, on drags that the search did not see\n";

  cm::Deformer deformer(bar, options.algorithm);
  deformer.pin(options.pins);
  deformer.body().set_elastic(options.elastic);
  deformer.set_softness({.global = found.softness, .links = {}, .energy = options.energy});
  const cm::ElementId tip = cm::elements_at(*bar, "right").back();
  deformer.move(tip, bar->rest_position(tip) + cm::Point(0, 1, 0));
  deformer.relax(1000, {.scheme = options.scheme});
  const cm::ReferenceSolution reference = cm::reference_solution(deformer.body(), {tip});
  std::cout << "one drag: relative error "
            << cm::measure_physical_error(*bar, deformer.body().positions(), reference).relative << "\n";
  return found.held_out.after.relative < found.held_out.before.relative ? 0 : 1;
}
