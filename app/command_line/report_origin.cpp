#include "command_line/report_origin.h"

#include "version/version.h"

namespace chainmail::command_line {

report::Origin origin_of(const std::string& command_line) {
  return {report::this_machine(), command_line, report::now_in_words(), version_in_words("chainmail")};
}

}  // namespace chainmail::command_line
