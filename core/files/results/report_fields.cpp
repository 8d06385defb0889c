#include "files/results/report_fields.h"

namespace chainmail {

using Json = nlohmann::ordered_json;
using namespace report;

Json to_json(const TimeSpread& ms) {
  return {{"median", ms.median},
          {"lower_quartile", ms.lower_quartile},
          {"upper_quartile", ms.upper_quartile},
          {"min", ms.min},
          {"max", ms.max},
          {"repetitions", ms.count}};
}

Json to_json(const CompareOptions& options) {
  return {{"relaxation", options.scheme == RelaxationScheme::mean ? "mean" : "link"},
          {"relax_step", options.relax_step},
          {"precision", options.precision == Precision::single_precision ? "float" : "double"}};
}

Json to_json(const Origin& origin) {
  const Machine& machine = origin.machine;
  return {{"date", origin.date},
          {"version", origin.version},
          {"command_line", origin.command_line},
          {"processor", machine.processor},
          {"cores", machine.cores},
          {"compiler", machine.compiler},
          {"build", machine.build}};
}

void write_report(std::ostream& out, const Json& json) {
  out << json.dump(2, ' ', false, Json::error_handler_t::replace) << '\n';
}

}  // namespace chainmail
