#include "mesh/separate_cells.h"

#include <algorithm>
#include <map>
#include <optional>
#include <set>
#include <span>
#include <unordered_map>

#include "mesh/disjoint_sets.h"
#include "mesh/separate.h"

namespace chainmail {
namespace {

using Triangle = std::array<ElementId, 3>;

/// Separates the pieces of cells: a face is cut if all its corners are on the blade and its two pieces on different
/// sides of it. Elements are doubled where the pieces around them fall apart without a cut face; so the cut ends by
/// itself where the blade ends.
class CellSeparation {
 public:
  CellSeparation(const Mesh& mesh, CellsInPieces& divided)
      : mesh_(mesh),
        old_(mesh.element_count()),
        tetrahedra_(divided.tetrahedra),
        pieces_(divided.cells),
        faces_of_mesh_(divided.faces),
        is_on_blade_(divided.is_on_blade) {
    edit_.elements = std::move(divided.points);
  }

  SplitEdit run();

 private:
  enum class PieceSide : std::uint8_t { near, beyond, none };
  struct PieceFace {
    Triangle corner;  // ascending
    std::uint32_t piece;

    auto operator<=>(const PieceFace&) const = default;
  };
  /// A face between two pieces.
  struct Interface {
    Triangle corner;
    std::array<std::uint32_t, 2> piece;
  };

  bool is_on_blade(ElementId element) const { return element >= old_ || is_on_blade_[element] != 0; }
  const NearTetrahedron& tetrahedron(std::uint32_t piece) const { return tetrahedra_[pieces_[piece].of]; }
  bool is_beyond(std::uint32_t piece, ElementId corner) const {
    const NearTetrahedron& one = tetrahedron(piece);
    return one.is_beyond[std::size_t(std::ranges::find(one.corner, corner) - one.corner.begin())];
  }
  std::size_t node(std::uint32_t piece, ElementId corner) const {
    const auto& all = pieces_[piece].corner;
    return 4 * std::size_t{piece} + std::size_t(std::ranges::find(all, corner) - all.begin());
  }
  void list_faces();
  void find_sides();
  void take_sides_of_neighbours();
  bool take_side(std::uint32_t piece, std::uint32_t from, ElementId corner);
  bool is_cut(const Interface& one) const;
  void make_copies();
  ElementId separated(std::uint32_t piece, ElementId corner) const {
    const std::size_t at = node(piece, corner);
    return separated_[at / 4][at % 4];
  }
  void find_half_open();
  void note_side(std::uint32_t piece, const Triangle& corner, bool open);
  void write_cells();
  void write_faces();

