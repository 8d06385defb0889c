#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <memory>
#include <span>
#include <vector>

#include "mesh/cuts.h"

namespace chainmail {

/// Numbers in groups, stored one group after the other.
struct Groups {
  std::vector<std::uint32_t> first{0};  // index of the first item of each group, and the end
  std::vector<std::uint32_t> items;

  std::size_t count() const { return first.size() - 1; }
  std::span<const std::uint32_t> operator[](std::size_t group) const {
    return std::span(items).subspan(first[group], first[group + 1] - first[group]);
  }
  /// Ends the current group after its items were appended.
  void close() { first.push_back(std::uint32_t(items.size())); }
};

/// Returns the numbers 0 … size − 1 in the groups that groupOf returns, ascending within each.
template <class GroupOf>
Groups grouped(std::size_t groups, std::size_t size, GroupOf groupOf) {
  Groups result;
  result.first.assign(groups + 1, 0);
  result.items.resize(size);
  for (std::uint32_t i = 0; i < size; ++i) {
    ++result.first[groupOf(i) + 1];
  }
  for (std::size_t group = 0; group < groups; ++group) {
    result.first[group + 1] += result.first[group];
  }
  std::vector<std::uint32_t> next(result.first.begin(), result.first.end() - 1);
  for (std::uint32_t i = 0; i < size; ++i) {
    result.items[next[groupOf(i)]++] = i;
  }
  return result;
}

/// One level of detail of a mesh, for drawing and searching: the whole mesh, or some of its elements joined by coarse
/// links, each of which replaces a path of links. Groups of elements that are close together at rest form clusters, so
/// that a search can skip them together.
struct MeshLevel {
  using Link = std::array<ElementId, 2>;
  using Face = std::array<ElementId, 3>;
  static constexpr std::uint32_t none = std::numeric_limits<std::uint32_t>::max();

  MeshPointer mesh;
  unsigned step = 1;            // number of links in a row that become one
  std::span<const Link> links;  // the mesh's own at step 1
  std::span<const Face> faces;
  std::vector<ElementId> elements;
  Groups clusters;      // of elements
  Groups clusterLinks;  // each link is in the cluster of its first element
  Groups clusterFaces;
  Groups reached;  // the clusters that a cluster's links and faces lead to; may include the cluster itself
  std::vector<std::uint32_t> reachedLinks;  // index in clusterLinks of the first link to each reached cluster
  Groups clusterBlocks;                     // the blocks of Frame::changed that contain a cluster's elements

  // Only for steps above 1.
  std::vector<Link> coarseLinks;
  std::vector<Face> coarseFaces;
  Groups paths;                                         // the links of the mesh that a coarse link replaces
  std::vector<std::array<std::uint32_t, 3>> faceSides;  // the coarse links around a face, or none

  MeshLevel() = default;
  MeshLevel(const MeshLevel&) = delete;  // the spans refer to the level's own vectors
  MeshLevel& operator=(const MeshLevel&) = delete;

  std::size_t clusterCount() const { return clusters.count(); }
  /// True if none of the links that this link replaces is cut.
  bool isUncut(std::uint32_t link, const Cuts& cuts) const;
  /// True if no side of a face is cut.
  bool isWhole(std::uint32_t face, const Cuts& cuts) const;
};

/// True if no side of a triangle is cut.
bool isWholeFace(const Mesh& mesh, const Cuts& cuts, const MeshLevel::Face& face);

using MeshLevelPointer = std::shared_ptr<const MeshLevel>;

/// Returns the level with every element, link and face.
MeshLevelPointer wholeLevel(const MeshPointer& mesh);

/// Computes the clusters of a level from its elements (in any order), links and faces.
void makeClusters(MeshLevel& level);

/// Returns a level of a lattice mesh: every `step`-th row and the last row along each axis.
MeshLevelPointer coarseLattice(const MeshPointer& mesh, unsigned step);

/// Returns the next coarser level of any mesh. Its elements are elements of `finer` that are not linked to each other;
/// each represents its neighbours. Its step is twice that of `finer`, because its links are slightly more than two
/// links of `finer` long.
MeshLevelPointer coarser(const MeshLevel& finer);

}  // namespace chainmail
