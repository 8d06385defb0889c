#include "bench/results.h"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <stdexcept>

#include "report/machine.h"

namespace chainmail::bench {
namespace {

using nlohmann::json;

std::string machine() {
  const auto is = report::this_machine();
  return is.processor + ", " + std::to_string(is.cores) + " cores, " + is.compiler + ", " + is.build;
}

bool same(const json& one, const json& other) {
  return one["name"] == other["name"] && one["mesh"] == other["mesh"] && one["algorithm"] == other["algorithm"];
}

}  // namespace

Results::Results(std::string path) : path_(std::move(path)) {
  if (std::ifstream in(path_); in) {
    all_ = json::parse(in);
  }
  all_["machine"] = machine();
  all_.emplace("runs", json::array());
  all_.emplace("ratios", json::object());
}

void Results::add(const std::vector<Run>& runs) {
  for (const Run& one : runs) {
    const json entry{
        {"name", one.drag},   {"mesh", one.mesh}, {"algorithm", one.algorithm},        {"elements", one.elements},
        {"moved", one.moved}, {"ms", one.ms},     {"ns_per_moved", one.ns_per_moved()}};
    auto& all = all_["runs"];
    const auto found = std::find_if(all.begin(), all.end(), [&](const json& other) { return same(entry, other); });
    found == all.end() ? all.push_back(entry) : void(*found = entry);
  }
}

void Results::write() const {
  std::ofstream out(path_);
  out << all_.dump(1) << '\n';
  if (!out.flush()) {
    throw std::runtime_error(path_ + ": it could not be written");
  }
}

}  // namespace chainmail::bench