  const Mesh& mesh_;
  ElementId old_;
  const std::vector<NearTetrahedron>& tetrahedra_;
  const std::vector<SimplexPiece<4>>& pieces_;
  std::vector<SimplexPiece<3>>& faces_of_mesh_;
  const std::vector<std::uint8_t>& is_on_blade_;
  std::vector<PieceFace> faces_;  // of pieces, with a corner on the blade; ascending
  std::vector<Interface> interfaces_;
  std::vector<PieceSide> sides_;                             // of each piece
  std::vector<std::array<ElementId, 4>> separated_;          // corners of each piece, with copies
  std::map<std::array<std::size_t, 2>, bool> side_is_open_;  // by hexahedron and number of its side
  std::set<CellId> half_open_;                               // hexahedra with a side of which only one half is open
  SplitEdit edit_;
};

/// Lists the faces of pieces with a corner on the blade, and those that two pieces share.
void CellSeparation::list_faces() {
  for (std::uint32_t piece = 0; piece < pieces_.size(); ++piece) {
    for (const auto& [i, j, k] : tetrahedron_sides) {
      const auto& corner = pieces_[piece].corner;
      Triangle face{corner[std::size_t(i)], corner[std::size_t(j)], corner[std::size_t(k)]};
      if (std::ranges::any_of(face, [this](ElementId one) { return is_on_blade(one); })) {
        std::ranges::sort(face);
        faces_.push_back({face, piece});
      }
    }
  }
  std::ranges::sort(faces_);
  for (std::size_t i = 0; i + 1 < faces_.size(); ++i) {
    if (faces_[i].corner == faces_[i + 1].corner) {
      interfaces_.push_back({faces_[i].corner, {faces_[i].piece, faces_[i + 1].piece}});
      ++i;
    }
  }
}

/// All corners of a piece that are not on the blade are on the same side of it.
void CellSeparation::find_sides() {
  for (std::uint32_t piece = 0; piece < pieces_.size(); ++piece) {
    PieceSide side = PieceSide::none;
    for (const ElementId corner : pieces_[piece].corner) {
      if (tetrahedron(piece).has_sides && !is_on_blade(corner)) {
        side = is_beyond(piece, corner) ? PieceSide::beyond : PieceSide::near;
      }
    }
    sides_.push_back(side);
  }
}

/// Tetrahedra with all corners on the blade belong to the side of a neighbour, so that they do not come off alone.
void CellSeparation::take_sides_of_neighbours() {
  std::unordered_map<std::uint32_t, std::vector<const Interface*>> open;  // by piece
  std::vector<std::uint32_t> todo;                                        // pieces whose neighbours may take their side
  for (const Interface& one : interfaces_) {
    for (std::size_t i = 0; i < 2; ++i) {
      if (sides_[one.piece[1 - i]] == PieceSide::none) {
        open[one.piece[i]].push_back(&one);
        if (sides_[one.piece[i]] != PieceSide::none) {
          todo.push_back(one.piece[i]);
        }
      }
    }
  }
  for (std::size_t next = 0; next < todo.size(); ++next) {
    const std::uint32_t from = todo[next];
    for (const Interface* one : open[from]) {
      const std::uint32_t piece = one->piece[0] == from ? one->piece[1] : one->piece[0];
      if (take_side(piece, from, one->corner[0])) {
        todo.push_back(piece);
      }
    }
  }
}

bool CellSeparation::take_side(std::uint32_t piece, std::uint32_t from, ElementId corner) {
  if (sides_[piece] != PieceSide::none || sides_[from] == PieceSide::none || !tetrahedron(piece).has_sides) {
    return false;
  }
  const bool is_other = (sides_[from] == PieceSide::beyond) != is_beyond(from, corner);
  sides_[piece] = is_other != is_beyond(piece, corner) ? PieceSide::beyond : PieceSide::near;
  return true;
}

bool CellSeparation::is_cut(const Interface& one) const {
  const auto [first, second] = one.piece;
  if (sides_[first] == PieceSide::none || sides_[second] == PieceSide::none ||
      !std::ranges::all_of(one.corner, [this](ElementId corner) { return is_on_blade(corner); })) {
    return false;
  }
  if (pieces_[first].of == pieces_[second].of) {
    return sides_[first] != sides_[second];
  }
  // All corners of this face are of the mesh. Each tetrahedron counts sides from its own first corner.
  const ElementId at = one.corner[0];
  return at < old_ && (sides_[first] != sides_[second]) != (is_beyond(first, at) != is_beyond(second, at));
}

/// Joins corners of pieces across faces that are not cut. Of those that were together before, one set keeps the
/// element; each other gets a copy.
void CellSeparation::make_copies() {
  DisjointSets before(4 * pieces_.size()), after(4 * pieces_.size());
  for (const Interface& one : interfaces_) {
    const bool cut = is_cut(one);
    for (const ElementId corner : one.corner) {
      const std::size_t first = node(one.piece[0], corner), second = node(one.piece[1], corner);
      before.unite(first, second);
      if (!cut) {
        after.unite(first, second);
      }
    }
  }
  std::unordered_map<std::size_t, ElementId> copies;
  for (std::uint32_t piece = 0; piece < pieces_.size(); ++piece) {
    separated_.push_back(pieces_[piece].corner);
    for (std::size_t i = 0; i < 4; ++i) {
      if (const std::size_t one = after.of(4 * piece + i); one != before.of(one)) {
        const auto next = static_cast<ElementId>(old_ + edit_.elements.size());
        const auto [copy, is_new] = copies.try_emplace(one, next);
        if (is_new) {
          edit_.elements.push_back(SplitPoint::copy(separated_.back()[i]));
        }
        separated_.back()[i] = copy->second;
      }
    }
  }
}

/// Finds hexahedra that cannot stay, because only a half of a side has come apart. A cut face has come apart if one of
/// its corners is doubled.
void CellSeparation::find_half_open() {
  for (const auto& [corner, piece] : interfaces_) {
    bool open = false;
    for (const ElementId one : corner) {
      open = open || separated(piece[0], one) != separated(piece[1], one);
    }
    note_side(piece[0], corner, open);
    note_side(piece[1], corner, open);
  }
}

void CellSeparation::note_side(std::uint32_t piece, const Triangle& corner, bool open) {
  const CellId cell = tetrahedron(piece).cell;
  if (cell < mesh_.tetrahedra.size()) {
    return;
  }
  const auto& corners = mesh_.hexahedra[cell - mesh_.tetrahedra.size()];
  for (std::size_t i = 0; i < hexahedron_sides.size(); ++i) {
    const auto is_on = [&](ElementId one) {
      return std::ranges::any_of(hexahedron_sides[i], [&](int at) { return corners[std::size_t(at)] == one; });
    };
    if (std::ranges::all_of(corner, is_on) && side_is_open_.try_emplace({cell, i}, open).first->second != open) {
      half_open_.insert(cell);
    }
  }
}

/// Returns the corners of a cell or a face with their copies, if it has stayed whole. `before` and `after` are the
/// corners of its pieces.
template <class Corners, class Before, class After>
std::optional<Corners> separated_whole(const Corners& corners, const Before& before, const After& after) {
  Corners result = corners;
  std::ranges::fill(result, no_element);
  for (std::size_t i = 0; i < before.size(); ++i) {
    for (std::size_t k = 0; k < before[i].corner.size(); ++k) {
      const auto found = std::ranges::find(corners, before[i].corner[k]) - corners.begin();
      if (std::size_t(found) == corners.size() ||
          (result[std::size_t(found)] != no_element && result[std::size_t(found)] != after[i][k])) {
        return std::nullopt;
      }
      result[std::size_t(found)] = after[i][k];
    }
  }
  return result;
}

/// Replaces the cells that are divided or have copies as corners.
void CellSeparation::write_cells() {
  const auto write = [this](CellId cell, const auto& corners, auto& all, std::size_t first, std::size_t end) {
    const auto after = std::span(separated_).subspan(first, end - first);
    const auto whole = separated_whole(corners, std::span(pieces_).subspan(first, end - first), after);
    const bool stays = whole && !half_open_.contains(cell);
    if (stays && *whole == corners) {
      return;
    }
    edit_.removed_cells.push_back(cell);
    if (stays) {
      all.push_back(*whole);
    } else {
      edit_.tetrahedra.insert(edit_.tetrahedra.end(), after.begin(), after.end());
    }
  };
  const std::size_t tetrahedra = mesh_.tetrahedra.size();
  for (std::size_t first = 0, end = 0; first < pieces_.size(); first = end) {
    const CellId cell = tetrahedron(std::uint32_t(first)).cell;
    while (end < pieces_.size() && tetrahedron(std::uint32_t(end)).cell == cell) {
      ++end;
    }
    if (cell < tetrahedra) {
      write(cell, mesh_.tetrahedra[cell], edit_.tetrahedra, first, end);
    } else {
      write(cell, mesh_.hexahedra[cell - tetrahedra], edit_.hexahedra, first, end);
    }
  }
}

/// Replaces the faces that are divided or whose cell has copies as corners.
void CellSeparation::write_faces() {
  std::vector<Triangle> after;
  for (const auto& piece : faces_of_mesh_) {
    after.push_back(piece.corner);
    Triangle key = piece.corner;
    std::ranges::sort(key);
    const auto found = std::ranges::lower_bound(faces_, key, {}, &PieceFace::corner);
    for (std::size_t i = 0; i < 3 && found != faces_.end() && found->corner == key; ++i) {
      after.back()[i] = separated(found->piece, piece.corner[i]);
    }
  }
  const Faces faces(mesh_);
  for (std::size_t first = 0, end = 0; first < after.size(); first = end) {
    const std::uint32_t face = faces_of_mesh_[first].of;
    while (end < after.size() && faces_of_mesh_[end].of == face) {
      ++end;
    }
    const Ring ring(faces[face].begin(), faces[face].end());
    const auto pieces = std::span(after).subspan(first, end - first);
    const auto whole = separated_whole(ring, std::span(faces_of_mesh_).subspan(first, end - first), pieces);
    if (whole == ring) {
      continue;
    }
    (faces.is_polygon(face) ? edit_.removed_polygons : edit_.removed)
        .push_back(faces.is_polygon(face) ? faces.polygon(face) : face);
    if (whole && faces.is_polygon(face)) {
      edit_.polygons.push_back(static_cast<ElementId>(whole->size()));
      edit_.polygons.insert(edit_.polygons.end(), whole->begin(), whole->end());
    } else {
      edit_.triangles.insert(edit_.triangles.end(), pieces.begin(), pieces.end());
    }
  }
}

SplitEdit CellSeparation::run() {
  const std::size_t points = edit_.elements.size();
  list_faces();
  find_sides();
  take_sides_of_neighbours();
  make_copies();
  if (edit_.elements.size() == points) {
    return {};
  }
  find_half_open();
  write_cells();
  write_faces();
  return std::move(edit_);
}

}  // namespace

SplitEdit separate(const Mesh& mesh, CellsInPieces divided) { return CellSeparation(mesh, divided).run(); }

}  // namespace chainmail
