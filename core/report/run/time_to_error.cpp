#include "report/run/time_to_error.h"

#include <algorithm>
#include <array>

#include "report/run/contest.h"

namespace chainmail::report {
namespace {

constexpr std::array sweeps_tried{0, 1, 3, 10, 30, 100, 300};

/// A contestant with all numbers of iterations that it may use.
struct Group {
  PhysicsContestant contestant;
  std::string label;
  std::size_t first = 0, count = 0;  // its entries of the contest
};

bool has_sweeps(const PhysicsContestant& one) { return one.calibrated && !one.equilibrium; }

/// Returns the variants of a contestant that run.
std::vector<PhysicsContestant> variants_of(const PhysicsContestant& contestant) {
  std::vector<PhysicsContestant> all;
  const auto add = [&](const auto& numbers, int PhysicsContestant::*member) {
    for (const int number : numbers) {
      all.push_back(contestant);
      all.back().*member = number;
    }
  };
  if (const auto limits = limits_of(contestant); !limits.empty()) {
    add(limits, &PhysicsContestant::limit);
  } else if (has_sweeps(contestant)) {
    add(sweeps_tried, &PhysicsContestant::sweeps);
  } else {
    all.push_back(contestant);
  }
  return all;
}

std::string label_of_group(PhysicsContestant contestant) {
  const bool sweeps = has_sweeps(contestant);
  contestant.sweeps = 0;
  return label(contestant) + (sweeps ? " with sweeps" : "");
}

void take_shorter(std::optional<double>& shortest, double ms) { shortest = std::min(shortest.value_or(ms), ms); }

/// Takes over the times of one variant in a drag.
void take(SuiteTime& time, const PhysicsMeasurement& measured, double ms,
          std::array<std::optional<double>, suite_errors.size()> SuiteTime::*times) {
  for (std::size_t i = 0; i < suite_errors.size(); ++i) {
    if (measured.error.relative <= suite_errors[i]) {
      take_shorter((time.*times)[i], ms);
    }
  }
}

SuiteTime time_of(const Group& group, const std::vector<PhysicsEntry>& drag, const std::vector<PhysicsEntry>& fresh) {
  SuiteTime time{group.label, name(group.contestant), {}, {}, {}};
  for (std::size_t i = group.first; i < group.first + group.count; ++i) {
    if (const auto& measured = drag[i].measurement) {
      take_shorter(time.least_error, measured->error.relative);
      take(time, *measured, measured->ms_per_move.median, &SuiteTime::ms_per_move);
      if (measured->prepare.factorize.count > 0) {
        time.factorize_ms = measured->prepare.factorize.median;
      }
    }
    if (const auto& measured = fresh[i].measurement) {
      take(time, *measured, measured->first_move.median + measured->prepare.grab.median, &SuiteTime::fresh_ms);
    }
  }
  if (!time.least_error) {
    time.refusal = drag[group.first].refusal;
  }
  return time;
}

}  // namespace

std::vector<SuiteTime> times_to_error(const Case& object, const std::vector<PhysicsContestant>& contestants,
                                      const RecordedMoves& drag, const RecordedMoves& one_move,
                                      const ReferenceSolution& reference, const CompareOptions& options,
                                      const std::function<void(double)>& tell, const std::stop_token& stop) {
  std::vector<Group> groups;
  std::vector<PhysicsContestant> variants;
  for (const PhysicsContestant& contestant : contestants) {
    if (contestant.algorithm) {
      const auto some = variants_of(contestant);
      groups.push_back({contestant, label_of_group(contestant), variants.size(), some.size()});
      variants.insert(variants.end(), some.begin(), some.end());
    }
  }
  Contest contest(object, variants, options);
  tell(0.1);
  const auto along = contest.run(
      drag, reference, [&](double share) { tell(0.1 + 0.6 * share); }, stop);
  const auto fresh = contest.run(
      one_move, reference, [&](double share) { tell(0.7 + 0.3 * share); }, stop);
  std::vector<SuiteTime> times(groups.size());
  std::ranges::transform(groups, times.begin(), [&](const Group& group) { return time_of(group, along, fresh); });
  return times;
}

}  // namespace chainmail::report
