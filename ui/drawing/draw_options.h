#pragma once

#include <optional>

#include "mesh/section_plane.h"

namespace chainmail {

/// The parts of an object that are drawn. The faces of a volume are its outer surface. If they are drawn, only the
/// links on that surface are drawn.
struct DrawOptions {
  bool faces = true, links = true;
  /// Hides everything that is in front of this plane at rest. The face of the section closes a volume there.
  std::optional<SectionPlane> section = {};

  bool operator==(const DrawOptions&) const = default;
};

}  // namespace chainmail
