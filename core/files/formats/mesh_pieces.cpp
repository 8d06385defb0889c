#include "files/formats/mesh_pieces.h"

#include <algorithm>
#include <memory>
#include <set>

#include "mesh/surface.h"

namespace chainmail {

MeshPieces::MeshPieces(const Mesh& mesh, const Cuts& cuts, const ListedPieces& listed, const Progress& progress)
    : mesh_(mesh), cuts_(cuts), along_(mesh.link_count(), false) {
  for (std::size_t i = 0; i < mesh.polygons.size(); i += mesh.polygons[i] + 1) {
    polygons_.push_back(i);
  }
  list(Piece::triangle, SIZE_MAX, progress.part(0, 0.2));
  list(Piece::polygon, listed.max_corners, progress.part(0.2, 0.4));
  if (listed.cells) {
    list(Piece::tetrahedron, SIZE_MAX, progress.part(0.4, 0.6));
    list(Piece::hexahedron, SIZE_MAX, progress.part(0.6, 0.8));
  } else if (mesh.has_cells()) {
    find_sides(progress.part(0.4, 0.7));
    list(Piece::side, SIZE_MAX, progress.part(0.7, 0.8));
  }
  list_lines(progress.part(0.8, 1));
}

MeshPieces::Corners MeshPieces::corners(Piece piece, std::size_t index_of_kind) const {
  switch (piece) {
    case Piece::line:
      return mesh_.links[index_of_kind];
    case Piece::triangle:
      return mesh_.triangles[index_of_kind];
    case Piece::tetrahedron:
      return mesh_.tetrahedra[index_of_kind];
    case Piece::hexahedron:
      return mesh_.hexahedra[index_of_kind];
    case Piece::side:
      return sides_[index_of_kind].corners();
    case Piece::polygon:
      break;
  }
  return Corners(mesh_.polygons).subspan(polygons_[index_of_kind] + 1, mesh_.polygons[polygons_[index_of_kind]]);
}

std::size_t MeshPieces::size(Piece piece) const {
  switch (piece) {
    case Piece::line:
      return mesh_.links.size();
    case Piece::triangle:
      return mesh_.own_triangles;
    case Piece::tetrahedron:
      return mesh_.tetrahedra.size();
    case Piece::hexahedron:
      return mesh_.hexahedra.size();
    case Piece::side:
      return sides_.size();
    case Piece::polygon:
      break;
  }
  return polygons_.size();
}

/// Adds the link between two corners to `edges_`. Returns false if there is no such link, or if it is cut.
bool MeshPieces::take_edge(ElementId a, ElementId b) {
  const auto link = find_link(mesh_, a, b);
  if (!link || cuts_.is_cut(*link)) {
    return false;
  }
  edges_.push_back(*link);
  return true;
}

/// Returns true if all edges of a piece are uncut links, and marks them.
bool MeshPieces::take(Piece piece, Corners corners) {
  const auto edge = [&](const CellEdge& ends) { return take_edge(corners[ends[0]], corners[ends[1]]); };
  edges_.clear();
  bool whole = true;
  if (piece == Piece::tetrahedron) {
    whole = std::all_of(tetrahedron_edges.begin(), tetrahedron_edges.end(), edge);
  } else if (piece == Piece::hexahedron) {
    whole = std::all_of(hexahedron_edges.begin(), hexahedron_edges.end(), edge);
  } else {
    for (std::size_t i = 0; whole && i < corners.size(); ++i) {
      whole = take_edge(corners[i], corners[(i + 1) % corners.size()]);
    }
  }
  for (std::size_t i = 0; whole && i < edges_.size(); ++i) {
    along_[edges_[i]] = true;
  }
  return whole;
}

void MeshPieces::list(Piece piece, std::size_t max_corners, const Progress& progress) {
  const std::size_t size_of_kind = size(piece);
  std::vector<bool>& listed = listed_[index(piece)];
  listed.resize(size_of_kind);
  for (std::size_t i = 0; i < size_of_kind; ++i) {
    progress.report(i, size_of_kind);
    const Corners of_piece = corners(piece, i);
    if (of_piece.size() <= max_corners && take(piece, of_piece)) {
      listed[i] = true;
      ++counts_[index(piece)];
      corner_counts_[index(piece)] += of_piece.size();
    }
  }
}

void MeshPieces::find_sides(const Progress& progress) {
  const auto table = std::make_shared<const CellTable>(MeshPointer(MeshPointer(), &mesh_), progress);
  const Surface surface(table, cuts_);
  std::set<std::vector<ElementId>> faces;  // corners in ascending order
  const auto ascending = [](Corners corners) {
    std::vector<ElementId> sorted(corners.begin(), corners.end());
    std::sort(sorted.begin(), sorted.end());
    return sorted;
  };
  for (const Piece face : {Piece::triangle, Piece::polygon}) {
    for (std::size_t i = 0; i < size(face); ++i) {
      faces.insert(ascending(corners(face, i)));
    }
  }
  std::vector<SideId> order(surface.sides().begin(), surface.sides().end());
  std::sort(order.begin(), order.end());
  for (const SideId id : order) {
    if (const Side side = table->side(id); !faces.contains(ascending(side.corners()))) {
      sides_.push_back(side);
    }
  }
}

void MeshPieces::list_lines(const Progress& progress) {
  std::vector<bool>& listed = listed_[index(Piece::line)];
  listed.resize(mesh_.link_count());
  std::uint32_t& count = counts_[index(Piece::line)];
  for (LinkId link = 0; link < mesh_.link_count(); ++link) {
    progress.report(link, mesh_.link_count());
    listed[link] = !along_[link] && !cuts_.is_cut(link);
    count += listed[link] ? 1 : 0;
  }
  corner_counts_[index(Piece::line)] = 2 * std::uint64_t{count};
}

}  // namespace chainmail
