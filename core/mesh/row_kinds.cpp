#include "mesh/row_kinds.h"

#include <array>
#include <bit>
#include <map>
#include <optional>
#include <unordered_map>
#include <utility>

#include "mesh/large_pages.h"
#include "mesh/mesh.h"

namespace chainmail {
namespace {

/// The bits of a rest vector. Vectors that differ in any bit are different shapes.
using PointBits = std::array<std::uint64_t, 3>;

struct Hash {
  std::size_t operator()(const PointBits& bits) const {
    std::uint64_t hash = 0;
    for (const std::uint64_t word : bits) {
      hash = (hash ^ word) * 0x9e3779b97f4a7c15U;  // the golden ratio's bits (Knuth 1973)
      hash ^= hash >> 32;
    }
    return hash;
  }
};

class Shapes {
 public:
  explicit Shapes(Mesh& mesh) : mesh_(mesh), dimension_(static_cast<std::size_t>(mesh.space_dimension)) {}

  /// Most rows are like the row after, so the entry `alike` at the same position of that row is tried first.
  bool add(EntryId entry, ElementId from, std::optional<EntryId> alike) {
    const PointBits bits = bits_of(from, mesh_.neighbours[entry]);
    if (alike && *alike > entry && bits == known_[mesh_.entry_shape[*alike]]) {
      mesh_.entry_shape[entry] = mesh_.entry_shape[*alike];
      return true;
    }
    const auto [found, is_new] = numbers_.try_emplace(bits, static_cast<std::uint16_t>(known_.size()));
    if (is_new) {
      if (known_.size() == Mesh::shape_limit) {
        return false;
      }
      known_.push_back(bits);
    }
    mesh_.entry_shape[entry] = found->second;
    return true;
  }

  void store() {
    for (const PointBits& bits : known_) {
      for (std::size_t k = 0; k < dimension_; ++k) {
        mesh_.shapes.push_back(std::bit_cast<double>(bits[k]));
      }
    }
  }

 private:
  PointBits bits_of(ElementId from, ElementId to) const {
    PointBits bits{};
    for (std::size_t k = 0; k < dimension_; ++k) {
      bits[k] = std::bit_cast<std::uint64_t>(mesh_.rest[to * dimension_ + k] - mesh_.rest[from * dimension_ + k]);
    }
    return bits;
  }

  Mesh& mesh_;
  std::size_t dimension_;
  std::vector<PointBits> known_;
  std::unordered_map<PointBits, std::uint16_t, Hash> numbers_;
};

/// From the last row: splits append elements, whose rows show soonest that there are too many shapes.
bool number_all(Mesh& mesh, Shapes& shapes, const Progress& progress) {
  const ElementId count = mesh.element_count();
  for (ElementId e = count; e-- > 0;) {
    progress.report(count - e, count);
    const EntryId first = mesh.first_entry[e], end = mesh.first_entry[e + 1];
    for (EntryId entry = first; entry < end; ++entry) {
      const EntryId below = end + (entry - first);
      const std::optional<EntryId> alike =
          e + 1 < count && below < mesh.first_entry[e + 2] ? std::optional(below) : std::nullopt;
      if (!shapes.add(entry, e, alike)) {
        return false;
      }
    }
  }
  return true;
}

}  // namespace

void number_shapes(Mesh& mesh, const Progress& progress) {
  reserve_in_large_pages(mesh.entry_shape, mesh.neighbours.size());
  mesh.entry_shape.resize(mesh.neighbours.size());
  Shapes shapes(mesh);
  if (number_all(mesh, shapes, progress)) {
    shapes.store();
  } else {
    mesh.entry_shape = {};
  }
}

namespace {

class KindFinder {
 public:
  explicit KindFinder(const Mesh& mesh) : mesh_(mesh) { kinds_.first.push_back(0); }

  /// Returns false if there are too many kinds.
  bool add(ElementId element) {
    // In a lattice, most elements are of the same kind as the one before.
    std::size_t kind = kinds_.of.empty() ? kinds_.first.size() : kinds_.of.back();
    if (!is_of(element, kind)) {
      kind = find_or_add(element);
    }
    kinds_.of.push_back(static_cast<std::uint8_t>(kind));
    return kind < RowKinds::limit;
  }

  RowKinds take() { return std::move(kinds_); }

 private:
  using Row = std::vector<std::uint32_t>;  // the offsets, then the shapes

  bool has_shapes() const { return !mesh_.entry_shape.empty(); }

  bool is_of(ElementId element, std::size_t kind) const {
    const auto row = mesh_.neighbours_of(element);
    if (kind + 1 >= kinds_.first.size() || kinds_.first[kind + 1] - kinds_.first[kind] != row.size()) {
      return false;
    }
    const std::size_t at = kinds_.first[kind], first = mesh_.first_entry[element];
    for (std::size_t i = 0; i < row.size(); ++i) {
      if (row[i] - element != kinds_.offset[at + i] ||
          (has_shapes() && mesh_.entry_shape[first + i] != kinds_.shape[at + i])) {
        return false;
      }
    }
    return true;
  }

  /// Returns the number of the kind, or the limit if there are too many.
  std::size_t find_or_add(ElementId element) {
    Row row;
    for (const ElementId neighbour : mesh_.neighbours_of(element)) {
      row.push_back(neighbour - element);
    }
    const std::size_t count = row.size(), first = mesh_.first_entry[element];
    for (std::size_t i = 0; i < count && has_shapes(); ++i) {
      row.push_back(mesh_.entry_shape[first + i]);
    }
    const auto [found, is_new] = numbers_.try_emplace(std::move(row), numbers_.size());
    if (is_new && found->second < RowKinds::limit) {
      const Row& added = found->first;
      kinds_.offset.insert(kinds_.offset.end(), added.begin(), added.begin() + std::ptrdiff_t(count));
      kinds_.shape.insert(kinds_.shape.end(), added.begin() + std::ptrdiff_t(count), added.end());
      kinds_.first.push_back(static_cast<std::uint32_t>(kinds_.offset.size()));
    }
    return found->second;
  }

  const Mesh& mesh_;
  RowKinds kinds_;
  std::map<Row, std::size_t> numbers_;
};

}  // namespace

RowKinds find_row_kinds(const Mesh& mesh, const Progress& progress) {
  KindFinder finder(mesh);
  for (ElementId e = 0; e < mesh.element_count(); ++e) {
    progress.report(e, mesh.element_count());
    if (!finder.add(e)) {
      return {};
    }
  }
  return finder.take();
}

}  // namespace chainmail
