#include "mesh/parts.h"

#include <algorithm>
#include <numeric>

#include "mesh/disjoint_sets.h"

namespace chainmail {

std::uint32_t count_parts(const Mesh& mesh, const Cuts& cuts, const Progress& progress) {
  std::vector<bool> seen(mesh.element_count(), false);
  std::vector<ElementId> open;
  std::uint32_t count = 0;
  std::size_t done = 0;
  for (ElementId first = 0; first < mesh.element_count(); ++first) {
    if (seen[first]) {
      continue;
    }
    ++count;
    seen[first] = true;
    open.push_back(first);
    while (!open.empty()) {
      progress.report(done++, mesh.element_count());
      const ElementId element = open.back();
      open.pop_back();
      for_each_neighbour(mesh, cuts, element, [&](ElementId neighbour, EntryId) {
        if (!seen[neighbour]) {
          seen[neighbour] = true;
          open.push_back(neighbour);
        }
      });
    }
  }
  return count;
}

namespace {

/// Searches that start at the ends of the cut links. Two searches that meet become one. Each search also belongs to a
/// group: the searches that these links would join if they were not cut.
class Searches {
 public:
  /// `reached_by` is scratch for all elements: all 0 before and after.
  Searches(const Mesh& mesh, const Cuts& cuts, std::vector<std::uint32_t>& reached_by)
      : mesh_(mesh), cuts_(cuts), reached_by_(reached_by) {}
  ~Searches() {
    for (const ElementId element : reached_) {
      reached_by_[element] = 0;
    }
  }

  void begin(LinkId link) { same_group(at(mesh_.links[link][0]), at(mesh_.links[link][1])); }
  /// Runs the searches. Returns the number of separate parts that the groups have beyond one each.
  std::uint32_t grow();
  std::size_t reached() const { return reached_.size(); }

 private:
  struct Search {
    std::vector<ElementId> open;  // elements to visit, from `next` on
    std::size_t next = 0;
    bool live = true;  // may still reach more elements
    // Number of live searches in the group. Only the search that names the group uses it.
    std::uint32_t growing = 1;
  };

  std::uint32_t at(ElementId end);
  void reach(ElementId element, std::uint32_t search);
  void same_group(std::uint32_t one, std::uint32_t other);
  void step(std::uint32_t search);
  void meet(std::uint32_t search, std::uint32_t other);
  bool is_settled(std::uint32_t search) { return searches_[groups_.of(search)].growing <= 1; }

  const Mesh& mesh_;
  const Cuts& cuts_;
  std::vector<std::uint32_t>& reached_by_;
  std::vector<ElementId> reached_;
  std::vector<Search> searches_;
  DisjointSets met_, groups_;
  std::uint32_t exhausted_ = 0;  // searches that ended while others of their group were still live
};

std::uint32_t Searches::at(ElementId end) {
  if (reached_by_[end] == 0) {
    const auto search = static_cast<std::uint32_t>(searches_.size());
    searches_.emplace_back();
    met_.add();
    groups_.add();
    reach(end, search);
  }
  return reached_by_[end] - 1;
}

void Searches::reach(ElementId element, std::uint32_t search) {
  reached_by_[element] = search + 1;
  reached_.push_back(element);
  searches_[search].open.push_back(element);
}

void Searches::same_group(std::uint32_t one, std::uint32_t other) {
  one = std::uint32_t(groups_.of(one));
  other = std::uint32_t(groups_.of(other));
  if (one != other) {
    groups_.join(one, other);
    searches_[one].growing += searches_[other].growing;
  }
}

/// Makes two searches one. The first one continues with the open elements of both.
void Searches::meet(std::uint32_t search, std::uint32_t other) {
  same_group(search, other);
  --searches_[groups_.of(search)].growing;
  met_.join(search, other);
  Search &one = searches_[search], &two = searches_[other];
  if (two.open.size() - two.next > one.open.size() - one.next) {
    std::swap(one.open, two.open);
    std::swap(one.next, two.next);
  }
  one.open.insert(one.open.end(), two.open.begin() + static_cast<std::ptrdiff_t>(two.next), two.open.end());
  two = Search{{}, 0, false, two.growing};
}

/// Visits one element and reaches its neighbours.
void Searches::step(std::uint32_t search) {
  Search& own = searches_[search];
  if (own.next == own.open.size()) {
    own.live = false;
    --searches_[groups_.of(search)].growing;
    ++exhausted_;
    return;
  }
  const ElementId element = own.open[own.next++];
  for_each_neighbour(mesh_, cuts_, element, [&](ElementId neighbour, EntryId) {
    if (reached_by_[neighbour] == 0) {
      reach(neighbour, search);
    } else if (const auto other = std::uint32_t(met_.of(reached_by_[neighbour] - 1)); other != search) {
      meet(search, other);
    }
  });
}

/// The searches take turns, one element each, so that none visits more elements than the smallest of them needs.
std::uint32_t Searches::grow() {
  std::vector<std::uint32_t> turn(searches_.size());
  std::iota(turn.begin(), turn.end(), 0U);
  while (!turn.empty()) {
    std::erase_if(turn, [this](std::uint32_t search) {
      if (searches_[search].live && !is_settled(search)) {
        step(search);
      }
      return !searches_[search].live || is_settled(search);
    });
  }
  return exhausted_;
}

}  // namespace

Parts::Parts(const MeshPointer& mesh) : mesh_(mesh), count_(mesh->part_count) {}

/// Returns the number of parts that would vanish if these links, all of which are cut, were joined again.
std::uint32_t Parts::parts_separated_by(const Cuts& cuts, std::span<const LinkId> links) {
  reached_by_.resize(mesh_->element_count());
  Searches searches(*mesh_, cuts, reached_by_);
  for (const LinkId link : links) {
    searches.begin(link);
  }
  const std::uint32_t more = searches.grow();
  looked_at_ = searches.reached();
  return more;
}

void Parts::cut(Cuts& cuts, std::span<const LinkId> links) {
  std::vector<LinkId> changed;
  for (const LinkId link : links) {
    if (!cuts.is_cut(link)) {
      cuts.cut(link);
      changed.push_back(link);
    }
  }
  count_ += parts_separated_by(cuts, changed);
}

void Parts::uncut(Cuts& cuts, std::span<const LinkId> links) {
  std::vector<LinkId> changed;
  std::copy_if(links.begin(), links.end(), std::back_inserter(changed), [&](LinkId link) { return cuts.is_cut(link); });
  count_ -= parts_separated_by(cuts, changed);
  for (const LinkId link : changed) {
    cuts.uncut(link);
  }
}

}  // namespace chainmail
