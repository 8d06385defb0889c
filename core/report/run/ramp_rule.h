#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "mesh/mesh.h"
#include "report/run/ramp.h"

namespace chainmail::report {

/// The passes of one algorithm at one size.
struct RampPasses {
  std::vector<double> ms;
  std::uint64_t moved = 0;  // elements, in all of them together
};

/// The figures of a size, and whether it is in real time: whether the slowest hundredth of the passes (their 99th
/// percentile) keeps within the budget (seconds). Nothing measured is in real time.
RampRow ramp_row(const Mesh& mesh, std::uint32_t width, Algorithm algorithm, const RampPasses& passes, double budget);

/// What the rows of an algorithm, size by size, say of it; those of others are passed over.
RampVerdict ramp_verdict(Algorithm algorithm, std::span<const RampRow> rows);

/// Of the drags at a size: others for each size, and for each of the two attempts there are.
std::uint64_t ramp_seed(std::uint64_t seed, std::uint32_t width, int attempt);

}  // namespace chainmail::report
