#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "mesh/cuts.h"
#include "mesh/mesh.h"
#include "mesh/progress.h"

namespace chainmail {

/// What files of meshes list; a line is a link along no other piece.
enum class Piece { line, triangle, polygon, tetrahedron, hexahedron };

/// What a format can list: a piece that it cannot is told by its links.
struct ListedPieces {
  bool cells = true;
  std::size_t most_corners = SIZE_MAX;  // of a polygon
};

/// What a file of an object lists: the faces and cells all of whose edges are links that are not cut (read again, a
/// face or cell brings its links back), and the other uncut links as lines.
class MeshPieces {
 public:
  using Corners = std::span<const ElementId>;

  /// Time: a search for the link of each edge. Throws Cancelled.
  MeshPieces(const Mesh& mesh, const Cuts& cuts, const ListedPieces& listed, const Progress& progress);

  std::uint32_t count(Piece piece) const { return counts_[index(piece)]; }
  /// The corners of all pieces of a kind.
  std::uint64_t corner_count(Piece piece) const { return corner_counts_[index(piece)]; }
  /// Calls visit(corners) for each piece of a kind, in the mesh's order.
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

  Corners corners(Piece piece, std::size_t place) const;
  std::size_t size(Piece piece) const;
  bool take_edge(ElementId a, ElementId b);
  bool take(Piece piece, Corners corners);
  void list(Piece piece, std::size_t most_corners, const Progress& progress);
  void list_lines(const Progress& progress);

  const Mesh& mesh_;
  const Cuts& cuts_;
  std::vector<std::size_t> polygons_;  // where each begins
  std::array<std::vector<bool>, 5> listed_;
  std::array<std::uint32_t, 5> counts_{};
  std::array<std::uint64_t, 5> corner_counts_{};
  std::vector<LinkId> edges_;  // of the piece that is looked at
  std::vector<bool> along_;    // links along a piece that is listed
};

}  // namespace chainmail
