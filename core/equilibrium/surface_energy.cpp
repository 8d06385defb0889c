#include "equilibrium/surface_energy.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <utility>

namespace chainmail {
namespace {

// The hinges of a triangle fade out below this ratio of its area to that at rest.
constexpr double fades_below = 0.1;
// A triangle with a smaller ratio has no normal.
constexpr double no_area = 1e-12;

using Vector = SurfaceEnergy::Vector;
using Six = FixedMatrix<double, 6, 6>;

Vector cross(const Vector& a, const Vector& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

/// Adds a multiple of the slope of a triangle's area, twice: `normal` is this multiple of its unit normal, `edge` and
/// `side` run from its first corner to the next ones.
void add_slope_of_area(std::array<Vector, 4>& slope, const std::array<std::size_t, 3>& corners, const Vector& normal,
                       const Vector& edge, const Vector& side) {
  const Vector at_next = cross(side, normal), at_last = cross(normal, edge);
  slope[corners[1]] += at_next;
  slope[corners[2]] += at_last;
  slope[corners[0]] -= at_next + at_last;
}

/// Returns |F|² less its value at rest, from the axes at rest and F less them.
double stretched(const std::array<Vector, 2>& axes, const std::array<Vector, 2>& strain) {
  return 2 * (axes[0].dot(strain[0]) + axes[1].dot(strain[1])) + strain[0].squaredNorm() + strain[1].squaredNorm();
}

FixedMatrix<double, 6> joined(const Vector& a, const Vector& b) { return {a[0], a[1], a[2], b[0], b[1], b[2]}; }

/// Returns the second derivatives of |a × b|, times it, by a and b; `slope` is the first.
Six curvature_of_ratio(const Vector& a, const Vector& b, const FixedMatrix<double, 6>& slope) {
  const double aa = a.squaredNorm(), bb = b.squaredNorm(), ab = a.dot(b);
  Six result;
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) {
      const bool unit = i == j;
      result(i, j) = (unit ? bb : 0) - b[i] * b[j];
      result(3 + i, 3 + j) = (unit ? aa : 0) - a[i] * a[j];
      result(i, 3 + j) = result(3 + j, i) = 2 * a[i] * b[j] - b[i] * a[j] - (unit ? ab : 0);
    }
  }
  return result - outer_product(slope, slope);
}

/// Returns a symmetric matrix with 0 in place of its negative eigenvalues.
Six without_negative(const Six& matrix) {
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix<double, 6, 6>> eigen(
      Eigen::Map<const Eigen::Matrix<double, 6, 6>>(matrix.data()));
  Six vectors = Six::from(eigen.eigenvectors().data()), scaled = vectors;
  for (int i = 0; i < 36; ++i) {
    scaled[i] *= std::max(0.0, eigen.eigenvalues()[i / 6]);
  }
  return scaled * transposed(vectors);
}

/// The share of a hinge that a triangle with this ratio of areas has, and its slope.
struct Fade {
  explicit Fade(double ratio) {
    if (ratio < fades_below) {
      const double x = ratio / fades_below;
      value = x * x * (3 - 2 * x);
      slope = 6 * x * (1 - x) / fades_below;
    }
  }
  double value = 1, slope = 0;
};

}  // namespace

double thickness_of(const Mesh& mesh, const ElasticOptions& elastic) {
  return elastic.thickness * (mesh.box[1] - mesh.box[0]).maxCoeff();
}

void SurfaceEnergy::build(MeshPointer mesh, const Progress& progress) {
  mesh_ = std::move(mesh);
  cells_ = build_surface_cells(*mesh_, progress);
  is_whole_.assign(cells_.triangles.size(), 1);
  is_cut_.assign(mesh_->link_count(), 0);
  find_rest();
  moments_.build(*mesh_, cells_);
  find_triangles();
  find_pulls();
  ratio_.assign(cells_.triangles.size(), 1);
  turns_.assign(cells_.hinges.size(), {});
  turned_.assign(cells_.hinges.size(), 0);
  rest_turn_.assign(cells_.hinges.size(), 0);
  const Vectors none(mesh_->element_count());
  for (std::size_t h = 0; h < cells_.hinges.size(); ++h) {
    Turn one;
    turn(h, none, one, false);
    rest_turn_[h] = one.value / moments_.length(h);
  }
}

