#include "equilibrium/shared_loop.h"

#include <algorithm>

namespace chainmail {
namespace {

constexpr std::size_t block = 4096;

/// Calls work(number, first, last) for all blocks of this size.
template <class NumberedWork>
void for_each_block(const SharedLoop& loop, std::size_t count, std::size_t size, NumberedWork work) {
  const std::size_t blocks = (count + size - 1) / size, parts = std::min(blocks, ThreadTeam::max_parts);
  loop.each(parts, [&](std::size_t part) {
    for (std::size_t number = part; number < blocks; number += parts) {
      work(number, number * size, std::min(count, (number + 1) * size));
    }
  });
}

}  // namespace

void SharedLoop::each(std::size_t count, FunctionRef<void(std::size_t)> work) const {
  if (team_ != nullptr && count > 1) {
    team_->run(count, work);
  } else {
    for (std::size_t i = 0; i < count; ++i) {
      work(i);
    }
  }
}

void SharedLoop::run(std::size_t count, Work work) const {
  // Where the coarser levels of a multigrid have few rows, each of them is long.
  constexpr std::size_t small = 512, usual_blocks = 16;
  for_each_block(*this, count, std::clamp(count / usual_blocks, small, block),
                 [&](std::size_t, std::size_t first, std::size_t last) { work(first, last); });
}

double SharedLoop::sum(std::size_t count, Term term) const {
  if (count <= block) {
    return count > 0 ? term(0, count) : 0;
  }
  double total = 0;
  for (const double one : terms_of(count, term)) {
    total += one;
  }
  return total;
}

double SharedLoop::largest(std::size_t count, Term term) const {
  double largest = 0;
  for (const double one : terms_of(count, term)) {
    largest = std::max(largest, one);
  }
  return largest;
}

std::vector<double> SharedLoop::terms_of(std::size_t count, Term term) const {
  std::vector<double> terms((count + block - 1) / block);
  for_each_block(*this, count, block,
                 [&](std::size_t number, std::size_t first, std::size_t last) { terms[number] = term(first, last); });
  return terms;
}

}  // namespace chainmail
