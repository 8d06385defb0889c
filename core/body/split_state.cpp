#include "body/split_state.h"

#include <algorithm>

namespace chainmail {
namespace {

LinkSoftness between(const LinkSoftness& one, const LinkSoftness& other) {
  LinkSoftness result;
  for (const auto& [parameter, value] : softness_numbers) {
    result.*value = one.*value + (other.*value - one.*value) / 2;
  }
  return result;
}

/// Reads and writes the coordinates that a body stores, element by element.
class SplitPositions {
 public:
  SplitPositions(const Split& split, const Snapshot& positions, Precision precision)
      : split_(split),
        after_mesh_(in_axes(split.after, positions.axes)),
        after_(*after_mesh_),
        old_(split.before->element_count()),
        dimension_(std::size_t(after_.space_dimension)),
        precision_(precision),
        result_(positions),
        rows_(split.edit.elements.size() * dimension_) {
    result_.blocks.resize(ElementBlocks(after_.element_count()).block_count());
  }

  Snapshot snapshot();

 private:
  double rounded(double value) const {
    return precision_ == Precision::single_precision ? double(static_cast<float>(value)) : value;
  }
  double at_rest(ElementId element, std::size_t k) const {
    return result_.from_rest ? 0 : rounded(after_.rest[element * dimension_ + k]);
  }
  double at(ElementId element, std::size_t k) const {
    if (element >= old_) {
      return rows_[(element - old_) * dimension_ + k];
    }
    const Snapshot::Block& block = result_.blocks[element / ElementBlocks::block_elements];
    return block == nullptr ? at_rest(element, k) : (*block)[element % ElementBlocks::block_elements * dimension_ + k];
  }
  void place(ElementId element, const SplitPoint& point);
  Snapshot::Block block(std::size_t number) const;

  const Split& split_;
  MeshPointer after_mesh_;  // along the axes of the positions
  const Mesh& after_;
  ElementId old_;
  std::size_t dimension_;
  Precision precision_;
  Snapshot result_;
  std::vector<double> rows_;   // of the appended elements
  std::vector<bool> is_away_;  // of the appended elements
};

/// Places an appended element. Elements at rest stay exactly there.
void SplitPositions::place(ElementId element, const SplitPoint& point) {
  bool at_rest_all = true;
  for (std::size_t k = 0; k < dimension_; ++k) {
    for (const ElementId one : point.of) {
      at_rest_all = at_rest_all && at(one, k) == at_rest(one, k);
    }
  }
  for (std::size_t k = 0; k < dimension_; ++k) {
    rows_[(element - old_) * dimension_ + k] =
        at_rest_all ? at_rest(element, k)
                    : rounded(point.mix(at(point.of[0], k), at(point.of[1], k), at(point.of[2], k)));
  }
  is_away_.push_back(!at_rest_all);
}

/// Returns a block with appended elements; null if all its elements are at rest.
Snapshot::Block SplitPositions::block(std::size_t number) const {
  const auto first = static_cast<ElementId>(number * ElementBlocks::block_elements);
  const ElementId end = std::min(first + ElementBlocks::block_elements, after_.element_count());
  bool is_away = result_.blocks[number] != nullptr;
  for (ElementId e = std::max(first, old_); e < end; ++e) {
    is_away = is_away || is_away_[e - old_];
  }
  if (!is_away) {
    return nullptr;
  }
  auto block = std::make_shared<std::vector<double>>();
  for (ElementId e = first; e < end; ++e) {
    for (std::size_t k = 0; k < dimension_; ++k) {
      block->push_back(at(e, k));
    }
  }
  return block;
}

Snapshot SplitPositions::snapshot() {
  for (ElementId i = 0; i < split_.edit.elements.size(); ++i) {
    place(old_ + i, split_.edit.elements[i]);
  }
  for (std::size_t number = old_ / ElementBlocks::block_elements; number < result_.blocks.size(); ++number) {
    result_.blocks[number] = block(number);
  }
  return std::move(result_);
}

std::shared_ptr<const Softness> softness_after(const Split& split, const std::shared_ptr<const Softness>& softness) {
  if (softness->links.empty()) {
    return softness;
  }
  Softness result{softness->global, {}, softness->energy, softness->axes};
  for (LinkId link = 0; link < split.parents.size(); ++link) {
    LinkId one = split.parents[link], other = one;
    if (one == Split::none) {
      one = split.link_at(split.after->links[link][0]);
      other = split.link_at(split.after->links[link][1]);
      one = one == Split::none ? other : one;
      other = other == Split::none ? one : other;
    }
    if (one != Split::none && (softness->links.contains(one) || softness->links.contains(other))) {
      result.links.set(link, between(softness->of(one), softness->of(other)));
    }
  }
  return std::make_shared<const Softness>(std::move(result));
}

}  // namespace

ObjectState object_after(const Split& split, const ObjectState& object) {
  return {split.after, cuts_after(split, object.cuts), pins_after(split, object.pins),
          softness_after(split, object.softness)};
}

Snapshot positions_after(const Split& split, const Snapshot& positions, Precision precision) {
  return SplitPositions(split, positions, precision).snapshot();
}

}  // namespace chainmail