void SurfaceEnergy::find_rest() {
  rest_.resize(cells_.triangles.size());
  for (std::size_t t = 0; t < rest_.size(); ++t) {
    Rest& rest = rest_[t];
    const auto [i, j, k] = cells_.triangles[t];
    const auto position = [&](ElementId e) { return Vector::from(mesh_->rest.data() + 3 * std::size_t{e}); };
    const Vector a = position(i), b = position(j) - a, c = position(k) - a, across = cross(cross(b, c), b);
    const double width = b.norm();
    rest.frame = {b / width, across / across.norm()};
    const double foot = c.dot(rest.frame[0]), height = c.dot(rest.frame[1]);
    rest.gradients[1] = {1 / width, -foot / (width * height)};
    rest.gradients[2] = {0, 1 / height};
    rest.gradients[0] = -rest.gradients[1] - rest.gradients[2];
    rest.area = width * height / 2;
  }
}

/// Finds the triangles of each link.
void SurfaceEnergy::find_triangles() {
  first_triangle_.assign(mesh_->link_count() + 1, 0);
  for (const LinkId link : cells_.links) {
    ++first_triangle_[link + 1];
  }
  for (std::size_t link = 0; link < mesh_->link_count(); ++link) {
    first_triangle_[link + 1] += first_triangle_[link];
  }
  triangles_.resize(cells_.links.size());
  std::vector<std::uint32_t> next(first_triangle_.begin(), first_triangle_.end() - 1);
  for (std::uint32_t t = 0; t < cells_.triangles.size(); ++t) {
    for (const LinkId link : cells_.links_of(t)) {
      triangles_[next[link]++] = t;
    }
  }
}

/// Finds the places of the forces on each element, of triangles and then of hinges.
void SurfaceEnergy::find_pulls() {
  std::vector<ElementId> on;
  for (const auto& triangle : cells_.triangles) {
    on.insert(on.end(), triangle.begin(), triangle.end());
  }
  whole_beside_.assign(mesh_->element_count(), 0);
  for (const ElementId e : on) {
    ++whole_beside_[e];
  }
  for (const auto& hinge : cells_.hinges) {
    on.insert(on.end(), hinge.corners.begin(), hinge.corners.end());
  }
  first_pull_.assign(mesh_->element_count() + 1, 0);
  for (const ElementId e : on) {
    ++first_pull_[e + 1];
  }
  for (std::size_t e = 0; e < mesh_->element_count(); ++e) {
    first_pull_[e + 1] += first_pull_[e];
  }
  pulls_.resize(on.size());
  pull_.assign(on.size(), Vector());
  std::vector<std::uint32_t> next(first_pull_.begin(), first_pull_.end() - 1);
  for (std::uint32_t place = 0; place < on.size(); ++place) {
    pulls_[next[on[place]]++] = place;
  }
}

void SurfaceEnergy::set_material(const ElasticOptions& elastic, const Progress& progress) {
  lame_ = lame({1, elastic.material.poisson});
  poisson_ = elastic.material.poisson;
  thickness_ = thickness_of(*mesh_, elastic);
  density_ = ExtendedDensity(elastic.law, lame_, 2);
  moments_.set(cells_, poisson_, is_whole_);
  scale_ = 1;
  double sum = 0;
  for (LinkId link = 0; link < mesh_->link_count(); ++link) {
    progress.report(link, mesh_->link_count());
    sum += std::max(0.0, stiffness_around(link)) / mesh_->link_count();
  }
  scale_ = sum > 0 && std::isfinite(sum) ? sum : 1;
}

