#pragma once

#include <QPalette>
#include <QString>

#include "common/colours.h"

namespace chainmail {

/// The theme of the window: dark, light, or that of the system.
enum class Theme { system, dark, light };

/// Returns the theme that the user chose; Theme::system if none was chosen.
Theme rememberedTheme();
/// Returns the ground of that theme. For Theme::system: that of the system if known, else dark.
colours::Ground rememberedGround();
void remember(Theme theme);
/// Stores the ground that the system has now.
void rememberSystem(colours::Ground ground);

/// Returns the palette for a ground, which need not be that of the window; for example of a picture.
QPalette paletteOn(colours::Ground ground);
/// Sets the palette of the whole application.
void applyGround(colours::Ground ground);

}  // namespace chainmail
