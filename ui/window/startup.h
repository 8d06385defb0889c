#pragma once

#include <QString>

namespace chainmail {

/// Sets what must be set before the application object exists: OpenGL, shared contexts, settings.
void prepareApplication();

/// Sets icon, style and palette. Call it after the application object is made.
void styleApplication();

/// Returns the reason why there is too little memory for the window; empty if there is enough. Call it before the
/// application object is made: graphics drivers crash without memory.
QString whyNoMemory();

/// Returns the reason why the workbench cannot draw on this platform; empty if it can.
QString whyNoWindow();

}  // namespace chainmail
