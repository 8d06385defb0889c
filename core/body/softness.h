#pragma once

#include <array>
#include <atomic>
#include <cstdint>
#include <initializer_list>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "body/region_axes.h"
#include "mesh/described.h"
#include "mesh/mesh.h"
#include "mesh/parameters.h"

namespace chainmail {

/// The elastic energy that relaxation lowers: of the links, or of the material of the cells or of a surface in space.
/// Each kind has one entry in the table of softness.cpp; the formulas are in equilibrium/link_energy.h,
/// equilibrium/material_energy.h and equilibrium/surface_energy.h.
enum class EnergyKind { isotropic, axial, corotated, material };

/// The energy of a new object. Objects without cells and faces, and sweeps, have that of links in its place.
inline constexpr EnergyKind standard_energy = EnergyKind::material;
/// The energy of links that comes closest to a material. Recorded moves and files that name no energy mean this one,
/// and calibration adjusts it.
inline constexpr EnergyKind link_energy = EnergyKind::corotated;

/// Returns the kind of energy that links have if that of the material cannot be used.
constexpr EnergyKind energy_of_links(EnergyKind kind) { return kind == EnergyKind::material ? link_energy : kind; }

/// One row of the table: everything that other code knows about a kind of energy.
struct EnergyKindInfo {
  EnergyKind kind;
  std::string_view name;   // on the command line and in files
  std::string_view label;  // in the window
  std::string_view help;   // one sentence
  double lateral;          // lateral stiffness that suits most objects
};

/// All kinds, in the order of the constants.
std::span<const EnergyKindInfo> energy_kinds();
const EnergyKindInfo& info(EnergyKind kind);
/// Returns the kind of this name. Throws Error, with all names, if there is none.
EnergyKind energy_kind_of(std::string_view name);

/// The softness of a link. The first three numbers say how far it may shorten, lengthen and lean, relative to its rest
/// vector: they decide on its valid region. The others say how strongly it returns to its rest vector: they decide on
/// its energy (see equilibrium/link_energy.h). See mesh/parameters.h for the ranges.
struct LinkSoftness {
  double compression = parameters::compression.default_value;
  double stretch = parameters::stretch.default_value;
  double shear = parameters::shear.default_value;
  double lateral = parameters::lateral.default_value;      // stiffness across the link, per its stiffness along it
  double stiffness = parameters::stiffness.default_value;  // along the link, relative to other links
  double exponent = parameters::exponent.default_value;    // of the rest length, which the stiffness is multiplied by

  bool operator==(const LinkSoftness&) const = default;
};

/// A number of a link's softness, with its entry in the table of parameters.
struct SoftnessNumber {
  const Parameter* parameter;
  double LinkSoftness::*value;
};

/// The numbers of a link's softness in the order in which files, docks and help texts have them.
inline constexpr std::array<SoftnessNumber, 6> softness_numbers{{
    {&parameters::compression, &LinkSoftness::compression},
    {&parameters::stretch, &LinkSoftness::stretch},
    {&parameters::shear, &LinkSoftness::shear},
    {&parameters::lateral, &LinkSoftness::lateral},
    {&parameters::stiffness, &LinkSoftness::stiffness},
    {&parameters::exponent, &LinkSoftness::exponent},
}};
/// Numbers that decide on the valid region come first. The others decide on the energy.
inline constexpr std::size_t region_numbers = 3;
/// The same as members of a described struct. Files before version 2 of sessions have those of the region only.
template <std::size_t... I>
constexpr auto described_softness(std::index_sequence<I...> /*all*/) {
  const auto member = [](Member<LinkSoftness> one, std::size_t i) {
    return i < region_numbers ? one : may_be_absent(one);
  };
  return std::array{member(
      number<softness_numbers[I].value>(softness_numbers[I].parameter->name, *softness_numbers[I].parameter), I)...};
}
template <>
inline constexpr auto members_of<LinkSoftness> =
    described_softness(std::make_index_sequence<softness_numbers.size()>());
/// Returns the names of the numbers from index `first` to before `end`, separated by `between`.
std::string softness_names(std::string_view between, std::size_t first = 0, std::size_t end = softness_numbers.size());

/// Throws Error, with the name of the parameter, if a number is out of range.
void check(const LinkSoftness& softness);

/// The softness of links that have their own.
///
/// Links are in groups that share one softness. The group of each link is in an array that copies share: to change the
/// softness of a whole group, like a slider does for a selection, copies no link.
class OwnSoftness {
 public:
  using Entry = std::pair<LinkId, LinkSoftness>;
  class Iterator;

  OwnSoftness() = default;
  OwnSoftness(const OwnSoftness& other);
  OwnSoftness(OwnSoftness&& other) noexcept;
  OwnSoftness& operator=(const OwnSoftness& other);
  OwnSoftness& operator=(OwnSoftness&& other) noexcept;
  ~OwnSoftness() = default;
  OwnSoftness(std::initializer_list<Entry> entries);
  template <class First>
  OwnSoftness(First first, First last) {
    for (; first != last; ++first) {
      set(first->first, first->second);
    }
  }

