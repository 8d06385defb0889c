#pragma once

#include <QString>
#include <cstdint>
#include <numbers>
#include <ostream>
#include <span>
#include <vector>

#include "common/colours.h"
#include "report/page/plot.h"
#include "report/run/ramp_rule.h"

namespace chainmail {

/// Options of the ramp of core/report/run/ramp.h in the window (Dean 2004, chapter 6): square grids grow and are
/// dragged by a script until no panel is in real time.
struct SizeTestOptions {
  std::uint32_t first = 16;             // elements along a side
  double growth = std::numbers::sqrt2;  // factor of a side from size to size; 0: as in `chainmail ramp`
  std::uint64_t largest = 1'000'000;    // elements
  double budget = 1.0 / 60;             // limit of real time per pass, in seconds
  int drags = 5;                        // measured drags per size, after one warm-up drag
  int moves = 30;                       // per drag
  std::uint64_t seed = 1;               // of the drags
  Softness softness;                    // of all links, and the kind of energy
};

/// Returns a size as "16×16".
QString sizeText(std::uint32_t width);
/// Returns the sizes, ascending.
std::vector<std::uint32_t> widthsOf(const SizeTestOptions& options);

/// A panel that takes part in the test.
struct SizeTestContestant {
  int panel = 0;
  Algorithm algorithm = Algorithm::natural_queue;
  colours::Colour colour = colours::marked;
};

/// The figures of one panel at one size.
struct SizeTestRow {
  int panel = 0;
  report::RampRow figures;
  int painted = 0;  // frames per second
};

/// Returns the verdict on a panel, from its rows.
report::RampVerdict verdictOf(const SizeTestContestant& contestant, std::span<const SizeTestRow> rows);
/// Returns a plot of the 99th percentile of the pass times over the number of elements, with one line for each panel.
/// `budget` is in seconds.
report::Plot plotOf(const std::vector<SizeTestContestant>& contestants, std::span<const SizeTestRow> rows,
                    double budget);
/// Writes one CSV row for each size and panel, with all digits.
void writeCsv(std::ostream& out, std::span<const SizeTestRow> rows);

}  // namespace chainmail
