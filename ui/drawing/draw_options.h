#pragma once

#include <optional>

#include "mesh/section_plane.h"

namespace chainmail {

/// The parts of an object that are drawn. The faces of a volume are its outer surface. If they are drawn, only the
/// links on that surface are drawn.
struct DrawOptions {
  bool faces = true, links = true;
  /// True if surfaces in space are shaded like a lit sphere of clay, whatever the light: forms show better.
  bool matcap = false;
  /// Hides everything that is in front of this plane at rest. The face of the section closes a volume there.
  std::optional<SectionPlane> section = {};

  bool operator==(const DrawOptions&) const = default;
};

}  // namespace chainmail
