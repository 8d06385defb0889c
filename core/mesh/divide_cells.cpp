// The order of this file: which cells the stroke may cross, where it crosses edges, which elements are on the blade,
// dividing. separate_cells.h then separates the cells.

#include "mesh/divide_cells.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <set>
#include <unordered_map>
#include <unordered_set>

#include "mesh/separate.h"
#include "mesh/separate_cells.h"

namespace chainmail {
namespace {

/// Squares of the view, to find boxes that have a part of the stroke: a table of sums (Crow 1984).
class StrokeRaster {
 public:
  struct Square {
    std::uint16_t x = 0, y = 0;
  };

  explicit StrokeRaster(const StrokeInView& stroke)
      : low_(stroke.low()), scale_((count - 3) / (stroke.high() - stroke.low()).maxCoeff()), sums_(width * width) {
    const auto points = stroke.points();
    for (std::size_t i = 0; i + 1 < points.size(); ++i) {
      mark(scaled(points[i]), scaled(points[i + 1]));
    }
    for (std::size_t y = 1; y < width; ++y) {
      for (std::size_t x = 1; x < width; ++x) {
        at(x, y) += at(x - 1, y) + at(x, y - 1) - at(x - 1, y - 1);
      }
    }
  }

  /// Returns the square of a position. Positions outside the box of the stroke are in the outermost squares.
  Square square(const Eigen::Vector2d& position) const { return square_at(scaled(position)); }
  /// True if a part of the stroke is in a box.
  bool has_stroke(Square low, Square high) const {
    return at(high.x, high.y) + at(low.x - 1U, low.y - 1U) != at(low.x - 1U, high.y) + at(high.x, low.y - 1U);
  }

 private:
  static constexpr std::size_t count = 256;        // along an axis; the outermost are outside the box of the stroke
  static constexpr std::size_t width = count + 1;  // with a first row and column of zeros

  std::uint32_t& at(std::size_t x, std::size_t y) { return sums_[width * y + x]; }
  std::uint32_t at(std::size_t x, std::size_t y) const { return sums_[width * y + x]; }
  /// NaN counts as the first square.
  static Square square_at(const Eigen::Vector2d& scaled) {
    const auto index = [](double one) { return std::uint16_t(one > 0 ? std::min(one, count - 1.0) + 1 : 1); };
    return {index(scaled.x()), index(scaled.y())};
  }
  Eigen::Vector2d scaled(const Eigen::Vector2d& position) const {
    constexpr double margin = 1.5;
    return (position - low_) * scale_ + Eigen::Vector2d::Constant(margin);
  }
  void mark(const Eigen::Vector2d& from, const Eigen::Vector2d& to);

  Eigen::Vector2d low_;
  double scale_;
  std::vector<std::uint32_t> sums_;
};

/// Marks the squares of a segment, in steps of at most one square.
void StrokeRaster::mark(const Eigen::Vector2d& from, const Eigen::Vector2d& to) {
  constexpr double rounding = 1e-6;
  // Never more than there are squares along an axis, also if the stroke is not finite: min() takes its first value
  // then.
  const auto steps = static_cast<int>(std::min(count + 1.0, std::ceil((to - from).cwiseAbs().maxCoeff()) + 1));
  const Eigen::Vector2d step = (to - from) / steps;
  for (int i = 0; i < steps; ++i) {
    const Eigen::Vector2d a = from + i * step, b = from + (i + 1) * step;
    const Square low = square_at(a.cwiseMin(b).array() - rounding), high = square_at(a.cwiseMax(b).array() + rounding);
    for (std::size_t y = low.y; y <= high.y; ++y) {
      for (std::size_t x = low.x; x <= high.x; ++x) {
        at(x, y) = 1;
      }
    }
  }
}

/// An edge that the stroke crosses an odd number of times.
struct CrossedEdge {
  EdgeKey key = 0;
  double share = 0;   // of the crossing in the middle
  double length = 0;  // squared
  bool has_sides = false;
  ElementId point = no_element;  // the new element on it
};

/// Divides the cells of a mesh along a stroke.
class CellDivider {
 public:
  CellDivider(const Mesh& mesh, const StrokeInView& stroke)
      : mesh_(mesh), stroke_(stroke), is_on_blade_(mesh.element_count()) {}

