#pragma once

#include <map>

#include "mesh/mesh.h"
#include "mesh/parameters.h"

namespace chainmail {

/// How far a link may shorten, lengthen and lean, relative to its rest vector. See mesh/parameters.h for the ranges.
struct LinkSoftness {
  double compression = parameters::compression.standard;
  double stretch = parameters::stretch.standard;
  double shear = parameters::shear.standard;

  bool operator==(const LinkSoftness&) const = default;
};

/// Throws Error, with the name of the parameter, if one of them is out of range.
void check(const LinkSoftness& softness);

/// The softness of an object: a global one, and different ones for single links.
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
