#pragma once

#include <optional>

#include "mesh/section_plane.h"

namespace chainmail {

/// Which parts of an object are drawn. Of a volume the faces are its outer surface, and with them the links that lie on
/// it alone.
struct Look {
  bool faces = true, links = true;
  /// What lies in front of it at rest is not drawn; a volume is closed there by the section's face.
  std::optional<SectionPlane> section = {};

  bool operator==(const Look&) const = default;
};

}  // namespace chainmail