  /// The blade then crosses only cells with one of these links.
  void limit_to(std::span<const LinkId> reached);
  CellsInPieces run();

 private:
  static constexpr std::uint32_t none = std::numeric_limits<std::uint32_t>::max();
  struct Crossed {
    NearTetrahedron tetrahedron;
    std::array<std::uint32_t, 6> edge{};  // that is crossed, in the order of tetrahedron_edges
  };

  std::vector<CellId> cells_at_stroke() const;
  void for_each_part(CellId cell, const auto& visit) const;
  void find_crossed();
  bool is_reached(CellId cell) const;
  void find_edges(const std::array<ElementId, 4>& corner);
  void add_if_crossed(CellId cell, const std::array<ElementId, 4>& corner);
  std::uint32_t edge_between(ElementId a, ElementId b) const;
  void find_sides(Crossed& one);

  void snap();
  void keep_quality();
  void improve(const Crossed& one, std::vector<ElementId>& snapped);
  double worst_quality(const Crossed& one) const;

  bool is_divided(std::uint32_t edge) const {
    if (edge == none || !edges_[edge].has_sides) {
      return false;
    }
    const auto [a, b] = ends_of(edges_[edge].key);
    return is_on_blade_[a] == 0 && is_on_blade_[b] == 0;
  }
  bool is_divided(const Crossed& one) const {
    return std::ranges::any_of(one.edge, [this](std::uint32_t edge) { return is_divided(edge); });
  }
  template <std::size_t Corners, class Edges>
  std::vector<std::array<ElementId, Corners>> bisected(const std::array<ElementId, Corners>& corner,
                                                       const Edges& edges) const;
  /// Position at rest of an element, or of the new one on an edge before it has an id.
  Point place(ElementId element) const;

  void add_points(CellsInPieces& result);
  std::vector<std::uint8_t> find_near() const;
  void add_cells(CellsInPieces& result) const;
  void add_faces(CellsInPieces& result) const;
  template <class Corners>
  bool is_near(const Corners& corners) const {
    return std::ranges::any_of(corners, [this](ElementId corner) { return is_near_[corner] != 0; });
  }

