#include "command_line/report_origin.h"

#include <ctime>

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

}  // namespace chainmail::command_line
