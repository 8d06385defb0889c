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

/// Calls `changed` after a change of what lookOf returns, as long as `context` lives.
void followLook(MainWindow& window, QObject& context, const std::function<void()>& changed);

}  // namespace chainmail
