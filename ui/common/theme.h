#pragma once

#include <QPalette>
#include <QString>

#include "common/colours.h"

namespace chainmail {

/// The theme of the window: dark, light, or the theme of the system.
enum class Theme { system, dark, light };

/// Returns the theme that the user chose; Theme::system if none was chosen.
Theme rememberedTheme();
/// Returns the ground of the remembered theme. For Theme::system: the ground of the system if known, else dark.
colours::Ground rememberedGround();
void remember(Theme theme);
/// Stores the current ground of the system.
void rememberSystem(colours::Ground ground);

/// Returns the palette for a ground. The ground may differ from that of the window, for example in a picture.
QPalette paletteOn(colours::Ground ground);
/// Sets the palette of the whole application.
void applyGround(colours::Ground ground);

}  // namespace chainmail
