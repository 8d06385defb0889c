#pragma once

#include <algorithm>
#include <bit>
#include <cstdint>
#include <span>
#include <vector>

#include "mesh/mesh.h"

namespace chainmail {

/// A set of blocks of 64 elements, in id order. Changes are recorded per block, so that copying costs only what
/// changed. One bit per block makes 8 KiB for four million elements. Larger blocks copy more unchanged elements, since
/// the rows of a grid are far apart: with 256, a frame of 1,600 moved elements cost twice as much.
class ElementBlocks {
 public:
  static constexpr ElementId block_elements = 64;

  ElementBlocks() = default;
  /// An empty set, for an object with this many elements.
  explicit ElementBlocks(ElementId element_count)
      : element_count_(element_count), words_((block_count() + bits - 1) / bits) {}

  std::size_t block_count() const { return (std::size_t{element_count_} + block_elements - 1) / block_elements; }
  bool empty() const {
    return std::all_of(words_.begin(), words_.end(), [](std::uint64_t word) { return word == 0; });
  }

  bool contains_block(std::size_t block) const { return (words_[block / bits] >> (block % bits) & 1) != 0; }

  void insert(ElementId element) { insert_block(element / block_elements); }
  void insert_block(std::size_t block) { words_[block / bits] |= std::uint64_t{1} << (block % bits); }
  void insert_run(ElementId first, ElementId end) {
    for (std::size_t block = first / block_elements; block * block_elements < end; ++block) {
      insert_block(block);
    }
  }
  /// Inserts the blocks of these elements. For more than half of all elements it inserts all blocks without checking
  /// each.
  void insert(std::span<const ElementId> elements) {
    if (elements.size() > element_count_ / 2) {
      insert_all();
      return;
    }
    std::size_t last = block_count();
    for (const ElementId element : elements) {
      if (const std::size_t block = element / block_elements; block != last) {
        insert_block(last = block);
      }
    }
  }
  void insert_all() {
    for (std::size_t block = 0; block < block_count(); block += bits) {
      const std::size_t left = block_count() - block;
      words_[block / bits] = left < bits ? (std::uint64_t{1} << left) - 1 : ~std::uint64_t{0};
    }
  }
  /// Inserts the blocks of another set of the same object.
  void insert(const ElementBlocks& others) {
    for (std::size_t i = 0; i < words_.size(); ++i) {
      words_[i] |= others.words_[i];
    }
  }
  void clear() { std::fill(words_.begin(), words_.end(), 0); }

  /// Calls visit(first, end), with element ids, for each run of blocks, in ascending order.
  template <class Visit>
  void for_each_run(Visit visit) const {
    std::size_t first = 0, end = 0;  // of a run of blocks
    const auto finish = [&] {
      if (first != end) {
        visit(static_cast<ElementId>(first * block_elements),
              static_cast<ElementId>(std::min<std::size_t>(end * block_elements, element_count_)));
      }
    };
    for (std::size_t i = 0; i < words_.size(); ++i) {
      for (std::uint64_t word = words_[i]; word != 0; word &= word - 1) {
        const std::size_t block = bits * i + static_cast<std::size_t>(std::countr_zero(word));
        if (block != end) {
          finish();
          first = block;
        }
        end = block + 1;
      }
    }
    finish();
  }

  /// Calls visit(block, first, end), with element ids, for each block, in ascending order.
  template <class Visit>
  void for_each_block(Visit visit) const {
    for_each_run([&](ElementId first, ElementId end) {
      for (; first < end; first += block_elements) {
        visit(std::size_t{first / block_elements}, first, std::min(end, first + block_elements));
      }
    });
  }

 private:
  static constexpr std::size_t bits = 64;

  ElementId element_count_ = 0;
  std::vector<std::uint64_t> words_;  // one bit per block
};

}  // namespace chainmail