double SurfaceEnergy::bending() const { return thickness_ * thickness_ / (12 * (1 - poisson_ * poisson_)) / scale_; }

std::vector<LinkId> SurfaceEnergy::set_cuts(const Cuts& cuts) {
  std::vector<LinkId> changed;
  std::vector<std::uint32_t> beside, triangles;
  for (LinkId link = 0; link < mesh_->link_count(); ++link) {
    if (const std::uint8_t now = cuts.is_cut(link) ? 1 : 0; now != is_cut_[link]) {
      is_cut_[link] = now;
      changed.push_back(link);
      beside.insert(beside.end(), triangles_.begin() + first_triangle_[link],
                    triangles_.begin() + first_triangle_[link + 1]);
    }
  }
  std::ranges::sort(beside);
  beside.erase(std::unique(beside.begin(), beside.end()), beside.end());
  for (const std::uint32_t t : beside) {
    const auto links = cells_.links_of(t);
    const bool whole = std::ranges::none_of(links, [&](LinkId link) { return is_cut_[link] != 0; });
    if (whole != is_whole(t)) {
      is_whole_[t] = whole ? 1 : 0;
      triangles.push_back(t);
      changed.insert(changed.end(), links.begin(), links.end());
      for (const ElementId e : cells_.triangles[t]) {
        whole_beside_[e] += whole ? 1 : std::uint32_t(-1);
      }
    }
  }
  moments_.update(cells_, is_whole_, triangles);
  std::ranges::sort(changed);
  changed.erase(std::unique(changed.begin(), changed.end()), changed.end());
  loose_.find(*mesh_, cuts, whole_beside_);
  return changed;
}

/// Returns the sum over the triangles that have both ends of a link of −area (2μ + λ) ∇a·∇b.
double SurfaceEnergy::stiffness_around(LinkId link) const {
  const auto [i, j] = mesh_->links[link];
  double sum = 0;
  for (std::uint32_t at = first_triangle_[link]; at < first_triangle_[link + 1]; ++at) {
    const std::uint32_t t = triangles_[at];
    const auto& corners = cells_.triangles[t];
    const auto a = std::ranges::find(corners, i), b = std::ranges::find(corners, j);
    if (is_whole(t) && a != corners.end() && b != corners.end()) {
      const auto& gradients = rest_[t].gradients;
      sum -=
          rest_[t].area * gradients[std::size_t(a - corners.begin())].dot(gradients[std::size_t(b - corners.begin())]);
    }
  }
  return sum * (2 * lame_.mu + lame_.lambda) / scale_;
}

double SurfaceEnergy::weight(LinkId link) const {
  if (is_cut_[link] != 0) {
    return 0;
  }
  const auto [i, j] = mesh_->links[link];
  const bool is_loose = whole_beside_[i] == 0 || whole_beside_[j] == 0;
  return is_loose ? LooseLinks<3>::stiffness : std::max(least_weight, stiffness_around(link));
}

double SurfaceEnergy::evaluate(const Vectors& displacements, Vectors* force, const SharedLoop& shared) {
  const bool wants_force = force != nullptr;
  double energy = shared.sum(cells_.triangles.size(), [&](std::size_t first, std::size_t last) {
    double sum = 0;
    for (std::size_t t = first; t < last; ++t) {
      sum += stretch(std::uint32_t(t), displacements, wants_force);
    }
    return sum;
  });
  least_ = ratio_.empty() ? 1 : *std::ranges::min_element(ratio_);
  energy += bend(displacements, wants_force, shared);
  if (wants_force) {
    force->resize(displacements.size());
    shared.run(force->size(), [&](std::size_t first, std::size_t last) {
      for (std::size_t e = first; e < last; ++e) {
        Vector sum;
        for (std::uint32_t i = first_pull_[e]; i < first_pull_[e + 1]; ++i) {
          sum += pull_[pulls_[i]];
        }
        (*force)[e] = sum;
      }
    });
  }
  return energy + loose_.add(*mesh_, displacements, force);
}

