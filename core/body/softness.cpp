#include "body/softness.h"

#include <algorithm>
#include <bit>
#include <span>

#include "mesh/error.h"

namespace chainmail {
namespace {

constexpr std::array all_energy_kinds{
    EnergyKindInfo{EnergyKind::isotropic, "isotropic", "Isotropic",
                   "Each link resists motion along it and across it alike; the numbers of its stiffness do not count.",
                   parameters::lateral.default_value},
    EnergyKindInfo{EnergyKind::axial, "axial", "Axial",
                   "Each link resists motion along its rest vector, and across it in the share of its lateral "
                   "stiffness. It suits small rotations.",
                   0.03},
    EnergyKindInfo{
        EnergyKind::corotated, "corotated", "Co-rotated",
        "Each link is a spring, and resists motion across its rest vector turned with its surroundings: close "
        "to an elastic solid, also in large rotations.",
        parameters::lateral.default_value},
    EnergyKindInfo{EnergyKind::material, "material", "Material",
                   "The cells resist as an elastic material with Poisson's ratio does, and a surface in space as a "
                   "thin shell of it; nothing is calibrated. Where there are neither, it is that of co-rotated links.",
                   parameters::lateral.default_value}};
static_assert(all_energy_kinds[0].kind == EnergyKind(0) && all_energy_kinds[1].kind == EnergyKind(1) &&
                  all_energy_kinds[2].kind == EnergyKind(2) && all_energy_kinds[3].kind == EnergyKind(3),
              "info() finds a row by its kind");

}  // namespace

std::span<const EnergyKindInfo> energy_kinds() { return all_energy_kinds; }

const EnergyKindInfo& info(EnergyKind kind) { return all_energy_kinds[static_cast<std::size_t>(kind)]; }

EnergyKind energy_kind_of(std::string_view name) {
  const auto found = std::ranges::find(all_energy_kinds, name, &EnergyKindInfo::name);
  if (found != all_energy_kinds.end()) {
    return found->kind;
  }
  std::string names;
  for (const EnergyKindInfo& one : all_energy_kinds) {
    const bool is_last = &one == &all_energy_kinds.back();
    names += (names.empty() ? "" : is_last ? " or " : ", ") + std::string(one.name);
  }
  throw Error("energy", "there is no such kind of energy", "use " + names);
}

namespace {

/// True if two softnesses of a link agree in the numbers from `first` to `end`.
bool agree(const LinkSoftness& one, const LinkSoftness& other, std::size_t first, std::size_t end) {
  const auto numbers = std::span(softness_numbers).subspan(first, end - first);
  return std::ranges::all_of(numbers, [&](const SoftnessNumber& it) { return one.*it.value == other.*it.value; });
}

bool same_region(const LinkSoftness& one, const LinkSoftness& other) { return agree(one, other, 0, region_numbers); }

void add_change(SoftnessChange& change, const LinkSoftness& before, const LinkSoftness& after) {
  change.regions |= !same_region(before, after);
  change.energy |= !agree(before, after, region_numbers, softness_numbers.size());
}

}  // namespace

std::string softness_names(std::string_view between, std::size_t first, std::size_t end) {
  std::string names;
  for (std::size_t i = first; i < end; ++i) {
    names.append(i == first ? std::string_view() : between).append(softness_numbers[i].parameter->name);
  }
  return names;
}

void check(const LinkSoftness& softness) { check_members(softness); }

void check(const Softness& softness, const Mesh& mesh) {
  check(softness.global);
  check(softness.axes, mesh);
  for (const auto& [link, own] : softness.links) {
    check_links(mesh, std::span(&link, 1));
    check(own);
  }
}

OwnSoftness::OwnSoftness(std::initializer_list<Entry> entries) : OwnSoftness(entries.begin(), entries.end()) {}

OwnSoftness::OwnSoftness(const OwnSoftness& other)
    : group_of_(other.group_of_), groups_(other.groups_), count_(other.count_) {
  other.is_exclusive_ = false;
}

OwnSoftness::OwnSoftness(OwnSoftness&& other) noexcept { *this = std::move(other); }

OwnSoftness& OwnSoftness::operator=(const OwnSoftness& other) { return *this = OwnSoftness(other); }

OwnSoftness& OwnSoftness::operator=(OwnSoftness&& other) noexcept {
  group_of_ = std::move(other.group_of_);
  groups_ = std::move(other.groups_);
  count_ = std::exchange(other.count_, 0);
  is_exclusive_ = other.is_exclusive_.exchange(false);
  return *this;
}

/// Returns the groups of links, with room up to a link. Copies them if another object shares them.
std::vector<std::uint32_t>& OwnSoftness::writable(LinkId last) {
  if (group_of_ == nullptr) {
    group_of_ = std::make_shared<std::vector<std::uint32_t>>();
  } else if (!is_exclusive_) {
    group_of_ = std::make_shared<std::vector<std::uint32_t>>(*group_of_);
  }
  is_exclusive_ = true;
  auto& groups = const_cast<std::vector<std::uint32_t>&>(*group_of_);  // this object alone has it
  if (groups.size() <= last) {
    groups.resize(std::size_t{last} + 1);
  }
  return groups;
}

void OwnSoftness::put(std::vector<std::uint32_t>& group_of, LinkId link, std::uint32_t group) {
  std::uint32_t& present = group_of[link];
  if (present != 0) {
    --groups_[present - 1].count;
    --count_;
  }
  present = group;
  if (group != 0) {
    ++groups_[group - 1].count;
    ++count_;
  }
}

void OwnSoftness::set(std::span<const LinkId> links, const LinkSoftness& softness) {
  if (links.empty()) {
    return;
  }
  const std::uint32_t first = group_of(links.front());
  const bool is_group = first != 0 && groups_[first - 1].count == links.size() &&
                        std::ranges::all_of(links, [&](LinkId link) { return group_of(link) == first; });
  if (is_group) {
    groups_[first - 1].softness = softness;
    return;
  }
  auto& all = writable(*std::ranges::max_element(links));
  const std::uint32_t group = group_for(softness, links.size());
  for (const LinkId link : links) {
    put(all, link, group);
  }
}

/// Returns the number of a group for so many links: the last one if a single link continues it, one that is empty, or a
/// new one.
std::uint32_t OwnSoftness::group_for(const LinkSoftness& softness, std::size_t links) {
  if (!groups_.empty() && groups_.back().softness == softness && links == 1) {
    return static_cast<std::uint32_t>(groups_.size());
  }
  if (links > 1) {
    if (const auto empty = std::ranges::find(groups_, LinkId{0}, &Group::count); empty != groups_.end()) {
      empty->softness = softness;
      return static_cast<std::uint32_t>(empty - groups_.begin()) + 1;
    }
  }
  groups_.push_back({softness, 0});
  return static_cast<std::uint32_t>(groups_.size());
}

void OwnSoftness::erase(std::span<const LinkId> links) {
  if (std::ranges::none_of(links, [this](LinkId link) { return contains(link); })) {
    return;
  }
  auto& all = writable(0);
  for (const LinkId link : links) {
    if (link < all.size()) {
      put(all, link, 0);
    }
  }
  if (count_ == 0) {
    *this = {};
  }
}

OwnSoftness::Iterator OwnSoftness::begin() const { return {*this, 0}; }

OwnSoftness::Iterator OwnSoftness::end() const {
  return {*this, static_cast<LinkId>(group_of_ == nullptr ? 0 : group_of_->size())};
}

void OwnSoftness::Iterator::settle() {
  const std::size_t size = own_->group_of_ == nullptr ? 0 : own_->group_of_->size();
  while (entry_.first < size && (*own_->group_of_)[entry_.first] == 0) {
    ++entry_.first;
  }
  if (entry_.first < size) {
    entry_.second = own_->groups_[(*own_->group_of_)[entry_.first] - 1].softness;
  }
}

bool OwnSoftness::operator==(const OwnSoftness& other) const {
  return count_ == other.count_ && std::equal(begin(), end(), other.begin(), other.end());
}

Softness standard_softness() {
  Softness softness;
  set_energy(softness, standard_energy);
  return softness;
}

void set_energy(Softness& softness, EnergyKind kind) {
  if (softness.global.lateral == info(softness.energy).lateral) {
    softness.global.lateral = info(kind).lateral;
  }
  softness.energy = kind;
}

Softness kept_for(const Mesh& mesh, const Softness& softness) {
  return {softness.global, {}, softness.energy, axes_for(mesh, softness.axes)};
}

OwnSoftness own_softness_of(std::vector<OwnSoftness::Entry> entries) {
  const auto numbers_of = [](const OwnSoftness::Entry& entry) {
    return std::bit_cast<std::array<double, softness_numbers.size()>>(entry.second);
  };
  std::ranges::stable_sort(entries, {}, numbers_of);
  return OwnSoftness(entries.begin(), entries.end());
}

void set_own(Softness& softness, const Mesh& mesh, std::span<const LinkId> links,
             std::span<const LinkSoftness> softnesses) {
  check_links(mesh, links);
  std::vector<OwnSoftness::Entry> entries;
  entries.reserve(links.size() + softness.links.size());
  std::vector<bool> is_new(mesh.link_count());
  for (std::size_t i = 0; i < links.size(); ++i) {
    const std::string link = "link " + std::to_string(links[i]);
    if (is_new[links[i]]) {
      throw Error(link, "it is given twice", "give each link once");
    }
    try {
      check(softnesses[i]);
    } catch (const Error& error) {
      throw error.at(link + ", " + error.where());
    }
    is_new[links[i]] = true;
    entries.emplace_back(links[i], softnesses[i]);
  }
  std::ranges::copy_if(softness.links, std::back_inserter(entries),
                       [&](const OwnSoftness::Entry& one) { return !is_new[one.first]; });
  softness.links = own_softness_of(std::move(entries));
}

bool has_global_regions(const Softness& softness) {
  return std::all_of(softness.links.begin(), softness.links.end(),
                     [&](const OwnSoftness::Entry& own) { return same_region(own.second, softness.global); });
}

SoftnessChange change_of(const Softness& before, const Softness& after) {
  SoftnessChange change{.regions = before.axes.rotation() != after.axes.rotation(),
                        .energy = before.energy != after.energy};
  add_change(change, before.global, after.global);
  for (const auto& [link, own] : before.links) {
    add_change(change, own, after.of(link));
  }
  for (const auto& [link, own] : after.links) {
    add_change(change, before.of(link), own);
  }
  return change;
}

}  // namespace chainmail
