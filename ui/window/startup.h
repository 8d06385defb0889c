#pragma once

#include <QString>

namespace chainmail {

class MainWindow;

/// Sets what must be set before the application object exists: OpenGL, shared contexts, settings.
void prepareApplication();

/// From now on, the window keeps its unsaved work, with the last drag, when a signal ends the program or the display is
/// lost.
void keepWorkAtTheEnd(MainWindow& window);

/// Sets icon, style and palette. Call it after the application object is made.
void styleApplication();

/// Returns the reason why the workbench cannot draw on this platform; empty if it can.
QString whyNoWindow();

}  // namespace chainmail
