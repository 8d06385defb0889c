#pragma once

#include <functional>
#include <string>

class QObject;

namespace chainmail {

class MainWindow;

/// Returns how the window shows its object, as JSON for a session: cameras, colours, section, docks.
std::string lookOf(MainWindow& window);

/// Restores a look. Parts that the JSON lacks stay unchanged.
void takeLook(MainWindow& window, const std::string& look);

/// Calls `changed` whenever the result of lookOf() changes, while `context` exists.
void followLook(MainWindow& window, QObject& context, const std::function<void()>& changed);

}  // namespace chainmail
