#include "command_line/report_origin.h"

#include <unistd.h>

#include <ctime>
#include <iostream>

namespace chainmail::command_line {
namespace {

std::string now_in_words() {
  const std::time_t now = std::time(nullptr);
  std::tm parts{};
  gmtime_r(&now, &parts);
  char text[32];
  std::strftime(text, sizeof text, "%Y-%m-%d %H:%M UTC", &parts);
  return text;
}

}  // namespace

report::Origin origin_of(const std::string& command_line) {
  return {report::this_machine(), command_line, now_in_words(), "chainmail " CHAINMAIL_VERSION};
}

ProgressLine::ProgressLine() : is_terminal_(isatty(STDERR_FILENO) != 0) {}

void ProgressLine::show(double fraction, const std::string& text) {
  const auto now = std::chrono::steady_clock::now();
  if (is_terminal_ && (now - last_ > std::chrono::milliseconds(200) || fraction == 1)) {
    std::cerr << "\r\x1b[K" << (fraction == 1 ? "" : std::to_string(int(100 * fraction)) + "% " + text) << std::flush;
    last_ = now;
  }
}

}  // namespace chainmail::command_line
