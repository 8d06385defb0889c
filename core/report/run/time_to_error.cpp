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
    // The same for all contestants: with more, each takes longer than methods that are closer.
    const auto end = std::ranges::upper_bound(limits, equilibrium_iterations);
    add(std::span(limits.begin(), end), &PhysicsContestant::limit);
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

// The time of each of `suite_point_figures`.
constexpr std::array times_of{
    +[](const PhysicsMeasurement& measured) { return measured.ms_per_move.median; },
    +[](const PhysicsMeasurement& measured) { return measured.first_move.median + measured.prepare.grab.median; },
    +[](const PhysicsMeasurement& measured) { return measured.move_after_cut.median; }};
static_assert(times_of.size() == suite_point_figures.size());

/// What all variants did in each drag.
using Entries = std::vector<std::vector<PhysicsEntry>>;

SuitePoint point_of(const Entries& drags, std::size_t variant) {
  const PhysicsContestant& contestant = drags.front()[variant].contestant;
  SuitePoint point{.iterations = std::uint64_t(contestant.limit > 0 ? contestant.limit : contestant.sweeps)};
  for (std::size_t i = 0; i < drags.size(); ++i) {
    if (const auto& measured = drags[i][variant].measurement) {
      point.*suite_point_figures[i].error = measured->error.relative;
      point.*suite_point_figures[i].ms = times_of[i](*measured);
    }
  }
  return point;
}

SuiteTime time_of(const Group& group, const Entries& drags) {
  SuiteTime time{group.label, name(group.contestant), {}, {}, {}};
  for (std::size_t i = group.first; i < group.first + group.count; ++i) {
    time.curve.push_back(point_of(drags, i));
    if (const auto& measured = drags.front()[i].measurement; measured && measured->prepare.factorize.count > 0) {
      time.factorize_ms = measured->prepare.factorize.median;
    }
  }
  if (!least_error(time)) {
    time.refusal = drags.front()[group.first].refusal;
  }
  return time;
}

}  // namespace

std::vector<SuiteTime> times_to_error(const Case& object, const std::vector<PhysicsContestant>& contestants,
                                      std::span<const TimedDrag> drags, const CompareOptions& options,
                                      const Progress& progress) {
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
  Entries entries;
  for (const TimedDrag& drag : drags) {
    const auto done = double(entries.size()), all = double(drags.size());
    entries.push_back(contest.run(drag.moves, drag.reference, progress.part(done / all, (done + 1) / all)));
  }
  std::vector<SuiteTime> times(groups.size());
  std::ranges::transform(groups, times.begin(), [&](const Group& group) { return time_of(group, entries); });
  return times;
}

}  // namespace chainmail::report
