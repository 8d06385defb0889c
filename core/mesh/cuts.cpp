#include "mesh/cuts.h"

#include <algorithm>
#include <bit>

namespace chainmail {
namespace {

using Bits = std::vector<std::uint64_t>;

constexpr std::size_t words_for(std::size_t bits) { return (bits + 63) / 64; }

void set_bit(Bits& bits, std::size_t i, bool on) {
  const std::uint64_t bit = std::uint64_t{1} << (i % 64);
  bits[i / 64] = on ? bits[i / 64] | bit : bits[i / 64] & ~bit;
}

/// Calls visit(64 * index + i) for each bit i that is set in a word.
template <class Visit>
void for_each_bit(std::uint64_t word, std::size_t index, Visit visit) {
  for (; word != 0; word &= word - 1) {
    visit(64 * index + static_cast<std::size_t>(std::countr_zero(word)));
  }
}

}  // namespace

bool Cuts::has_cut(ElementId element) const {
  const auto* row = mesh_->entry_link.data();
  return std::any_of(row + mesh_->first_entry[element], row + mesh_->first_entry[element + 1],
                     [this](LinkId link) { return is_cut(link); });
}

void Cuts::set(LinkId link, bool cut) {
  if (is_cut(link) == cut) {
    return;
  }
  if (words_.empty()) {
    words_.resize(words_for(mesh_->links.size()));
    filled_.resize(words_for(words_.size()));
    touched_.resize(words_for(mesh_->element_count()));
  }
  set_bit(words_, link, cut);
  set_bit(filled_, link / 64, words_[link / 64] != 0);
  count_ += cut ? 1 : -1;
  for (const ElementId end : mesh_->links[link]) {
    set_bit(touched_, end, has_cut(end));
  }
}

std::vector<LinkId> Cuts::links() const {
  std::vector<LinkId> result;
  result.reserve(count_);
  for (std::size_t i = 0; count_ != 0 && i < filled_.size(); ++i) {
    for_each_bit(filled_[i], i, [&](std::size_t word) {
      for_each_bit(words_[word], word, [&](std::size_t link) { result.push_back(static_cast<LinkId>(link)); });
    });
  }
  return result;
}

}  // namespace chainmail
