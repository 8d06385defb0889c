#include "solve/softness.h"

#include <cmath>

#include "mesh/error.h"

namespace chainmail {

void check(const LinkSoftness& softness) {
  if (!(softness.compression >= 0 && softness.compression <= 1)) {
    throw Error("compression", "it must lie between 0 and 1", "1 lets links shorten not at all, 0 to nothing");
  }
  if (!(softness.stretch >= 1 && std::isfinite(softness.stretch))) {
    throw Error("stretch", "it must be 1 or more and finite", "1 lets links lengthen not at all");
  }
  if (!(softness.shear >= 0 && std::isfinite(softness.shear))) {
    throw Error("shear", "it must be 0 or more and finite", "0 lets links turn not at all");
  }
}

}  // namespace chainmail
