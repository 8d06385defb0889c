#include "solve/original.h"

#include <algorithm>

namespace chainmail {
namespace {

/// How many steps along the lattice's axes lie between two elements.
std::uint64_t steps_between(const Lattice& lattice, ElementId a, ElementId b) {
  std::uint64_t steps = 0;
  for (const std::uint32_t size : lattice.size) {
    steps += static_cast<std::uint64_t>(std::abs(std::int64_t{a % size} - std::int64_t{b % size}));
    a /= size;
    b /= size;
  }
  return steps;
}

}  // namespace

bool is_grid(const Mesh& mesh) {
  return mesh.lattice && std::all_of(mesh.links.begin(), mesh.links.end(), [&](const auto& link) {
           return steps_between(*mesh.lattice, link[0], link[1]) == 1;
         });
}

}  // namespace chainmail
