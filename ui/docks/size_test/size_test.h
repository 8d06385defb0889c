#pragma once

#include <cstdint>
#include <numbers>
#include <ostream>
#include <span>
#include <vector>

#include "common/colours.h"
#include "report/run/ramp_rule.h"

namespace chainmail {

/// Dean 2004, chapter 6, live: square grids grow under a scripted hand until each panel has lost real time.
struct SizeTestOptions {
  std::uint32_t first = 16;             // elements along a side
  double growth = std::numbers::sqrt2;  // of a side, from size to size; 0: as `chainmail ramp`
  std::uint64_t largest = 1'000'000;    // elements
  double budget = 1.0 / 60;             // for a pass, in seconds
  int drags = 5;                        // at each size, beside one to warm up
  int moves = 30;                       // a drag
  std::uint64_t seed = 1;               // of the drags
  LinkSoftness softness;
};

/// The sizes there are, ascending.
std::vector<std::uint32_t> widthsOf(const SizeTestOptions& options);

/// A panel that takes part.
struct SizeTestContestant {
  int panel = 0;
  Algorithm algorithm = Algorithm::natural_queue;
  colours::Colour colour = colours::left;
};

/// How one panel did at one size.
struct SizeTestRow {
  int panel = 0;
  report::RampRow figures;
  int painted = 0;  // frames a second
};

/// What the rows of a panel say of it.
report::RampVerdict verdictOf(const SizeTestContestant& contestant, std::span<const SizeTestRow> rows);
/// With all digits, a row a size and panel.
void writeCsv(std::ostream& out, std::span<const SizeTestRow> rows);

}  // namespace chainmail
