#pragma once

#include <QString>

namespace chainmail {

/// Sets attributes that must be set before the application object is made: OpenGL, shared contexts, settings.
void prepareApplication();

/// Sets icon, style and palette after the application object is made.
void styleApplication();

/// Returns why the workbench cannot draw on this platform; empty if it can.
QString whyNoWindow();

}  // namespace chainmail
