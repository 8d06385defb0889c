#pragma once

#include <QIcon>
#include <QStringList>

namespace chainmail {

/// The window's icons: drawn when they are painted, so that they are sharp at any scale and always in the colours of
/// the palette. The names and drawings stand in icon_drawings.cpp; an unknown name gives no icon.
QIcon icon(const char* name);
/// One that is drawn in a colour of its own.
QIcon icon(const char* name, const QColor& colour);

/// All names, in the order of the drawings.
QStringList iconNames();

}  // namespace chainmail
