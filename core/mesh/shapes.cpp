#include "mesh/shapes.h"

#include <array>
#include <bit>
#include <optional>
#include <unordered_map>

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

  /// Most rows are like the row before, so the entry `alike` at the same position of that row is tried first.
  bool add(EntryId entry, ElementId from, std::optional<EntryId> alike) {
    const PointBits bits = bits_of(from, mesh_.neighbours[entry]);
    if (alike && *alike < entry && bits == known_[mesh_.entry_shape[*alike]]) {
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

bool number_all(Mesh& mesh, Shapes& shapes, const Progress& progress) {
  for (ElementId e = 0; e < mesh.element_count(); ++e) {
    progress.report(e, mesh.element_count());
    const EntryId first = mesh.first_entry[e];
    for (EntryId entry = first; entry < mesh.first_entry[e + 1]; ++entry) {
      const std::optional<EntryId> alike =
          e > 0 ? std::optional(mesh.first_entry[e - 1] + (entry - first)) : std::nullopt;
      if (!shapes.add(entry, e, alike)) {
        return false;
      }
    }
  }
  return true;
}

}  // namespace

void number_shapes(Mesh& mesh, const Progress& progress) {
  mesh.entry_shape.resize(mesh.neighbours.size());
  Shapes shapes(mesh);
  if (number_all(mesh, shapes, progress)) {
    shapes.store();
  } else {
    mesh.entry_shape = {};
  }
}

}  // namespace chainmail
