#pragma once

#include <functional>
#include <string>

class QObject;

namespace chainmail {

class MainWindow;

/// How a window looks at its object, as a session keeps it: cameras, colours, docks. JSON that core does not look into.
std::string lookOf(MainWindow& window);

/// Takes a look up again; what is missing, or none, stays as it is.
void takeLook(MainWindow& window, const std::string& look);

/// Calls `changed` after something that lookOf returns has changed, as long as `context` lives.
void followLook(MainWindow& window, QObject& context, const std::function<void()>& changed);

}  // namespace chainmail
