#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace chainmail {

/// Numbers in groups that stand one after the other.
struct Groups {
  std::vector<std::uint32_t> first{0};  // of each group, and the end
  std::vector<std::uint32_t> items;

  std::size_t count() const { return first.size() - 1; }
  std::span<const std::uint32_t> operator[](std::size_t group) const {
    return std::span(items).subspan(first[group], first[group + 1] - first[group]);
  }
  /// Ends the group that items were added to.
  void close() { first.push_back(std::uint32_t(items.size())); }
};

/// The numbers from 0 to `size`, each in the group that groupOf says, ascending there.
template <class GroupOf>
Groups grouped(std::size_t groups, std::size_t size, GroupOf groupOf) {
  Groups result;
  result.first.assign(groups + 1, 0);
  result.items.resize(size);
  for (std::uint32_t i = 0; i < size; ++i) {
    ++result.first[groupOf(i) + 1];
  }
  for (std::size_t group = 0; group < groups; ++group) {
    result.first[group + 1] += result.first[group];
  }
  std::vector<std::uint32_t> next(result.first.begin(), result.first.end() - 1);
  for (std::uint32_t i = 0; i < size; ++i) {
    result.items[next[groupOf(i)]++] = i;
  }
  return result;
}

}  // namespace chainmail
