#include "elastic/kelvin.h"

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>

namespace chainmail {
namespace {

using std::numbers::pi;

/// The corners of a facet relative to a point.
struct FacetFromPoint {
  std::array<Point, 3> r;
  std::array<double, 3> distance;
};

FacetFromPoint from_point(const Facet& facet, const Point& point) {
  FacetFromPoint seen;
  for (std::size_t i = 0; i < 3; ++i) {
    seen.r[i] = facet.corner[i] - point;
    seen.distance[i] = seen.r[i].norm();
  }
  return seen;
}

/// Formula of van Oosterom and Strackee (1983).
double solid_angle(const FacetFromPoint& seen) {
  const auto& [a, b, c] = seen.r;
  const auto& [length_a, length_b, length_c] = seen.distance;
  return 2 * std::atan2(a.dot(b.cross(c)), length_a * length_b * length_c + a.dot(b) * length_c + b.dot(c) * length_a +
                                               c.dot(a) * length_b);
}

/// Integrals along an edge. The foot is the projection of the point onto the facet's plane. s is the position along the
/// edge's line from the foot, r is the distance from the point.
struct EdgeIntegrals {
  double across;           // distance of the line from the foot, signed
  double inverse;          // of 1 / r
  double s_inverse;        // of s / r
  double inverse_cubed;    // of 1 / r³
  double s_inverse_cubed;  // of s / r³
};

/// Returns ∫ ds / r³ = [s / (q² r)] with q the distance of the line from the point. If both ends are on the same side
/// of the foot, q is cancelled from the fraction, because it may be 0.
double integrate_inverse_cubed(double s1, double s2, double r1, double r2, double q_squared) {
  if (s1 * s2 > 0) {
    return (s2 - s1) * (s1 + s2) / ((s2 * r1 + s1 * r2) * r1 * r2);
  }
  return (s2 / r2 - s1 / r1) / q_squared;
}

EdgeIntegrals integrate_edge(const Facet& facet, const FacetFromPoint& seen, std::size_t edge, double height) {
  const double s1 = facet.along[edge].dot(seen.r[edge]), length = facet.length[edge], s2 = s1 + length;
  const double r1 = seen.distance[edge], r2 = seen.distance[(edge + 1) % 3];
  EdgeIntegrals of;
  of.across = facet.outward[edge].dot(seen.r[edge]);
  of.inverse = std::log1p(2 * length / (r1 + r2 - length));
  of.s_inverse = length * (s1 + s2) / (r1 + r2);
  of.inverse_cubed = integrate_inverse_cubed(s1, s2, r1, r2, of.across * of.across + height * height);
  of.s_inverse_cubed = of.s_inverse / (r1 * r2);
  return of;
}

}  // namespace

Facet::Facet(const std::array<Point, 3>& corners)
    : corner(corners), centroid((corners[0] + corners[1] + corners[2]) / 3) {
  const Point doubled = (corner[1] - corner[0]).cross(corner[2] - corner[0]);
  normal = doubled.normalized();
  area = doubled.norm() / 2;
  for (std::size_t i = 0; i < 3; ++i) {
    const Point edge = corner[(i + 1) % 3] - corner[i];
    length[i] = edge.norm();
    along[i] = edge / length[i];
    outward[i] = along[i].cross(normal);
  }
}

Eigen::Matrix3d kelvin_displacement(const Point& r, double poisson) {
  const double distance = r.norm();
  const Point direction = r / distance;
  return ((3 - 4 * poisson) * Eigen::Matrix3d::Identity() + direction * direction.transpose()) /
         (16 * pi * (1 - poisson) * distance);
}

Eigen::Matrix3d kelvin_traction(const Point& r, const Point& normal, double poisson) {
  const double distance = r.norm();
  const Point direction = r / distance;
  const Eigen::Matrix3d turning = normal * direction.transpose() - direction * normal.transpose();
  const Eigen::Matrix3d along = (1 - 2 * poisson) * Eigen::Matrix3d::Identity() + 3 * direction * direction.transpose();
  return -(direction.dot(normal) * along + (1 - 2 * poisson) * turning) /
         (8 * pi * (1 - poisson) * distance * distance);
}

double solid_angle(const Facet& facet, const Point& point) { return solid_angle(from_point(facet, point)); }

// Let d be the height of the plane above the point, n its normal, r = ρ + d n, m the direction outward across an edge
// in the plane, and τ the direction along it. The divergence theorem in the plane turns all integrals except the solid
// angle Ω = ∫ d / r³ into sums over edges:
//     ∫ 1 / r        = Σ (m·ρ) ∫ 1/r − d Ω                                            since ∇·(ρ / r) = 1/r + d²/r³
//     ∫ ρ_i ρ_j / r³ = (δ − n n)_ij ∫ 1/r − Σ m_j ∫ ρ_i / r                           since ∂_j (ρ_i / r)
//     ∫ ρ / r³       = −Σ m ∫ 1/r                                                     since ∇ (1 / r)
//     3 ∫ ρ_i ρ_j / r⁵ = (δ − n n)_ij ∫ 1/r³ − Σ m_j ∫ ρ_i / r³                       since ∂_j (ρ_i / r³)
//     3 ∫ ρ / r⁵     = −Σ m ∫ 1/r³                                                    since ∇ (1 / r³)
//     3 d² ∫ 1 / r⁵  = ∫ 1/r³ + Σ (m·ρ) ∫ 1/r³                                        since ∇·(ρ / r³)
KelvinIntegrals integrate_kelvin(const Facet& facet, const Point& point, double poisson) {
  const FacetFromPoint seen = from_point(facet, point);
  const Point& n = facet.normal;
  const double height = n.dot(facet.centroid - point), angle = solid_angle(seen);
  double inverse = -height * angle;                       // ∫ 1 / r
  Point slope = Point::Zero(), steep = Point::Zero();     // Σ m ∫ 1/r, Σ m ∫ 1/r³
  Eigen::Matrix3d edges = Eigen::Matrix3d::Zero();        // Σ m_j ∫ ρ_i / r
  Eigen::Matrix3d steep_edges = Eigen::Matrix3d::Zero();  // Σ m_j ∫ ρ_i / r³
  double steep_across = 0;                                // Σ (m·ρ) ∫ 1/r³
  for (std::size_t i = 0; i < 3; ++i) {
    const EdgeIntegrals of = integrate_edge(facet, seen, i, height);
    const Point& m = facet.outward[i];
    inverse += of.across * of.inverse;
    slope += m * of.inverse;
    steep += m * of.inverse_cubed;
    edges += (m * (of.across * of.inverse) + facet.along[i] * of.s_inverse) * m.transpose();
    steep_edges += (m * (of.across * of.inverse_cubed) + facet.along[i] * of.s_inverse_cubed) * m.transpose();
    steep_across += of.across * of.inverse_cubed;
  }
  const Eigen::Matrix3d unit = Eigen::Matrix3d::Identity(), normals = n * n.transpose();
  const auto both_ways = [&](const Point& m) -> Eigen::Matrix3d { return n * m.transpose() + m * n.transpose(); };
  const Eigen::Matrix3d by_cube =
      (unit - normals) * inverse - edges - height * both_ways(slope) + height * angle * normals;  // ∫ r r / r³
  const Eigen::Matrix3d by_fifth = angle * unit - height * (steep_edges - steep_across * normals) -
                                   height * height * both_ways(steep);  // 3 d ∫ r r / r⁵
  const Eigen::Matrix3d turning = slope * n.transpose() - n * slope.transpose();
  return {((3 - 4 * poisson) * inverse * unit + by_cube) / (16 * pi * (1 - poisson)),
          -((1 - 2 * poisson) * (angle * unit + turning) + by_fifth) / (8 * pi * (1 - poisson))};
}

}  // namespace chainmail
