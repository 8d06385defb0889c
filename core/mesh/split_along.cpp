// Divides faces along the stroke. separate.h then separates them.
//
// The view is needed only to find in which order the stroke crosses the sides of a face, and where on the sides.
// Everything after this is done on the faces themselves, in coordinates in which each is a regular polygon. Straight
// lines stay straight there, and pieces between straight cuts stay convex.

#include "mesh/split_along.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cassert>
#include <cmath>
#include <map>
#include <numbers>
#include <optional>
#include <set>
#include <unordered_map>

#include "mesh/divide_cells.h"
#include "mesh/separate.h"

namespace chainmail {
namespace {

using Eigen::Vector2d;
constexpr double pi = std::numbers::pi;

/// A way of the stroke through a face, from side to side; or, at an end of the stroke, from a side to a point inside.
struct Chord {
  double when = 0;  // of its first crossing
  std::uint32_t face = 0;
  std::array<ElementId, 2> nodes{no_element, no_element};  // the second is no_element for a point inside
  std::array<double, 3> inside{};                          // this point, as shares of the three corners
};

/// Returns the coordinates of corner i of n.
Vector2d corner_place(std::size_t i, std::size_t n) {
  const double angle = 2 * pi * double(i) / double(n);
  return {std::cos(angle), std::sin(angle)};
}

/// A face that is divided into pieces.
struct DividedFace {
  std::vector<Ring> sides;               // the elements on each side, with both corners, in order
  std::map<ElementId, Vector2d> places;  // coordinates of its elements
  std::vector<Ring> pieces;              // convex
};

bool has(const Ring& ring, ElementId element) { return std::ranges::find(ring, element) != ring.end(); }

/// True if the elements of a ring are on a line.
bool is_line(const DividedFace& face, const Ring& ring) {
  constexpr double rounding = 1e-9;  // the whole face has an area of 1.3 or more
  double area = 0;
  for (std::size_t i = 0; i < ring.size(); ++i) {
    area += cross(face.places.at(ring[i]), face.places.at(ring[(i + 1) % ring.size()])) / 2;
  }
  return std::abs(area) < rounding;
}

/// Divides the faces of a mesh along a stroke.
class FaceDivider {
 public:
  FaceDivider(const Mesh& mesh, const Faces& faces, const StrokeInView& stroke,
              std::optional<std::span<const LinkId>> reached)
      : mesh_(mesh), faces_(faces), stroke_(stroke), reached_(reached), next_(mesh.element_count()) {}

  void run();

  FacesInPieces pieces() const;

 private:
  struct Side {
    std::vector<Crossing> crossings;
    std::map<double, ElementId> nodes;  // elements on the side by their share; its ends are not among them
    bool reached = false;
  };
  struct FaceCrossing {
    double when = 0;
    EdgeKey side = 0;
    std::size_t number = 0;  // among the crossings of the side
  };

  void find_sides();
  template <class Meant>
  std::vector<std::uint32_t> faces_at(Meant is_meant) const;
  void find_chords(std::uint32_t face);
  void find_tip(std::uint32_t face, const FaceCrossing& at, const Vector2d& end);
  std::vector<FaceCrossing> crossings_of(std::uint32_t face);
  Side& side(ElementId a, ElementId b);
  bool is_reached(const FaceCrossing& one) const { return sides_.at(one.side).reached; }
  ElementId node(const FaceCrossing& one) { return node(one.side, sides_.at(one.side).crossings[one.number].share); }
  ElementId node(EdgeKey key, double share);
  ElementId add(const SplitPoint& point) {
    points_.push_back(point);
    return next_++;
  }
  std::optional<Eigen::Vector3d> shares_at(std::uint32_t face, const Vector2d& seen) const;

  void begin_face(std::uint32_t face);
  void connect(DividedFace& face, ElementId from, ElementId to);
  bool run_along_side(const DividedFace& face, ElementId from, ElementId to);
  bool cut_piece(DividedFace& face, ElementId from, ElementId to);
  ElementId cut_next_piece(DividedFace& face, ElementId from, ElementId to);
  ElementId divide_edge(DividedFace& face, ElementId a, ElementId b, double share);
  void add_tip(const Chord& chord);

