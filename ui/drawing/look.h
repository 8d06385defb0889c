#pragma once

#include <optional>

#include "mesh/section_plane.h"

namespace chainmail {

/// Which parts of an object are drawn. The faces of a volume are its outer surface; if they are drawn, only the links
/// on that surface are.
struct Look {
  bool faces = true, links = true;
  /// Everything that is in front of this plane at rest is hidden. The face of the section closes a volume there.
  std::optional<SectionPlane> section = {};

  bool operator==(const Look&) const = default;
};

}  // namespace chainmail
