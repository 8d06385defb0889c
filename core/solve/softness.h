#pragma once

#include <map>

#include "mesh/mesh.h"

namespace chainmail {

/// How far a link gives, relative to its rest vector: 0 <= compression <= 1 <= stretch, shear >= 0, finite.
struct LinkSoftness {
  double compression = 0.8;
  double stretch = 1.2;
  double shear = 0.1;

  bool operator==(const LinkSoftness&) const = default;
};

/// Throws Error, naming the parameter, where the softness is not one of the above.
void check(const LinkSoftness& softness);

/// The softness of an object: one for all links, and others for single links.
struct Softness {
  LinkSoftness global;
  std::map<LinkId, LinkSoftness> links;

  const LinkSoftness& of(LinkId link) const {
    if (links.empty()) {
      return global;
    }
    const auto found = links.find(link);
    return found == links.end() ? global : found->second;
  }

  bool operator==(const Softness&) const = default;
};

}  // namespace chainmail
