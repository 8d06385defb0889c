#include "report/run/beam.h"

namespace chainmail::report {

/// With the shear force V, the moment is V (L/2 - x), because neither end turns. Young's modulus is 1: it cancels.
Point timoshenko(const Beam& beam, double deflection, const Point& rest) {
  const double l = beam.length, h = beam.height, nu = beam.poisson;
  const double bending = h * h * h * h / 12;                                     // E I
  const double shear = 10 * (1 + nu) / (12 + 11 * nu) * h * h / (2 * (1 + nu));  // κ G A
  const double force = deflection / (l * l * l / (12 * bending) + l / shear);
  const double x = rest.x() - beam.middle.x(), across = rest.z() - beam.middle.z();
  const double turn = force / bending * (l * x / 2 - x * x / 2);
  const double along_z = force * ((l * x * x / 4 - x * x * x / 6) / bending + x / shear);
  return {-across * turn, 0, along_z};
}

Point pure_bending(const Beam& sheet, double angle, const Point& rest) {
  const double curvature = angle / sheet.length;
  const double x = rest.x() - sheet.middle.x(), across = rest.y() - sheet.middle.y();
  return {-curvature * x * across, curvature * x * x / 2, 0};
}

}  // namespace chainmail::report
