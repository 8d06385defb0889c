#pragma once

#include "common/colours.h"
#include "document/document.h"

namespace chainmail {

/// Returns the colour of an algorithm, from core's table, as far adapted to the ground as text needs. `copy` numbers
/// the panels that show the same algorithm; each has its own shade.
colours::Colour algorithmColour(Algorithm algorithm, int copy = 0);

/// Returns the colour of a panel and of everything that refers to it: that of its algorithm, in a shade that no earlier
/// panel has. It may change with the algorithm of any panel.
colours::Colour panelColour(const Document& document, int panel);

}  // namespace chainmail
