#pragma once

#include <QIcon>
#include <QStringList>

namespace chainmail {

/// Returns an icon of the window. Icons are drawn each time they are painted, so they are sharp at any scale and have
/// the colours of the current palette. The names and drawings are in icons.cpp. An unknown name gives a null icon.
QIcon icon(const char* name);
/// The same in a fixed colour.
QIcon icon(const char* name, const QColor& colour);

/// Returns all names, in the order of the drawings.
QStringList iconNames();

}  // namespace chainmail
