#include "measure/violation.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>

#include "body/region.h"
#include "equilibrium/link_energy.h"

namespace chainmail {
namespace {

template <int Dimension>
double excess(const Mesh& mesh, const LinkSoftness& softness, const RegionAxes& axes, const PositionView& position,
              ElementId a, ElementId b) {
  const auto region = valid_region<double, Dimension>(mesh, axes, a, b, softness);
  double vector[Dimension];
  for (int k = 0; k < Dimension; ++k) {
    vector[k] = position.between(a, b, k);
  }
  if (axes.is_turned()) {
    turn_into_axes(mesh, axes, vector);
  }
  double square = 0;
  for (int k = 0; k < Dimension; ++k) {
    const double outside = std::max({region.low[k] - vector[k], vector[k] - region.high[k], 0.0});
    square += outside * outside;
  }
  return std::sqrt(square);
}

/// Returns the number of blocks in the set.
std::size_t count_of(const ElementBlocks& blocks) {
  constexpr ElementId size = ElementBlocks::block_elements;
  std::size_t count = 0;
  blocks.for_each_run([&](ElementId first, ElementId end) { count += (end - first + size - 1) / size; });
  return count;
}

}  // namespace

double link_violation(const Mesh& mesh, const Softness& softness, const PositionView& position, LinkId link) {
  const auto [a, b] = mesh.links[link];
  const LinkSoftness& of_link = softness.of(link);
  const RegionAxes& axes = softness.axes;
  const double outside = mesh.space_dimension == 1   ? excess<1>(mesh, of_link, axes, position, a, b)
                         : mesh.space_dimension == 2 ? excess<2>(mesh, of_link, axes, position, a, b)
                                                     : excess<3>(mesh, of_link, axes, position, a, b);
  if (outside == 0) {
    return 0;
  }
  const double length = rest_length(mesh, link);
  return outside / (length > 0 ? length : mesh.mean_link_length > 0 ? mesh.mean_link_length : 1);
}

void ViolationSum::add(double violation) {
  violation = std::isnan(violation) ? std::numeric_limits<double>::infinity() : violation;
  ++links_;
  max_ = std::max(max_, violation);
  squares_ += violation * violation;
  violated_ += violation > counts_as_violated ? 1 : 0;
}

void ViolationSum::add(const ViolationSum& other) {
  links_ += other.links_;
  max_ = std::max(max_, other.max_);
  squares_ += other.squares_;
  violated_ += other.violated_;
}

Violation ViolationSum::result() const {
  if (links_ == 0) {
    return {};
  }
  return {max_, std::sqrt(squares_ / double(links_)), double(violated_) / double(links_), links_};
}

ViolationMeter::ViolationMeter(LinkId links) : stale_(links), left_(links), measured_(links) {
  sums_.resize(stale_.block_count());
  groups_ = ElementBlocks(static_cast<ElementId>(sums_.size()));
  sums_of_groups_.resize(groups_.block_count());
  stale_.insert_all();
  // With steps of the golden section, some blocks lie evenly between all others.
  stride_ = static_cast<std::size_t>(static_cast<double>(sums_.size()) / std::numbers::phi) + 1;
  while (std::gcd(stride_, sums_.size()) > 1) {
    ++stride_;
  }
}

void ViolationMeter::forget(const Mesh& mesh, const ElementBlocks& moved) {
  if (sums_.empty()) {
    return;  // all links are measured first
  }
  if (count_of(moved) > moved.block_count() / 2) {
    forget_all();
    return;
  }
  moved.for_each_run([&](ElementId first, ElementId end) {
    for (EntryId entry = mesh.first_entry[first]; entry < mesh.first_entry[end]; ++entry) {
      stale_.insert(mesh.entry_link[entry]);
    }
  });
}

void ViolationMeter::forget(std::span<const LinkId> links) {
  for (const LinkId link : sums_.empty() ? std::span<const LinkId>() : links) {
    stale_.insert(link);
  }
}

/// Calls visit(block) with up to `most` stale blocks. If there are more, the next calls visit the others.
template <class Visit>
void ViolationMeter::for_each_measured(std::size_t most, Visit visit) {
  stale_.for_each_run([this](LinkId first, LinkId end) {
    groups_.insert_run(first / block_links, (end + block_links - 1) / block_links);
  });
  if (count_of(stale_) <= most) {
    stale_.for_each_block([&](std::size_t block, LinkId /*first*/, LinkId /*end*/) { visit(block); });
    stale_.clear();
    return;
  }
  for (std::size_t left = most; left > 0; next_ = (next_ + stride_) % sums_.size()) {
    if (stale_.contains_block(next_) && !measured_.contains_block(next_)) {
      visit(next_);
      measured_.insert_block(next_);
      --left;
    }
  }
  left_.clear();
  stale_.for_each_block([this](std::size_t block, LinkId /*first*/, LinkId /*end*/) {
    if (!measured_.contains_block(block)) {
      left_.insert_block(block);
    }
  });
  measured_.clear();
  std::swap(stale_, left_);
}

Violation ViolationMeter::total() {
  groups_.for_each_block([this](std::size_t group, ElementId first, ElementId end) {
    sums_of_groups_[group] = {};
    for (ElementId block = first; block < end; ++block) {
      if (!stale_.contains_block(block)) {
        sums_of_groups_[group].add(sums_[block]);
      }
    }
  });
  groups_.clear();
  ViolationSum sum;
  for (const ViolationSum& one : sums_of_groups_) {
    sum.add(one);
  }
  return sum.result();
}

MeasuredViolation ViolationMeter::measure(const Mesh& mesh, const Softness& softness, const Cuts& cuts,
                                          const PositionView& position, LinkId most) {
  if (sums_.empty()) {
    *this = ViolationMeter(mesh.link_count());
  }
  for_each_measured(most / block_links + 1, [&](std::size_t block) {
    ViolationSum sum;
    const auto first = static_cast<LinkId>(block * block_links);
    for (LinkId link = first; link < mesh.link_count() && link - first < block_links; ++link) {
      if (!cuts.is_cut(link)) {
        sum.add(link_violation(mesh, softness, position, link));
      }
    }
    sums_[block] = sum;
  });
  return {total(), stale_.empty(), std::chrono::steady_clock::now()};
}

Violation measure_violation(const Mesh& mesh, const Softness& softness, const Cuts& cuts,
                            const PositionView& position) {
  return ViolationMeter().measure(mesh, softness, cuts, position, mesh.link_count());
}

Displacement measure_displacement(const Mesh& mesh, const PositionView& position) {
  Displacement result;
  double sum = 0;
  for (ElementId e = 0; e < mesh.element_count(); ++e) {
    double square = 0;
    for (int k = 0; k < mesh.space_dimension; ++k) {
      const double moved = position(e, k) - mesh.rest[std::size_t{e} * mesh.space_dimension + k];
      square += moved * moved;
    }
    result.max = std::max(result.max, square);
    sum += square;
  }
  result.max = std::sqrt(result.max);
  result.rms = mesh.element_count() == 0 ? 0 : std::sqrt(sum / mesh.element_count());
  return result;
}

double link_violation(const Body& body, LinkId link) {
  check_links(body.mesh(), std::span(&link, 1));
  return link_violation(body.mesh(), body.softness(), body.positions(), link);
}

Violation measure_violation(const Body& body) {
  return measure_violation(body.mesh(), body.softness(), body.cuts(), body.positions());
}

double elastic_energy(const Body& body) {
  return elastic_energy(body.mesh(), body.softness(), body.cuts(), body.positions(), body.elastic());
}

}  // namespace chainmail
