#pragma once

#include <functional>
#include <string>

class QObject;

namespace chainmail {

class MainWindow;

/// Returns how the window shows its object, as JSON for a session: cameras, colours, section, docks.
std::string layoutOf(MainWindow& window);

/// Restores a layout. Parts that the JSON lacks stay unchanged.
void applyLayout(MainWindow& window, const std::string& layout);

/// Calls `changed` whenever the result of layoutOf() changes, while `context` exists.
void followLayout(MainWindow& window, QObject& context, const std::function<void()>& changed);

}  // namespace chainmail