  const Mesh& mesh_;
  const Faces& faces_;
  const StrokeInView& stroke_;
  std::optional<std::span<const LinkId>> reached_;
  ElementId next_;
  std::unordered_map<EdgeKey, Side> sides_;
  std::vector<Chord> chords_;
  std::map<std::uint32_t, DividedFace> divided_;
  std::vector<SplitPoint> points_;
  std::set<EdgeKey> cut_;
};

FaceDivider::Side& FaceDivider::side(ElementId a, ElementId b) {
  const auto [found, is_new] = sides_.try_emplace(edge_key(a, b));
  if (is_new) {
    found->second.crossings = stroke_.crossings(a, b);
  }
  return found->second;
}

/// Finds the links that the stroke crosses.
void FaceDivider::find_sides() {
  const auto find = [this](LinkId link) {
    const auto& [a, b] = mesh_.links[link];
    if (Side& one = side(a, b); one.crossings.empty()) {
      sides_.erase(edge_key(a, b));
    } else {
      one.reached = true;
    }
  };
  if (reached_) {
    std::ranges::for_each(*reached_, find);
  } else {
    for (LinkId link = 0; link < mesh_.link_count(); ++link) {
      find(link);
    }
  }
}

/// Returns the faces with a side for which `is_meant` is true, ascending.
template <class Meant>
std::vector<std::uint32_t> FaceDivider::faces_at(Meant is_meant) const {
  std::vector<bool> is_end(mesh_.element_count());
  for (const auto& [key, one] : sides_) {
    if (is_meant(one)) {
      is_end[ends_of(key)[0]] = is_end[ends_of(key)[1]] = true;
    }
  }
  std::vector<std::uint32_t> result;
  for (std::uint32_t face = 0; face < faces_.count(); ++face) {
    const auto corners = faces_[face];
    for (std::size_t i = 0; i < corners.size(); ++i) {
      const ElementId a = corners[i], b = corners[(i + 1) % corners.size()];
      const auto found = is_end[a] && is_end[b] ? sides_.find(edge_key(a, b)) : sides_.end();
      if (found != sides_.end() && is_meant(found->second)) {
        result.push_back(face);
        break;
      }
    }
  }
  return result;
}

std::vector<FaceDivider::FaceCrossing> FaceDivider::crossings_of(std::uint32_t face) {
  const auto corners = faces_[face];
  std::vector<FaceCrossing> result;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const ElementId a = corners[i], b = corners[(i + 1) % corners.size()];
    const auto& crossings = side(a, b).crossings;
    for (std::size_t k = 0; k < crossings.size(); ++k) {
      result.push_back({crossings[k].when, edge_key(a, b), k});
    }
  }
  std::ranges::sort(result, {}, &FaceCrossing::when);
  return result;
}

/// Finds the ways of the stroke through a face: each crossing leads into it or out of it, also if it is seen from its
/// edge, where no point is between them.
void FaceDivider::find_chords(std::uint32_t face) {
  const auto corners = faces_[face];
  if (std::ranges::any_of(corners, [this](ElementId one) { return stroke_.place(one).distance <= 0; })) {
    return;
  }
  const auto all = crossings_of(face);
  const bool begins_inside = stroke_.is_inside(stroke_.first(), corners);
  for (std::size_t i = begins_inside ? 1 : 0; i + 1 < all.size(); i += 2) {
    if (is_reached(all[i]) && is_reached(all[i + 1])) {
      chords_.push_back({all[i].when, face, {node(all[i]), node(all[i + 1])}, {}});
    }
  }
  if (corners.size() != 3) {
    return;  // a polygon is not divided by a point inside it
  }
  if (begins_inside && is_reached(all.front())) {
    find_tip(face, all.front(), stroke_.first());
  }
  if (begins_inside == (all.size() % 2 == 0) && is_reached(all.back())) {
    find_tip(face, all.back(), stroke_.last());
  }
}

/// The stroke begins or ends inside a triangle. The cut ends there; or, near a side or a corner, on it.
void FaceDivider::find_tip(std::uint32_t face, const FaceCrossing& at, const Vector2d& end) {
  const auto corners = faces_[face];
  const auto shares = shares_at(face, end);
  if (!shares) {
    return;
  }
  if (shares->minCoeff() >= tip_share) {
    chords_.push_back({at.when, face, {node(at), no_element}, {shares->x(), shares->y(), shares->z()}});
    return;
  }
  Eigen::Index least = 0;
  shares->minCoeff(&least);
  const auto first = std::size_t((least + 1) % 3), second = std::size_t((least + 2) % 3);
  const ElementId a = corners[first], b = corners[second];
  if (edge_key(a, b) != at.side) {  // otherwise the stroke has just crossed this side
    side(a, b);
    const double of_b = (*shares)[Eigen::Index(second)] / (1 - (*shares)[least]);
    chords_.push_back({at.when, face, {node(at), node(edge_key(a, b), a < b ? of_b : 1 - of_b)}, {}});
  }
}

/// Returns the shares of the three corners of a triangle at a position in the view; none if the triangle is seen from
/// its edge.
std::optional<Eigen::Vector3d> FaceDivider::shares_at(std::uint32_t face, const Vector2d& seen) const {
  const auto corners = faces_[face];
  const auto &a = stroke_.place(corners[0]), &b = stroke_.place(corners[1]), &c = stroke_.place(corners[2]);
  const double area = cross(b.at - a.at, c.at - a.at);
  if (area == 0) {
    return std::nullopt;
  }
  // In perspective, the shares in the view are those on the object, times the distance.
  Eigen::Vector3d shares(cross(b.at - seen, c.at - seen) / area / a.distance,
                         cross(c.at - seen, a.at - seen) / area / b.distance,
                         cross(a.at - seen, b.at - seen) / area / c.distance);
  shares = shares.cwiseMax(0);
  return shares / shares.sum();
}

/// Returns the element on a side at this share of it: an end or another element nearby, or a new one.
ElementId FaceDivider::node(EdgeKey key, double share) {
  const auto [a, b] = ends_of(key);
  if (!(share >= snap_share)) {
    return a;
  }
  if (share > 1 - snap_share) {
    return b;
  }
  auto& nodes = sides_.at(key).nodes;
  const auto after = nodes.lower_bound(share);
  if (after != nodes.end() && after->first - share < snap_share) {
    return after->second;
  }
  if (after != nodes.begin() && share - std::prev(after)->first < snap_share) {
    return std::prev(after)->second;
  }
  return nodes[share] = add(SplitPoint::between(a, b, share));
}

/// Puts the elements on its sides into a face, which is one piece then.
void FaceDivider::begin_face(std::uint32_t face) {
  const auto corners = faces_[face];
  DividedFace& divided = divided_[face];
  Ring whole;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const ElementId a = corners[i], b = corners[(i + 1) % corners.size()];
    const Vector2d from = corner_place(i, corners.size()), to = corner_place(i + 1, corners.size());
    divided.places[a] = from;
    Ring on{a};
    if (const auto found = sides_.find(edge_key(a, b)); found != sides_.end()) {
      for (const auto& [share, element] : found->second.nodes) {
        divided.places[element] = from + (a < b ? share : 1 - share) * (to - from);
        on.push_back(element);
      }
    }
    if (a > b) {
      std::reverse(on.begin() + 1, on.end());
    }
    whole.insert(whole.end(), on.begin(), on.end());
    on.push_back(b);
    divided.sides.push_back(std::move(on));
  }
  divided.pieces = {whole};
}

