#include "body/snapshot.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <unordered_map>

#include "mesh/carriers.h"
#include "mesh/cells.h"
#include "mesh/error.h"

namespace chainmail {
namespace {

bool fits_precision(const std::vector<double>& coordinates, Precision precision) {
  const double limit = position_limit(precision);
  return std::ranges::all_of(coordinates, [limit](double one) { return std::abs(one) <= limit; });
}

[[noreturn]] void refuse_coordinate() {
  throw Error("positions", "a coordinate is out of the range of the precision", "keep coordinates within 1e37");
}

void check(const PositionRuns& positions, const Mesh& mesh, Precision precision) {
  const auto& runs = positions.runs;
  std::uint64_t given = 0;
  bool ascending = runs.size() % 2 == 0;
  for (std::size_t i = 0; ascending && i < runs.size(); i += 2) {
    ascending = runs[i] < runs[i + 1] && runs[i + 1] <= mesh.element_count() && (i == 0 || runs[i - 1] <= runs[i]);
    given += runs[i + 1] - runs[i];
  }
  if (!ascending) {
    throw Error("positions", "the runs of elements are not ascending pairs",
                "give the first element of each run and the one after its last, in ascending order");
  }
  const auto dimension = static_cast<std::uint64_t>(mesh.space_dimension);
  if (positions.held.size() != dimension * given) {
    throw Error("positions",
                "there are " + std::to_string(positions.held.size()) + " coordinates, but the runs contain " +
                    std::to_string(given) + " elements in " + std::to_string(dimension) + "D",
                "give all coordinates of each element");
  }
  if (!fits_precision(positions.held, precision)) {
    refuse_coordinate();
  }
}

/// Number of coordinates in a block of a mesh.
std::size_t coordinates_in(const Mesh& mesh, std::size_t block) {
  const std::size_t first = block * ElementBlocks::block_elements;
  const std::size_t elements = std::min<std::size_t>(ElementBlocks::block_elements, mesh.element_count() - first);
  return elements * static_cast<std::size_t>(mesh.space_dimension);
}

}  // namespace

bool Snapshot::is_at_rest() const {
  return std::ranges::none_of(blocks, [](const Block& block) { return block != nullptr; });
}

ElementBlocks Snapshot::away(const Mesh& mesh) const {
  ElementBlocks result(mesh.element_count());
  for (std::size_t block = 0; block < blocks.size(); ++block) {
    if (blocks[block] != nullptr) {
      result.insert_block(block);
    }
  }
  return result;
}

bool Snapshot::operator==(const Snapshot& other) const {
  if (is_at_rest() && other.is_at_rest()) {
    return from_rest == other.from_rest;
  }
  return from_rest == other.from_rest && axes.rotation() == other.axes.rotation() &&
         std::ranges::equal(blocks, other.blocks, [](const Block& one, const Block& two) {
           return one == two || (one != nullptr && two != nullptr && *one == *two);
         });
}

PositionRuns runs_of(const Snapshot& snapshot, const Mesh& mesh) {
  PositionRuns result{snapshot.from_rest, {}, {}, snapshot.axes};
  snapshot.away(mesh).for_each_run([&](ElementId first, ElementId end) {
    result.runs.insert(result.runs.end(), {first, end});
  });
  for (const Snapshot::Block& block : snapshot.blocks) {
    if (block != nullptr) {
      result.held.insert(result.held.end(), block->begin(), block->end());
    }
  }
  return result;
}

Snapshot snapshot_of(const PositionRuns& positions, const Mesh& mesh, Precision precision) {
  check(positions, mesh, precision);
  const auto dimension = static_cast<std::size_t>(mesh.space_dimension);
  std::vector<std::shared_ptr<std::vector<double>>> blocks(ElementBlocks(mesh.element_count()).block_count());
  auto held = positions.held.begin();
  for (std::size_t i = 0; i < positions.runs.size(); i += 2) {
    for (ElementId e = positions.runs[i]; e < positions.runs[i + 1]; ++e, held += std::ptrdiff_t(dimension)) {
      auto& block = blocks[e / ElementBlocks::block_elements];
      const std::size_t first = std::size_t{e} / ElementBlocks::block_elements * ElementBlocks::block_elements;
      if (block == nullptr) {
        const std::size_t count = coordinates_in(mesh, e / ElementBlocks::block_elements);
        const auto rest = mesh.rest.begin() + std::ptrdiff_t(first * dimension);
        block = positions.from_rest ? std::make_shared<std::vector<double>>(count)
                                    : std::make_shared<std::vector<double>>(rest, rest + std::ptrdiff_t(count));
        for (std::size_t at = 0; at < count && positions.axes.is_turned(); at += dimension) {
          turn_into_axes(mesh, positions.axes, block->data() + at);
        }
      }
      std::transform(held, held + std::ptrdiff_t(dimension), block->begin() + std::ptrdiff_t((e - first) * dimension),
                     [precision](double one) {
                       return precision == Precision::single_precision ? double(static_cast<float>(one)) : one;
                     });
    }
  }
  return {positions.from_rest, {blocks.begin(), blocks.end()}, positions.axes};
}

void check(const Snapshot& snapshot, const Mesh& mesh, Precision precision) {
  const std::size_t count = ElementBlocks(mesh.element_count()).block_count();
  if (!snapshot.blocks.empty() && snapshot.blocks.size() != count) {
    throw Error("positions",
                "there are " + std::to_string(snapshot.blocks.size()) + " blocks of elements, but the object has " +
                    std::to_string(count),
                "use a snapshot of this object");
  }
  for (std::size_t block = 0; block < snapshot.blocks.size(); ++block) {
    const Snapshot::Block& one = snapshot.blocks[block];
    if (one != nullptr && one->size() != coordinates_in(mesh, block)) {
      throw Error("positions", "block " + std::to_string(block) + " has another number of coordinates than the object",
                  "use a snapshot of this object");
    }
    if (one != nullptr && !fits_precision(*one, precision)) {
      refuse_coordinate();
    }
  }
}

namespace {

/// Reads and writes the coordinates that a body stores, element by element.
class SplitPositions {
 public:
  SplitPositions(const Split& split, const Snapshot& positions, Precision precision)
      : split_(split),
        after_mesh_(in_axes(split.after(), positions.axes)),
        after_(*after_mesh_),
        old_(split.old_count()),
        dimension_(std::size_t(after_.space_dimension)),
        precision_(precision),
        result_(positions),
        rows_(split.edit().elements.size() * dimension_) {
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
  for (ElementId i = 0; i < split_.edit().elements.size(); ++i) {
    place(old_ + i, split_.edit().elements[i]);
  }
  for (std::size_t number = old_ / ElementBlocks::block_elements; number < result_.blocks.size(); ++number) {
    result_.blocks[number] = block(number);
  }
  return std::move(result_);
}

/// Finds the old links around new ones that lie inside faces or cells.
class LinksAround {
 public:
  explicit LinksAround(const SplitLinks& links)
      : mesh_(*links.before), after_(*links.after), carriers_(mesh_.element_count()) {
    carriers_.append(links.edit.elements);
    for (const CellId cell : links.edit.removed_cells) {
      if (cell >= mesh_.tetrahedra.size()) {
        const auto& corners = mesh_.hexahedra[cell - mesh_.tetrahedra.size()];
        for_each_pair(corners, [&](ElementId a, ElementId b) { hexahedron_of_.try_emplace(edge_key(a, b), &corners); });
      }
    }
  }

