#include "command_line/report_origin.h"

namespace chainmail::command_line {

report::Origin origin_of(const std::string& command_line) {
  return {report::this_machine(), command_line, report::now_in_words(), "chainmail " CHAINMAIL_VERSION};
}

}  // namespace chainmail::command_line
