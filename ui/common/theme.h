#pragma once

#include <QPalette>
#include <QString>

#include "common/colours.h"

namespace chainmail {

/// How the window looks: dark, light, or as the system does.
enum class Theme { system, dark, light };

/// The user's choice; the system's look where none was made.
Theme rememberedTheme();
/// What that choice means now: the system's look where it is known, dark where it is not.
colours::Ground rememberedGround();
void remember(Theme theme);
/// What the system was last known to look like.
void rememberSystem(colours::Ground ground);

/// Of a ground that need not be the window's: a picture's, say.
QPalette paletteOn(colours::Ground ground);
/// Gives the whole application the palette for a ground, at once.
void applyGround(colours::Ground ground);

}  // namespace chainmail
