#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "mesh/cells.h"
#include "mesh/cuts.h"
#include "mesh/mesh.h"
#include "mesh/progress.h"

namespace chainmail {

/// The kinds of pieces in mesh files. A line is a link that is not an edge of another listed piece. A side is one of
/// the outer surface of the cells (see Surface) that is no face of the mesh.
enum class Piece { line, triangle, polygon, tetrahedron, hexahedron, side };

/// The pieces that a format can list. Other pieces are written as lines.
struct ListedPieces {
  bool cells = true;                   // otherwise the sides of cells
  std::size_t max_corners = SIZE_MAX;  // largest number of corners of a polygon
};

/// The pieces to write for an object: faces and cells whose edges are all uncut links, and the other uncut links as
/// lines. A reader that adds links along all edges gets exactly the uncut links back.
class MeshPieces {
 public:
  using Corners = std::span<const ElementId>;

  /// Collects the pieces. It searches for the link of each edge. Throws Cancelled.
  MeshPieces(const Mesh& mesh, const Cuts& cuts, const ListedPieces& listed, const Progress& progress);

  std::uint32_t count(Piece piece) const { return counts_[index(piece)]; }
  /// Returns the number of corners of all pieces of a kind.
  std::uint64_t corner_count(Piece piece) const { return corner_counts_[index(piece)]; }
  /// Calls visit(corners) for each listed piece of a kind, in the order of the mesh.
  template <class Visit>
  void for_each(Piece piece, Visit visit, const Progress& progress) const {
    const std::vector<bool>& listed = listed_[index(piece)];
    for (std::size_t i = 0; i < listed.size(); ++i) {
      progress.report(i, listed.size());
      if (listed[i]) {
        visit(corners(piece, i));
      }
    }
  }

 private:
  static std::size_t index(Piece piece) { return static_cast<std::size_t>(piece); }

  Corners corners(Piece piece, std::size_t index_of_kind) const;
  std::size_t size(Piece piece) const;
  bool take_edge(ElementId a, ElementId b);
  bool take(Piece piece, Corners corners);
  void list(Piece piece, std::size_t max_corners, const Progress& progress);
  void list_lines(const Progress& progress);
  void find_sides(const Progress& progress);

  const Mesh& mesh_;
  const Cuts& cuts_;
  std::vector<std::size_t> polygons_;  // index at which each polygon begins
  std::vector<Side> sides_;
  std::array<std::vector<bool>, 6> listed_;
  std::array<std::uint32_t, 6> counts_{};
  std::array<std::uint64_t, 6> corner_counts_{};
  std::vector<LinkId> edges_;  // links along the edges of the current piece
  std::vector<bool> along_;    // true for links that are edges of a listed piece
};

}  // namespace chainmail