void FaceDivider::run() {
  find_sides();
  for (const std::uint32_t face : faces_at([](const Side& side) { return side.reached; })) {
    find_chords(face);
  }
  for (const std::uint32_t face : faces_at([](const Side& side) { return !side.nodes.empty(); })) {
    begin_face(face);
  }
  std::ranges::stable_sort(chords_, {}, &Chord::when);
  for (const Chord& chord : chords_) {
    if (!divided_.contains(chord.face)) {
      begin_face(chord.face);  // all its crossings are at corners
    }
    if (chord.nodes[1] == no_element) {
      add_tip(chord);
    } else {
      connect(divided_.at(chord.face), chord.nodes[0], chord.nodes[1]);
    }
  }
}

/// Cuts a face from one element on its sides to another.
void FaceDivider::connect(DividedFace& face, ElementId from, ElementId to) {
  constexpr int max_steps = 1000;  // rounding may lead a cut in circles
  if (from == to || run_along_side(face, from, to)) {
    return;
  }
  for (int i = 0; i < max_steps && from != no_element && !cut_piece(face, from, to); ++i) {
    from = cut_next_piece(face, from, to);
  }
}

/// The cut runs along a side if both elements are on it. Returns false if they are not.
bool FaceDivider::run_along_side(const DividedFace& face, ElementId from, ElementId to) {
  for (const Ring& on : face.sides) {
    auto first = std::ranges::find(on, from), last = std::ranges::find(on, to);
    if (first != on.end() && last != on.end()) {
      if (last < first) {
        std::swap(first, last);
      }
      for (; first != last; ++first) {
        cut_.insert(edge_key(*first, *std::next(first)));
      }
      return true;
    }
  }
  return false;
}

/// Cuts the piece that has both elements, between them. Returns false if there is no such piece.
bool FaceDivider::cut_piece(DividedFace& face, ElementId from, ElementId to) {
  const auto piece = std::ranges::find_if(face.pieces, [&](const Ring& one) { return has(one, from) && has(one, to); });
  if (piece == face.pieces.end()) {
    return false;
  }
  std::rotate(piece->begin(), std::ranges::find(*piece, from), piece->end());
  const auto second = std::ranges::find(*piece, to);
  Ring one(piece->begin(), second + 1), other(second, piece->end());
  other.push_back(from);
  for (const Ring& half : {one, other}) {
    if (is_line(face, half)) {  // the cut runs along a side of the piece
      for (std::size_t i = 0; i + 1 < half.size(); ++i) {
        cut_.insert(edge_key(half[i], half[i + 1]));
      }
      return true;
    }
  }
  cut_.insert(edge_key(from, to));
  *piece = std::move(one);
  face.pieces.push_back(std::move(other));
  return true;
}