  /// Returns the links between the old elements between which a new link lies. A diagonal of a hexahedron stands for
  /// the edges of the hexahedron.
  std::vector<LinkId> of(LinkId link) const {
    std::vector<LinkId> result;
    const auto add = [&](ElementId a, ElementId b) {
      const auto found = find_link(mesh_, a, b);
      if (found) {
        result.push_back(*found);
      }
      return found.has_value();
    };
    const Carrier carrier = carriers_.of(after_.links[link]);
    for_each_pair(elements_of(carrier), [&](ElementId a, ElementId b) {
      const auto hexahedron = hexahedron_of_.find(edge_key(a, b));
      if (!add(a, b) && hexahedron != hexahedron_of_.end()) {
        for (const auto& [i, j] : hexahedron_edges) {
          add((*hexahedron->second)[std::size_t(i)], (*hexahedron->second)[std::size_t(j)]);
        }
      }
    });
    return result;
  }

 private:
  static void for_each_pair(std::span<const ElementId> elements, const auto& visit) {
    for (std::size_t i = 0; i < elements.size(); ++i) {
      for (std::size_t k = i + 1; k < elements.size(); ++k) {
        visit(elements[i], elements[k]);
      }
    }
  }

  const Mesh &mesh_, &after_;
  Carriers carriers_;
  std::unordered_map<EdgeKey, const std::array<ElementId, 8>*> hexahedron_of_;  // of two of its corners
};

LinkSoftness mean(const Softness& softness, const std::vector<LinkId>& links) {
  LinkSoftness result;
  for (const auto& [parameter, value] : softness_numbers) {
    double sum = 0;
    for (const LinkId link : links) {
      sum += softness.of(link).*value;
    }
    result.*value = sum / double(links.size());
  }
  return result;
}

/// A link on an old one takes its softness. A link inside a face or a cell has the mean of the links at its ends, or of
/// those around it.
std::shared_ptr<const Softness> softness_after(const SplitLinks& links,
                                               const std::shared_ptr<const Softness>& softness) {
  if (softness->links.empty()) {
    return softness;
  }
  Softness result{softness->global, {}, softness->energy, softness->axes};
  const LinksAround around(links);
  for (LinkId link = 0; link < links.parents.size(); ++link) {
    if (const LinkId on = links.parents[link]; on != SplitLinks::none) {
      if (softness->links.contains(on)) {
        result.links.set(link, softness->of(on));
      }
      continue;
    }
    const auto& [a, b] = links.after->links[link];
    std::vector<LinkId> from{links.link_at(a), links.link_at(b)};
    std::erase(from, SplitLinks::none);
    if (from.empty()) {
      from = around.of(link);
    }
    if (std::ranges::any_of(from, [&](LinkId one) { return softness->links.contains(one); })) {
      result.links.set(link, mean(*softness, from));
    }
  }
  return std::make_shared<const Softness>(std::move(result));
}

}  // namespace

ObjectState object_after(const Split& split, const ObjectState& object) {
  const MeshPointer mesh = split.after();  // kept for what follows
  ObjectState result = meshless_after(split, object);
  result.mesh = mesh;
  return result;
}

ObjectState meshless_after(const Split& split, const ObjectState& object) {
  std::vector<ElementId> pins = pins_after(split, object.pins);
  if (object.cuts.empty() && object.softness->links.empty()) {
    return {nullptr, {}, std::move(pins), object.softness};
  }
  const SplitLinks links(split);
  return {nullptr, cuts_after(links, object.cuts), std::move(pins), softness_after(links, object.softness)};
}

Snapshot positions_after(const Split& split, const Snapshot& positions, Precision precision) {
  return SplitPositions(split, positions, precision).snapshot();
}

}  // namespace chainmail