/// Returns the energy of bending.
double SurfaceEnergy::bend(const Vectors& displacements, bool wants_force, const SharedLoop& shared) {
  shared.run(turns_.size(), [&](std::size_t first, std::size_t last) {
    for (std::size_t h = first; h < last; ++h) {
      turned_[h] = 0;
      if (moments_.is_whole(h)) {
        turn(h, displacements, turns_[h], wants_force);
        turned_[h] = turns_[h].value;
      }
    }
  });
  moments_.solve(turned_, moment_, shared);
  const double stiffness = bending();
  return shared.sum(turns_.size(), [&](std::size_t first, std::size_t last) {
    double sum = 0;
    for (std::size_t h = first; h < last; ++h) {
      sum += stiffness / 2 * moment_[h] * turned_[h];
      for (std::size_t k = 0; wants_force && k < 4; ++k) {
        pull_[3 * cells_.triangles.size() + 4 * h + k] =
            moments_.is_whole(h) ? -stiffness * moment_[h] * turns_[h].slope[k] : Vector();
      }
    }
    return sum;
  });
}

/// Returns F, and F less its value at rest.
auto SurfaceEnergy::stretch_of(std::uint32_t triangle, const Vectors& displacements, Frame& strain) const -> Frame {
  const auto& corners = cells_.triangles[triangle];
  const Rest& rest = rest_[triangle];
  const Vector one = displacements[corners[1]] - displacements[corners[0]],
               other = displacements[corners[2]] - displacements[corners[0]];
  for (int k = 0; k < 2; ++k) {
    strain[std::size_t(k)] = one * rest.gradients[1][k] + other * rest.gradients[2][k];
  }
  return {rest.frame[0] + strain[0], rest.frame[1] + strain[1]};
}

double SurfaceEnergy::stretch(std::uint32_t triangle, const Vectors& displacements, bool wants_force) {
  ratio_[triangle] = 1;
  const std::size_t place = 3 * std::size_t{triangle};
  if (!is_whole(triangle)) {
    std::fill_n(pull_.begin() + std::ptrdiff_t(place), 3, Vector());
    return 0;
  }
  const Rest& rest = rest_[triangle];
  Frame strain;
  const Frame f = stretch_of(triangle, displacements, strain);
  const Vector across = cross(f[0], f[1]);
  const double ratio = across.norm(), shape = stretched(rest.frame, strain);
  ratio_[triangle] = ratio;
  const auto density = density_.at(shape, ratio);
  const double area = rest.area / scale_;
  if (wants_force) {
    Frame stress{2 * density.by_shape * f[0], 2 * density.by_shape * f[1]};
    if (ratio > no_area) {
      const Vector normal = across / ratio;
      stress[0] += density.by_volume * cross(f[1], normal);
      stress[1] += density.by_volume * cross(normal, f[0]);
    }
    for (std::size_t k = 0; k < 3; ++k) {
      pull_[place + k] = -area * (stress[0] * rest.gradients[k][0] + stress[1] * rest.gradients[k][1]);
    }
  }
  return area * density.value;
}

