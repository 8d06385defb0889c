#include "report/run/ramp_rule.h"

#include <utility>

namespace chainmail::report {
namespace {

constexpr double percentile_kept = 0.99;

}  // namespace

RampRow ramp_row(const Mesh& mesh, std::uint32_t width, Algorithm algorithm, const RampPasses& passes, double budget) {
  RampRow row{width, mesh.element_count(), mesh.link_count(), algorithm, static_cast<int>(passes.ms.size())};
  if (row.passes > 0) {
    row.median_ms = percentile(passes.ms, 0.5);
    row.p99_ms = percentile(passes.ms, percentile_kept);
    row.mean_moved = double(passes.moved) / row.passes;
    row.in_real_time = row.p99_ms <= 1000 * budget;
  }
  return row;
}

RampVerdict ramp_verdict(Algorithm algorithm, std::span<const RampRow> rows) {
  RampVerdict verdict;
  verdict.algorithm = algorithm;
  std::vector<SizedTime> medians;
  for (const RampRow& one : rows) {
    if (one.algorithm != algorithm) {
      continue;
    }
    medians.push_back({double(one.elements), one.median_ms});
    verdict.lost = !one.in_real_time;
    if (one.in_real_time) {
      verdict.largest_width = one.width;
    }
  }
  verdict.growth = growth_of(medians, growth_from);
  return verdict;
}

/// The seed's bits spread (Steele et al. 2014, SplitMix).
std::uint64_t ramp_seed(std::uint64_t seed, std::uint32_t width, int attempt) {
  std::uint64_t z = seed + 0x9e3779b97f4a7c15 * (2 * std::uint64_t{width} + static_cast<std::uint64_t>(attempt));
  z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9;
  z = (z ^ (z >> 27)) * 0x94d049bb133111eb;
  return z ^ (z >> 31);
}

}  // namespace chainmail::report
