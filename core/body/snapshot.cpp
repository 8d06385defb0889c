#include "body/snapshot.h"

#include <algorithm>
#include <cmath>
#include <string>

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

}  // namespace chainmail
