#include "solve/softness.h"

namespace chainmail {

void check(const LinkSoftness& softness) {
  check(parameters::compression, softness.compression);
  check(parameters::stretch, softness.stretch);
  check(parameters::shear, softness.shear);
}

}  // namespace chainmail
