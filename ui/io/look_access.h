#pragma once

#include <QObject>
#include <functional>
#include <string>

namespace chainmail {

/// Reads and sets how the window shows its object: cameras, colours, docks. A session keeps it as JSON that only the
/// window interprets.
struct LookAccess {
  std::function<std::string()> read;
  /// Parts that the look lacks stay unchanged.
  std::function<void(const std::string& look)> set;
  /// Calls `changed` after a change of what `read` returns, as long as `context` lives.
  std::function<void(QObject& context, const std::function<void()>& changed)> follow;
};

}  // namespace chainmail