  bool empty() const { return count_ == 0; }
  /// Number of links with their own softness.
  std::size_t size() const { return count_; }
  /// Returns the softness of a link, or null if it has none of its own.
  const LinkSoftness* find(LinkId link) const {
    const std::uint32_t group = group_of(link);
    return group == 0 ? nullptr : &groups_[group - 1].softness;
  }
  bool contains(LinkId link) const { return group_of(link) != 0; }

  /// Sets the softness of links, which are all different.
  void set(LinkId link, const LinkSoftness& softness) { set(std::span(&link, 1), softness); }
  void set(std::span<const LinkId> links, const LinkSoftness& softness);
  /// Removes the softness of links; those without one are ignored.
  void erase(LinkId link) { erase(std::span(&link, 1)); }
  void erase(std::span<const LinkId> links);

  /// The links with their own softness, ascending.
  Iterator begin() const;
  Iterator end() const;

  bool operator==(const OwnSoftness& other) const;

 private:
  struct Group {
    LinkSoftness softness;
    LinkId count = 0;  // links in the group
  };

  std::uint32_t group_of(LinkId link) const {
    return group_of_ == nullptr || link >= group_of_->size() ? 0 : (*group_of_)[link];
  }
  std::vector<std::uint32_t>& writable(LinkId last);
  std::uint32_t group_for(const LinkSoftness& softness, std::size_t links);
  void put(std::vector<std::uint32_t>& group_of, LinkId link, std::uint32_t group);

  /// Of each link up to the last one that has its own softness: its group, counted from 1; 0 if it has none.
  std::shared_ptr<const std::vector<std::uint32_t>> group_of_;
  std::vector<Group> groups_;
  std::size_t count_ = 0;
  /// True while no other object has the array. It is not derived from the number of owners: another thread may have
  /// just read the array before it dropped its share.
  mutable std::atomic<bool> is_exclusive_ = false;
};

/// Goes through the links with their own softness, ascending.
class OwnSoftness::Iterator {
 public:
  using iterator_category = std::input_iterator_tag;  // NOLINT(readability-identifier-naming)
  using value_type = Entry;                           // NOLINT(readability-identifier-naming)
  using difference_type = std::ptrdiff_t;             // NOLINT(readability-identifier-naming)
  using pointer = const Entry*;                       // NOLINT(readability-identifier-naming)
  using reference = const Entry&;                     // NOLINT(readability-identifier-naming)

  Iterator() = default;
  Iterator(const OwnSoftness& own, LinkId link) : own_(&own), entry_(link, {}) { settle(); }

  reference operator*() const { return entry_; }
  pointer operator->() const { return &entry_; }
  Iterator& operator++() {
    ++entry_.first;
    settle();
    return *this;
  }
  Iterator operator++(int) {
    const Iterator before = *this;
    ++*this;
    return before;
  }
  bool operator==(const Iterator& other) const { return entry_.first == other.entry_.first; }

 private:
  void settle();

  const OwnSoftness* own_ = nullptr;
  Entry entry_;
};

/// The softness of an object: a global one, different ones for single links, the kind of energy of all links, and the
/// axes along which their valid regions lie. Recorded moves begin with Softness(), new objects with
/// standard_softness().
struct Softness {
  LinkSoftness global;
  OwnSoftness links;
  EnergyKind energy = link_energy;
  RegionAxes axes = {};

  const LinkSoftness& of(LinkId link) const {
    const LinkSoftness* own = links.find(link);
    return own == nullptr ? global : *own;
  }

  bool operator==(const Softness&) const = default;
};

/// Returns the softness of a new object.
Softness standard_softness();

/// Throws Error if a number is out of its range, if a link does not exist, or if the axes leave the mesh's space.
void check(const Softness& softness, const Mesh& mesh);

/// Sets the kind of energy. A global lateral stiffness that was the suggested one stays so.
void set_energy(Softness& softness, EnergyKind kind);

/// Returns what another object keeps of a softness: all but that of single links.
Softness kept_for(const Mesh& mesh, const Softness& softness);

/// Returns the softness of links (each once) that have their own. Links with the same softness are one group.
OwnSoftness own_softness_of(std::vector<OwnSoftness::Entry> entries);
/// Gives links (ids) their own softness, one for each; other links keep theirs. Throws Error, with the link, for a link
/// that does not exist or is given twice, and for a number out of range; nothing has changed then.
void set_own(Softness& softness, const Mesh& mesh, std::span<const LinkId> links,
             std::span<const LinkSoftness> softnesses);

/// True if the valid regions of all links follow from the global softness.
bool has_global_regions(const Softness& softness);

/// What differs between two softnesses of the same object.
struct SoftnessChange {
  bool regions = false;  // the valid region of a link
  bool energy = false;   // the kind of energy, or the energy of a link

  bool operator==(const SoftnessChange&) const = default;
};
SoftnessChange change_of(const Softness& before, const Softness& after);

}  // namespace chainmail
