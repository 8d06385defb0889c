#pragma once

#include <QPalette>
#include <QString>

#include "common/colours.h"

namespace chainmail {

/// Returns the ground of the theme that the user chose; dark if none was chosen.
colours::Ground rememberedGround();
void remember(colours::Ground ground);

/// Returns the palette for a ground. The ground may differ from that of the window, for example in a picture.
QPalette paletteOn(colours::Ground ground);
/// Sets the palette of the whole application.
void applyGround(colours::Ground ground);

}  // namespace chainmail