/// Cuts the piece into which the way from one element to another leads. Returns the element where the way leaves the
/// piece, or no_element.
ElementId FaceDivider::cut_next_piece(DividedFace& face, ElementId from, ElementId to) {
  constexpr double rounding = 1e-9;
  const Vector2d start = face.places.at(from), way = face.places.at(to) - start;
  for (const Ring& piece : face.pieces) {
    for (std::size_t i = 0; has(piece, from) && i < piece.size(); ++i) {
      const ElementId a = piece[i], b = piece[(i + 1) % piece.size()];
      if (a == from || b == from) {
        continue;
      }
      const Vector2d side = face.places.at(b) - face.places.at(a), there = face.places.at(a) - start;
      const double across = cross(way, side);
      const double along = cross(there, side) / across, share = cross(there, way) / across;
      if (across != 0 && along > rounding && along < 1 && share >= 0 && share <= 1) {
        const ElementId next = share < snap_share ? a : share > 1 - snap_share ? b : divide_edge(face, a, b, share);
        return next != no_element && cut_piece(face, from, next) ? next : no_element;
      }
    }
  }
  return no_element;
}

/// Adds an element to the edge between two pieces. Returns no_element for an edge of the face: the cut ends there.
ElementId FaceDivider::divide_edge(DividedFace& face, ElementId a, ElementId b, double share) {
  std::vector<std::pair<Ring*, std::size_t>> where;  // pieces, and the index at which to insert
  for (Ring& piece : face.pieces) {
    for (std::size_t i = 0; i < piece.size(); ++i) {
      if (edge_key(piece[i], piece[(i + 1) % piece.size()]) == edge_key(a, b)) {
        where.emplace_back(&piece, i + 1);
      }
    }
  }
  if (where.size() != 2) {
    return no_element;
  }
  const ElementId element = add(SplitPoint::between(a, b, share));
  face.places[element] = (1 - share) * face.places.at(a) + share * face.places.at(b);
  for (const auto& [piece, index] : where) {
    piece->insert(piece->begin() + std::ptrdiff_t(index), element);
  }
  if (cut_.erase(edge_key(a, b)) != 0) {
    cut_.insert(edge_key(a, element));
    cut_.insert(edge_key(element, b));
  }
  return element;
}

/// Cuts a triangle from an element on its sides to a point inside, around which the piece becomes triangles.
void FaceDivider::add_tip(const Chord& chord) {
  constexpr double least_area = 0.01;  // of a triangle at the point; the whole face has 1.3
  const auto corners = faces_[chord.face];
  DividedFace& face = divided_.at(chord.face);
  Vector2d place = Vector2d::Zero();
  for (std::size_t i = 0; i < corners.size(); ++i) {
    place += chord.inside[i] * corner_place(i, corners.size());
  }
  const auto contains = [&](const Ring& piece) {
    for (std::size_t i = 0; i < piece.size(); ++i) {
      const Vector2d &a = face.places.at(piece[i]), &b = face.places.at(piece[(i + 1) % piece.size()]);
      if (cross(b - a, place - a) / 2 < least_area) {
        return false;
      }
    }
    return has(piece, chord.nodes[0]);
  };
  const auto found = std::ranges::find_if(face.pieces, contains);
  if (found == face.pieces.end()) {
    return;  // the cut ends at the side
  }
  const Ring piece = *found;
  face.pieces.erase(found);
  const ElementId tip = add({{corners[0], corners[1], corners[2]}, {chord.inside[1], chord.inside[2]}});
  face.places[tip] = place;
  for (std::size_t i = 0; i < piece.size(); ++i) {
    face.pieces.push_back({piece[i], piece[(i + 1) % piece.size()], tip});
  }
  cut_.insert(edge_key(chord.nodes[0], tip));
}

FacesInPieces FaceDivider::pieces() const {
  FacesInPieces result{{}, points_, cut_};
  for (const auto& [face, divided] : divided_) {
    result.pieces[face] = divided.pieces;
  }
  return result;
}

}  // namespace

SplitEdit split_along(const Mesh& mesh, std::span<const ViewPlace> places, std::span<const Vector2d> points,
                      std::optional<std::span<const LinkId>> reached) {
  assert(places.size() == mesh.element_count());
  const StrokeInView stroke(places, points);
  if (mesh.has_cells()) {
    return divide_cells(mesh, places, points, reached);
  }
  if (stroke.empty() || !can_split(mesh)) {
    return {};
  }
  const Faces faces(mesh);
  FaceDivider divider(mesh, faces, stroke, reached);
  divider.run();
  return separate(mesh, faces, divider.pieces());
}

}  // namespace chainmail
