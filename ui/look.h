#pragma once

namespace chainmail {

/// Which parts of an object are drawn. Of a volume the faces are its outer surface, and with them the links that lie on
/// it alone.
struct Look {
  bool faces = true, links = true;

  bool operator==(const Look&) const = default;
};

}  // namespace chainmail
