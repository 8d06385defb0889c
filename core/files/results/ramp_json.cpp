#include "files/results/ramp_json.h"

#include <nlohmann/json.hpp>

namespace chainmail {
namespace {

using Json = nlohmann::ordered_json;
using namespace report;

Json to_json(const RampVerdict& verdict) {
  Json json{{"algorithm", info(verdict.algorithm).name}, {"largest_width", nullptr}, {"lost", verdict.lost}};
  if (verdict.largest_width) {
    json["largest_width"] = *verdict.largest_width;
  }
  json["growth"] = nullptr;
  if (const auto& growth = verdict.growth) {
    json["growth"] = {
        {"exponent", growth->exponent}, {"from", growth->from}, {"to", growth->to}, {"sizes", growth->sizes}};
  }
  return json;
}

Json to_json(const RampRow& row) {
  return {{"width", row.width},       {"elements", row.elements},
          {"links", row.links},       {"algorithm", info(row.algorithm).name},
          {"passes", row.passes},     {"median_ms", row.median_ms},
          {"p99_ms", row.p99_ms},     {"mean_moved", row.mean_moved},
          {"repeated", row.repeated}, {"real_time", row.in_real_time}};
}

template <class Values>
Json all_of(const Values& values) {
  Json json = Json::array();
  for (const auto& value : values) {
    json.push_back(to_json(value));
  }
  return json;
}

}  // namespace

void write_json(std::ostream& out, const Ramp& ramp, const Machine& machine) {
  const RampOptions& options = ramp.options;
  const auto& [compression, stretch, shear] = options.softness;
  const Json json{{"machine",
                   {{"processor", machine.processor},
                    {"cores", machine.cores},
                    {"compiler", machine.compiler},
                    {"build", machine.build}}},
                  {"seed", options.seed},
                  {"budget", options.budget},
                  {"precision", options.precision == Precision::single_precision ? "float" : "double"},
                  {"softness", {{"compression", compression}, {"stretch", stretch}, {"shear", shear}}},
                  {"drags", options.drags},
                  {"moves", options.moves},
                  {"largest", options.largest},
                  {"seconds", ramp.seconds},
                  {"stopped", ramp.stopped},
                  {"algorithms", all_of(ramp.verdicts)},
                  {"sizes", all_of(ramp.rows)}};
  out << json.dump(2, ' ', false, Json::error_handler_t::replace) << '\n';
}

}  // namespace chainmail