/// Finds the turn of a hinge, with its slope by the corners' coordinates.
void SurfaceEnergy::turn(std::size_t hinge, const Vectors& displacements, Turn& turn, bool wants_slope) const {
  const auto& [corners, triangle, side, agrees] = cells_.hinges[hinge];
  const Vector p = position(corners[0], displacements), q = position(corners[1], displacements);
  const Vector a = position(corners[2], displacements), b = position(corners[3], displacements);
  const Vector edge = q - p, one = cross(edge, a - p), other = cross(b - p, edge);  // normals, twice the areas
  const double size_one = one.norm(), size_other = other.norm(), size = edge.norm();
  const double rest_one = 2 * rest_[triangle[0]].area, rest_other = 2 * rest_[triangle[1]].area;
  const double length = moments_.length(hinge);
  turn.value = 0;
  turn.slope = {};
  if (!(size_one > no_area * rest_one && size_other > no_area * rest_other)) {
    return;
  }
  const Vector normal_one = one / size_one, normal_other = other / size_other;
  const double sine = cross(normal_one, normal_other).dot(edge) / size, cosine = normal_one.dot(normal_other);
  const double angle = std::atan2(sine, cosine) - rest_turn_[hinge];
  const Fade fade_one(size_one / rest_one), fade_other(size_other / rest_other);
  turn.value = length * angle * fade_one.value * fade_other.value;
  if (!wants_slope) {
    return;
  }
  const double share = length * fade_one.value * fade_other.value;
  const Vector by_one = share / size_one * normal_one, by_other = share / size_other * normal_other;
  turn.slope[2] = -size * by_one;
  turn.slope[3] = -size * by_other;
  turn.slope[0] = -((a - q).dot(edge) / size * by_one + (b - q).dot(edge) / size * by_other);
  turn.slope[1] = (a - p).dot(edge) / size * by_one + (b - p).dot(edge) / size * by_other;
  const double by_area_one = length * angle * fade_other.value * fade_one.slope / rest_one;
  const double by_area_other = length * angle * fade_one.value * fade_other.slope / rest_other;
  add_slope_of_area(turn.slope, {0, 1, 2}, by_area_one * normal_one, edge, a - p);
  add_slope_of_area(turn.slope, {1, 0, 3}, by_area_other * normal_other, -edge, b - q);
}

auto SurfaceEnergy::curvature_of_triangle(std::uint32_t triangle, const Vectors& displacements) const
    -> TriangleMatrix {
  const Rest& rest = rest_[triangle];
  Frame strain;
  const Frame f = stretch_of(triangle, displacements, strain);
  const Vector across = cross(f[0], f[1]);
  const double ratio = std::max(across.norm(), no_area);
  const double shape = stretched(rest.frame, strain);
  const auto slope = density_.at(shape, ratio);
  const auto curved = density_.curvature_at(shape, ratio);
  const Vector normal = across / ratio;
  const auto by_shape = joined(2 * f[0], 2 * f[1]), by_ratio = joined(cross(f[1], normal), cross(normal, f[0]));
  const Six both = outer_product(by_shape, by_ratio);
  const Six all = without_negative(
      2 * slope.by_shape * Six::Identity() + slope.by_volume / ratio * curvature_of_ratio(f[0], f[1], by_ratio) +
      curved.by_shape * outer_product(by_shape, by_shape) + curved.by_volume * outer_product(by_ratio, by_ratio) +
      curved.by_both * (both + transposed(both)));
  TriangleMatrix result;
  for (int row = 0; row < 9; ++row) {
    for (int column = 0; column < 9; ++column) {
      const auto &one = rest.gradients[std::size_t(row / 3)], &other = rest.gradients[std::size_t(column / 3)];
      double sum = 0;
      for (int i = 0; i < 2; ++i) {
        for (int j = 0; j < 2; ++j) {
          sum += one[i] * other[j] * all(3 * i + row % 3, 3 * j + column % 3);
        }
      }
      result(row, column) = rest.area / scale_ * sum;
    }
  }
  return result;
}

auto SurfaceEnergy::curvature_of_hinge(std::size_t hinge, const Vectors& displacements) const -> HingeVector {
  HingeVector result;
  if (moments_.is_whole(hinge)) {
    Turn one;
    turn(hinge, displacements, one, true);
    const double root = std::sqrt(bending() * moments_.stiffness(hinge));
    for (int i = 0; i < 12; ++i) {
      result[i] = root * one.slope[std::size_t(i / 3)][i % 3];
    }
  }
  return result;
}

}  // namespace chainmail