  const Mesh& mesh_;
  const StrokeInView& stroke_;
  std::vector<std::uint8_t> is_on_blade_, is_near_;  // of each element
  std::optional<std::unordered_set<EdgeKey>> reached_;
  std::unordered_map<EdgeKey, std::uint32_t> edge_of_;
  std::vector<CrossedEdge> edges_;
  std::vector<Crossed> crossed_;  // ascending by cell
};

/// Returns the cells that may have an edge that the stroke crosses.
std::vector<CellId> CellDivider::cells_at_stroke() const {
  const StrokeRaster raster(stroke_);
  std::vector<StrokeRaster::Square> squares;
  squares.reserve(mesh_.element_count());
  for (ElementId e = 0; e < mesh_.element_count(); ++e) {
    squares.push_back(raster.square(stroke_.place(e).at));
  }
  std::vector<CellId> result;
  const auto add = [&](const auto& cells, std::size_t first) {
    for (const auto& corners : cells) {
      StrokeRaster::Square low = squares[corners[0]], high = low;
      for (const ElementId corner : corners) {
        const auto [x, y] = squares[corner];
        low = {std::min(low.x, x), std::min(low.y, y)};
        high = {std::max(high.x, x), std::max(high.y, y)};
      }
      if (raster.has_stroke(low, high)) {
        result.push_back(static_cast<CellId>(first + std::size_t(&corners - cells.data())));
      }
    }
  };
  add(mesh_.tetrahedra, 0);
  add(mesh_.hexahedra, mesh_.tetrahedra.size());
  return result;
}

/// Calls visit(corners) for a tetrahedron, or for the six of a hexahedron.
void CellDivider::for_each_part(CellId cell, const auto& visit) const {
  if (cell < mesh_.tetrahedra.size()) {
    visit(mesh_.tetrahedra[cell]);
  } else {
    for_each_tetrahedron(mesh_, mesh_.hexahedra[cell - mesh_.tetrahedra.size()], visit);
  }
}

/// Finds the edges that the stroke crosses, and the tetrahedra that have them.
void CellDivider::find_crossed() {
  const std::vector<CellId> cells = cells_at_stroke();
  for (const CellId cell : cells) {
    if (is_reached(cell)) {
      for_each_part(cell, [&](const auto& corner) { find_edges(corner); });
    }
  }
  for (const CellId cell : cells) {
    for_each_part(cell, [&](const auto& corner) { add_if_crossed(cell, corner); });
  }
}

bool CellDivider::is_reached(CellId cell) const {
  bool result = !reached_;
  for_each_part(cell, [&](const auto& corner) {
    for (const auto& [a, b] : tetrahedron_edges) {
      result = result || reached_->contains(edge_key(corner[std::size_t(a)], corner[std::size_t(b)]));
    }
  });
  return result;
}

void CellDivider::find_edges(const std::array<ElementId, 4>& corner) {
  for (const auto& [i, j] : tetrahedron_edges) {
    const ElementId a = corner[std::size_t(i)], b = corner[std::size_t(j)];
    const auto [found, is_new] = edge_of_.try_emplace(edge_key(a, b), none);
    if (is_new && stroke_.place(a).distance > 0 && stroke_.place(b).distance > 0) {
      auto crossings = stroke_.crossings(a, b);
      if (crossings.size() % 2 == 1) {
        std::ranges::sort(crossings, {}, &Crossing::share);
        found->second = static_cast<std::uint32_t>(edges_.size());
        const double length = (mesh_.rest_position(std::max(a, b)) - mesh_.rest_position(std::min(a, b))).squaredNorm();
        edges_.push_back({edge_key(a, b), crossings[crossings.size() / 2].share, length});
      }
    }
  }
}

void CellDivider::add_if_crossed(CellId cell, const std::array<ElementId, 4>& corner) {
  Crossed one{{cell, corner}, {}};
  for (std::size_t i = 0; i < one.edge.size(); ++i) {
    const auto [a, b] = tetrahedron_edges[i];
    one.edge[i] = edge_between(corner[std::size_t(a)], corner[std::size_t(b)]);
  }
  if (std::ranges::any_of(one.edge, [](std::uint32_t edge) { return edge != none; })) {
    find_sides(one);
    crossed_.push_back(one);
  }
}

/// Returns the index of an edge, or none if the stroke does not cross it.
std::uint32_t CellDivider::edge_between(ElementId a, ElementId b) const {
  const auto found = edge_of_.find(edge_key(a, b));
  return found == edge_of_.end() ? none : found->second;
}

/// A tetrahedron has two sides if the stroke crosses each of its faces an even number of times.
void CellDivider::find_sides(Crossed& one) {
  auto& [cell, corner, is_beyond, has_sides] = one.tetrahedron;
  for (std::size_t i = 0; i < 3; ++i) {
    is_beyond[i + 1] = one.edge[i] != none;
  }
  for (std::size_t i = 3; i < one.edge.size(); ++i) {
    const auto [a, b] = tetrahedron_edges[i];
    has_sides = has_sides && (one.edge[i] != none) == (is_beyond[std::size_t(a)] != is_beyond[std::size_t(b)]);
  }
  for (const std::uint32_t edge : one.edge) {
    if (edge != none && has_sides) {
      edges_[edge].has_sides = true;
    }
  }
}

/// The blade goes through elements that a crossing comes near.
void CellDivider::snap() {
  for (const CrossedEdge& one : edges_) {
    if (one.has_sides && (one.share < cell_snap_share || one.share > 1 - cell_snap_share)) {
      is_on_blade_[ends_of(one.key)[one.share < cell_snap_share ? 0 : 1]] = 1;
    }
  }
}

Point CellDivider::place(ElementId element) const {
  if (element < mesh_.element_count()) {
    return mesh_.rest_position(element);
  }
  const CrossedEdge& on = edges_[element - mesh_.element_count()];
  const Point from = mesh_.rest_position(ends_of(on.key)[0]);
  return from + on.share * (mesh_.rest_position(ends_of(on.key)[1]) - from);
}

/// Bisects a simplex at its divided edges, the longest first. The division of a face depends on its own edges alone, so
/// neighbours agree.
template <std::size_t Corners, class Edges>
std::vector<std::array<ElementId, Corners>> CellDivider::bisected(const std::array<ElementId, Corners>& corner,
                                                                  const Edges& edges) const {
  std::vector<const CrossedEdge*> order;
  for (const std::uint32_t edge : edges) {
    if (is_divided(edge)) {
      order.push_back(&edges_[edge]);
    }
  }
  std::ranges::sort(order, [](const CrossedEdge* one, const CrossedEdge* other) {
    return one->length != other->length ? one->length > other->length : one->key < other->key;
  });
  std::vector<std::array<ElementId, Corners>> pieces{corner};
  for (const CrossedEdge* edge : order) {
    const auto [a, b] = ends_of(edge->key);
    for (std::size_t i = pieces.size(); i-- > 0;) {
      const auto at_a = std::ranges::find(pieces[i], a), at_b = std::ranges::find(pieces[i], b);
      if (at_a != pieces[i].end() && at_b != pieces[i].end()) {
        auto other = pieces[i];
        other[std::size_t(at_b - pieces[i].begin())] = edge->point;
        *at_a = edge->point;
        pieces.push_back(other);
      }
    }
  }
  return pieces;
}

double CellDivider::worst_quality(const Crossed& one) const {
  double worst = std::numeric_limits<double>::max();
  for (const auto& [a, b, c, d] : bisected(one.tetrahedron.corner, one.edge)) {
    worst = std::min(worst, tetrahedron_quality({place(a), place(b), place(c), place(d)}));
  }
  return worst;
}

/// Moves the blade to further elements until no piece is too bad.
void CellDivider::keep_quality() {
  for (std::size_t i = 0; i < edges_.size(); ++i) {
    edges_[i].point = static_cast<ElementId>(mesh_.element_count() + i);  // see place()
  }
  std::unordered_map<ElementId, std::vector<const Crossed*>> divided_at;  // by corner
  std::set<const Crossed*> todo;                                          // in the order of cells
  for (const Crossed& one : crossed_) {
    if (is_divided(one)) {
      todo.insert(&one);
      std::ranges::for_each(one.tetrahedron.corner, [&](ElementId corner) { divided_at[corner].push_back(&one); });
    }
  }
  while (!todo.empty()) {
    std::vector<ElementId> snapped;
    for (const Crossed* one : todo) {
      improve(*one, snapped);
    }
    todo.clear();
    for (const ElementId element : snapped) {
      todo.insert(divided_at[element].begin(), divided_at[element].end());
    }
  }
}

/// Moves the blade to the nearest corner of a tetrahedron, again and again until its pieces are good enough.
void CellDivider::improve(const Crossed& one, std::vector<ElementId>& snapped) {
  const auto& [a, b, c, d] = one.tetrahedron.corner;
  const double enough = std::min(least_piece_quality, tetrahedron_quality({place(a), place(b), place(c), place(d)}));
  while (is_divided(one) && worst_quality(one) < enough) {
    const CrossedEdge* nearest = nullptr;
    const auto to_end = [](const CrossedEdge& edge) { return std::min(edge.share, 1 - edge.share); };
    for (const std::uint32_t edge : one.edge) {
      if (is_divided(edge) && (nearest == nullptr || to_end(edges_[edge]) < to_end(*nearest))) {
        nearest = &edges_[edge];
      }
    }
    snapped.push_back(ends_of(nearest->key)[nearest->share <= 1 - nearest->share ? 0 : 1]);
    is_on_blade_[snapped.back()] = 1;
  }
}

void CellDivider::add_points(CellsInPieces& result) {
  for (std::uint32_t i = 0; i < edges_.size(); ++i) {
    if (is_divided(i)) {
      const auto [a, b] = ends_of(edges_[i].key);
      edges_[i].point = static_cast<ElementId>(mesh_.element_count() + result.points.size());
      result.points.push_back(SplitPoint::between(a, b, edges_[i].share));
    }
  }
}

/// Finds the elements on the blade, and the ends of divided edges.
std::vector<std::uint8_t> CellDivider::find_near() const {
  std::vector<std::uint8_t> result = is_on_blade_;
  for (std::uint32_t i = 0; i < edges_.size(); ++i) {
    if (is_divided(i)) {
      result[ends_of(edges_[i].key)[0]] = result[ends_of(edges_[i].key)[1]] = 1;
    }
  }
  return result;
}

/// Adds all tetrahedra near the blade, with their pieces.
void CellDivider::add_cells(CellsInPieces& result) const {
  auto next = crossed_.begin();
  const auto add = [&](CellId cell, const std::array<ElementId, 4>& corner) {
    const bool is_crossed =
        next != crossed_.end() && next->tetrahedron.cell == cell && next->tetrahedron.corner == corner;
    const Crossed one = is_crossed ? *next++ : Crossed{{cell, corner}, {none, none, none, none, none, none}};
    for (const auto& piece : bisected(corner, one.edge)) {
      result.cells.push_back({static_cast<std::uint32_t>(result.tetrahedra.size()), piece});
    }
    result.tetrahedra.push_back(one.tetrahedron);
  };
  const auto skip_to = [&](CellId cell) {
    while (next != crossed_.end() && next->tetrahedron.cell < cell) {
      ++next;
    }
  };
  CellId cell = 0;
  for (const auto& corners : mesh_.tetrahedra) {
    if (is_near(corners)) {
      skip_to(cell);
      add(cell, corners);
    }
    ++cell;
  }
  for (const auto& corners : mesh_.hexahedra) {
    if (is_near(corners)) {
      skip_to(cell);
      for_each_tetrahedron(mesh_, corners, [&](const auto& one) { add(cell, one); });
    }
    ++cell;
  }
}

/// Adds the faces near the blade. A polygon of four corners counts as the side of a
/// hexahedron; others stay.
void CellDivider::add_faces(CellsInPieces& result) const {
  const Faces faces(mesh_);
  for (std::uint32_t face = 0; face < faces.count(); ++face) {
    Ring ring(faces[face].begin(), faces[face].end());
    if (ring.size() > 4 || !is_near(ring)) {
      continue;
    }
    std::rotate(ring.begin(), std::ranges::min_element(ring, OrderAtRest{mesh_}), ring.end());
    for (std::size_t i = 2; i < ring.size(); ++i) {
      const std::array<ElementId, 3> corner{ring[0], ring[i - 1], ring[i]};
      const std::array edges{edge_between(corner[0], corner[1]), edge_between(corner[1], corner[2]),
                             edge_between(corner[2], corner[0])};
      for (const auto& piece : bisected(corner, edges)) {
        result.faces.push_back({face, piece});
      }
    }
  }
}

void CellDivider::limit_to(std::span<const LinkId> reached) {
  reached_.emplace();
  for (const LinkId link : reached) {
    reached_->insert(edge_key(mesh_.links[link][0], mesh_.links[link][1]));
  }
}

CellsInPieces CellDivider::run() {
  CellsInPieces result;
  find_crossed();
  snap();
  keep_quality();
  add_points(result);
  is_near_ = find_near();
  add_cells(result);
  add_faces(result);
  result.is_on_blade = std::move(is_on_blade_);
  return result;
}

}  // namespace

SplitEdit divide_cells(const Mesh& mesh, std::span<const ViewPlace> places, std::span<const Eigen::Vector2d> points,
                       std::optional<std::span<const LinkId>> reached) {
  assert(places.size() == mesh.element_count());
  const StrokeInView stroke(places, points);
  const bool is_point = stroke.empty() || stroke.low() == stroke.high();
  if (is_point || !mesh.has_cells()) {
    return {};
  }
  CellDivider divider(mesh, stroke);
  if (reached) {
    divider.limit_to(*reached);
  }
  return separate(mesh, divider.run());
}

}  // namespace chainmail
