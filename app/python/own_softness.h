#pragma once

#include <utility>
#include <vector>

#include "body/softness.h"

namespace chainmail::python {

/// Returns the softness of single links. Puts links with equal softness one after the other, so that they form groups.
OwnSoftness grouped(std::vector<std::pair<LinkId, LinkSoftness>> entries);

}  // namespace chainmail::python
