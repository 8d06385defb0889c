#include "simulate/command.h"

#include <algorithm>

namespace chainmail::commands {

void SliceCounts::note(std::size_t panel, Algorithm algorithm, std::uint32_t slices) {
  panels_[panel].algorithm = algorithm;
  panels_[panel].slices.store(std::min(slices, unknown - 1), std::memory_order_release);
  panels_[panel].slices.notify_all();
}

std::uint32_t SliceCounts::slices(std::size_t panel) const {
  panels_[panel].slices.wait(unknown, std::memory_order_acquire);
  return panels_[panel].slices;
}

Algorithm SliceCounts::algorithm(std::size_t panel) const {
  slices(panel);
  return panels_[panel].algorithm;
}

std::uint32_t SliceCounts::slices_for(std::size_t panel, Algorithm algorithm) const {
  panel = std::min(panel, size() - 1);
  for (std::size_t other = 0; other < size() && this->algorithm(panel) != algorithm; ++other) {
    panel = this->algorithm(other) == algorithm ? other : panel;
  }
  return slices(panel);
}

}  // namespace chainmail::commands
