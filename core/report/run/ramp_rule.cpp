#include "report/run/ramp_rule.h"

#include <algorithm>
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

/// Spreads the bits of the seed (Steele et al. 2014, SplitMix).
std::uint64_t ramp_seed(std::uint64_t seed, std::uint32_t width, int attempt) {
  std::uint64_t z = seed + 0x9e3779b97f4a7c15 * (2 * std::uint64_t{width} + static_cast<std::uint64_t>(attempt));
  z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9;
  z = (z ^ (z >> 27)) * 0x94d049bb133111eb;
  return z ^ (z >> 31);
}

RampRace::RampRace(std::vector<std::uint32_t> widths, std::vector<Algorithm> contestants, double budget)
    : widths_(std::move(widths)), algorithms_(std::move(contestants)), budget_(budget) {
  for (std::size_t i = 0; i < algorithms_.size(); ++i) {
    in_race_.push_back(i);
  }
  attempting_ = in_race_;
}

std::vector<RampRace::Result> RampRace::finish_attempt(const Mesh& mesh, std::span<const RampPasses> passes) {
  std::vector<std::size_t> missed;
  for (std::size_t i = 0; i < attempting_.size(); ++i) {
    const std::size_t contestant = attempting_[i];
    RampRow row = ramp_row(mesh, width(), algorithms_[contestant], passes[i], budget_);
    row.repeated = attempt_ > 0;
    if (attempt_ == 0 && !row.in_real_time) {
      missed.push_back(contestant);
    } else {
      results_.push_back({contestant, row});
    }
  }
  if (!missed.empty()) {
    attempt_ = 1;
    attempting_ = std::move(missed);
    return {};
  }
  std::ranges::sort(results_, {}, &Result::contestant);
  for (const Result& result : results_) {
    if (!result.row.in_real_time) {
      std::erase(in_race_, result.contestant);
    }
  }
  ++size_;
  attempt_ = 0;
  attempting_ = in_race_;
  return std::exchange(results_, {});
}

}  // namespace chainmail::report
