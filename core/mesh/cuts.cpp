#include "mesh/cuts.h"

#include <algorithm>
#include <bit>

namespace chainmail {

void Cuts::set(LinkId link, bool cut) {
  if (is_cut(link) == cut) {
    return;
  }
  if (words_.empty()) {
    words_.resize((mesh_->links.size() + 63) / 64);
    touched_.resize(mesh_->element_count());
  }
  words_[link / 64] ^= std::uint64_t{1} << (link % 64);
  count_ += cut ? 1 : -1;
  for (const ElementId end : mesh_->links[link]) {
    const auto* row = mesh_->entry_link.data();
    touched_[end] = std::any_of(row + mesh_->first_entry[end], row + mesh_->first_entry[end + 1],
                                [this](LinkId other) { return is_cut(other); });
  }
}

std::vector<LinkId> Cuts::links() const {
  std::vector<LinkId> result;
  result.reserve(count_);
  for (std::size_t i = 0; count_ != 0 && i < words_.size(); ++i) {
    for (std::uint64_t word = words_[i]; word != 0; word &= word - 1) {
      result.push_back(static_cast<LinkId>(64 * i + std::countr_zero(word)));
    }
  }
  return result;
}

}  // namespace chainmail
