#pragma once

#include <QIcon>

namespace chainmail::tool_icons {

/// Drawn in the text's colour, sharp at any scale.
QIcon drag(const QPalette& palette);
QIcon cut(const QPalette& palette);
QIcon pin(const QPalette& palette);
QIcon select(const QPalette& palette);

}  // namespace chainmail::tool_icons
