#include "bench/results.h"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <stdexcept>

#include "report/table/machine.h"

namespace chainmail::bench {
namespace {

using nlohmann::json;

std::string machine() {
  const auto is = report::this_machine();
  return is.processor + ", " + std::to_string(is.cores) + " cores, " + is.compiler + ", " + is.build;
}

}  // namespace

Results::Results(std::string path) : path_(std::move(path)) {
  if (std::ifstream in(path_); in) {
    all_ = json::parse(in);
  }
  all_["machine"] = machine();
  all_.emplace("runs", json::array());
  for (const char* part : {"ratios", "quartiles", "samples"}) {
    all_.emplace(part, json::object());
  }
}

TimeSpread Results::sample(const std::string& key, double value) {
  json& samples = all_["samples"][key];
  samples.push_back(value);
  return spread_of(samples.get<std::vector<double>>());
}

void Results::add(const std::vector<Run>& runs) {
  for (const Run& one : runs) {
    json& all = all_["runs"];
    const auto is_same = [&](const json& other) {
      return other["name"] == one.drag && other["mesh"] == one.mesh && other["algorithm"] == one.algorithm;
    };
    const TimeSpread ms = sample(one.drag + " " + one.mesh + " " + one.algorithm, one.ms);
    const json entry{{"name", one.drag},
                     {"mesh", one.mesh},
                     {"algorithm", one.algorithm},
                     {"elements", one.elements},
                     {"moved", one.moved},
                     {"ms", ms.median},
                     {"ms_quartiles", {ms.lower_quartile, ms.upper_quartile}},
                     {"ns_per_moved", one.moved > 0 ? 1e6 * ms.median / one.moved : 0}};
    const auto found = std::find_if(all.begin(), all.end(), is_same);
    found == all.end() ? all.push_back(entry) : void(*found = entry);
  }
}

void Results::add(const std::string& place, double value) {
  const TimeSpread spread = sample(place, value);
  all_["ratios"][json::json_pointer(place)] = spread.median;
  all_["quartiles"][place] = {spread.lower_quartile, spread.upper_quartile};
}

void Results::write() const {
  std::ofstream out(path_);
  out << all_.dump(1) << '\n';
  if (!out.flush()) {
    throw std::runtime_error(path_ + ": it could not be written");
  }
}

}  // namespace chainmail::bench
