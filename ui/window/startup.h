#pragma once

#include <QString>

namespace chainmail {

/// To be called before the application object is made: sharp scaling and views that survive docking.
void prepareApplication();

/// After the application object is made: names, style and palette.
void styleApplication();

/// Says why the workbench cannot draw on this platform, or nothing where it can.
QString whyNoWindow();

}  // namespace chainmail
