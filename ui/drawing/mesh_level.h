#pragma once

#include <array>
#include <limits>
#include <memory>
#include <span>
#include <vector>

#include "drawing/groups.h"
#include "mesh/cuts.h"

namespace chainmail {

/// A mesh as it is drawn and searched at one level of detail: all of it, or some of its elements, joined by coarse
/// links that each stand for a path of links. Its elements lie in cells, groups that are close together at rest
/// whatever the order of the ids, so that what is out of the way is passed over by the cell.
struct MeshLevel {
  using Link = std::array<ElementId, 2>;
  using Face = std::array<ElementId, 3>;
  static constexpr std::uint32_t none = std::numeric_limits<std::uint32_t>::max();

  MeshPointer mesh;
  unsigned step = 1;            // how many links in a row become one
  std::span<const Link> links;  // the mesh's own at step 1
  std::span<const Face> faces;
  std::vector<ElementId> elements;
  Groups cells;      // of elements
  Groups cellLinks;  // in the cells of their first elements
  Groups cellFaces;
  Groups reached;                           // the cells that a cell's links and faces lead to, itself maybe among them
  std::vector<std::uint32_t> reachedLinks;  // where in cellLinks those to each of them begin, and the end
  Groups cellBlocks;  // the blocks of ids that a cell's elements lie in, as Frame::changed has them

  // Beyond step 1.
  std::vector<Link> coarseLinks;
  std::vector<Face> coarseFaces;
  Groups paths;                                         // the mesh's links that a coarse one stands for
  std::vector<std::array<std::uint32_t, 3>> faceSides;  // the coarse links about a face, or none

  MeshLevel() = default;
  MeshLevel(const MeshLevel&) = delete;  // the spans are of its own vectors
  MeshLevel& operator=(const MeshLevel&) = delete;

  std::size_t cellCount() const { return cells.count(); }
  /// Whether none of the links that this one stands for is cut.
  bool isUncut(std::uint32_t link, const Cuts& cuts) const;
  /// Whether no side of a face is cut.
  bool isWhole(std::uint32_t face, const Cuts& cuts) const;
};

/// Whether no side of a triangle is cut.
bool isWholeFace(const Mesh& mesh, const Cuts& cuts, const MeshLevel::Face& face);

using MeshLevelPointer = std::shared_ptr<const MeshLevel>;

/// Every element, link and face.
MeshLevelPointer wholeLevel(const MeshPointer& mesh);

/// Fills in the cells from the elements, in any order, the links and the faces.
void makeCells(MeshLevel& level);

}  // namespace chainmail
