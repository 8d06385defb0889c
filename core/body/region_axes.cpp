#include "body/region_axes.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <string>

#include "mesh/eigenvectors.h"
#include "mesh/error.h"

namespace chainmail {
namespace {

// Spreads (variances) that differ by less than this share of the largest one count as equal.
constexpr double equal_spreads = 1e-6;
// Principal axes that are turned by less than this (radians) are those of the world, up to rounding.
constexpr double no_turn = 1e-9;

template <class Turn>
void turn_coordinates(const Mesh& mesh, double* coordinates, Turn turn) {
  Point vector = Point::Zero();
  for (int k = 0; k < mesh.space_dimension; ++k) {
    vector[mesh.axes[std::size_t(k)]] = coordinates[k];
  }
  const Point turned = turn(vector);
  for (int k = 0; k < mesh.space_dimension; ++k) {
    coordinates[k] = turned[mesh.axes[std::size_t(k)]];
  }
}

Eigen::Matrix3d covariance_of(const Mesh& mesh) {
  Point mean = Point::Zero();
  for (ElementId e = 0; e < mesh.element_count(); ++e) {
    mean += mesh.rest_position(e) / double(mesh.element_count());
  }
  Eigen::Matrix3d sum = Eigen::Matrix3d::Zero();
  for (ElementId e = 0; e < mesh.element_count(); ++e) {
    const Point from_mean = mesh.rest_position(e) - mean;
    sum += from_mean * from_mean.transpose() / double(mesh.element_count());
  }
  return sum;
}

/// Orders axes and chooses their signs so that they are nearest to those of the world.
Eigen::Matrix3d nearest_to_world(const Eigen::Matrix3d& axes) {
  Eigen::Matrix3d best = Eigen::Matrix3d::Identity();
  double most = -1;
  std::array<int, 3> order{0, 1, 2};
  do {
    Eigen::Matrix3d ordered;
    for (int k = 0; k < 3; ++k) {
      ordered.col(k) = axes.col(order[std::size_t(k)]);
      ordered.col(k) *= ordered(k, k) < 0 ? -1 : 1;
    }
    if (ordered.col(0).cross(ordered.col(1)).dot(ordered.col(2)) <
        0) {  // a reflection: turns the axis that loses least
      Eigen::Index worst = 0;
      ordered.diagonal().minCoeff(&worst);
      ordered.col(worst) *= -1;
    }
    if (ordered.trace() > most + 1e-12) {
      most = ordered.trace();
      best = ordered;
    }
  } while (std::next_permutation(order.begin(), order.end()));
  return best;
}

/// Returns the smallest rotation of the axes of the world after which one of them is along a vector of length 1.
Point rotation_to(const Point& single) {
  Eigen::Index nearest = 0;
  single.cwiseAbs().maxCoeff(&nearest);
  const Point along = single[nearest] < 0 ? Point(-single) : single;
  const Point axis = Point::Unit(nearest).cross(along);
  const double sine = axis.norm(), angle = std::atan2(sine, along[nearest]);
  return angle < no_turn ? Point(Point::Zero()) : Point(angle / sine * axis);
}

Point rotation_of(const Eigen::Matrix3d& axes) {
  const Eigen::AngleAxisd turn(axes);
  return turn.angle() < no_turn ? Point(Point::Zero()) : Point(turn.angle() * turn.axis());
}

PrincipalAxes principal_axes_in_plane(const Mesh& mesh, const Eigen::Matrix3d& spread) {
  const int a = mesh.axes[0], b = mesh.axes[1];
  const double difference = spread(a, a) - spread(b, b), mixed = 2 * spread(a, b);
  if (!(std::hypot(difference, mixed) > equal_spreads * (spread(a, a) + spread(b, b)))) {
    return {{AxesKind::object, Point::Zero()}, false};
  }
  double angle = std::atan2(mixed, difference) / 2;  // of the axis of the largest spread, from a toward b
  const double quarter = std::acos(0.0);
  angle -= quarter * std::round(angle / quarter);
  const Point normal = Point::Unit(a).cross(Point::Unit(b));
  return {{AxesKind::object, std::abs(angle) < no_turn ? Point(Point::Zero()) : Point(angle * normal)}, true};
}

PrincipalAxes principal_axes_in_space(const Eigen::Matrix3d& spread) {
  const auto [spreads, vectors] = ascending_eigenvectors(spread);
  const double least = equal_spreads * spreads[2];
  const bool low_equal = !(spreads[1] - spreads[0] > least), high_equal = !(spreads[2] - spreads[1] > least);
  if (low_equal && high_equal) {
    return {{AxesKind::object, Point::Zero()}, false};
  }
  if (low_equal || high_equal) {
    return {{AxesKind::object, rotation_to(vectors.col(low_equal ? 2 : 0))}, false};
  }
  return {{AxesKind::object, rotation_of(nearest_to_world(vectors))}, true};
}

}  // namespace

RegionAxes::RegionAxes(AxesKind kind, const Point& rotation) : kind_(kind), rotation_(rotation) {
  if (is_turned()) {
    const double angle = rotation.norm();
    matrix_ = Eigen::AngleAxisd(angle, rotation / angle).toRotationMatrix();
  }
}

void turn_into_world(const Mesh& mesh, const RegionAxes& axes, double* coordinates) {
  turn_coordinates(mesh, coordinates, [&](const Point& vector) { return axes.into_world(vector); });
}

void turn_into_axes(const Mesh& mesh, const RegionAxes& axes, double* coordinates) {
  turn_coordinates(mesh, coordinates, [&](const Point& vector) { return axes.into_axes(vector); });
}

PrincipalAxes principal_axes(const Mesh& mesh) {
  const Eigen::Matrix3d spread = covariance_of(mesh);
  if (mesh.space_dimension < 2 || !(spread.trace() > 0)) {
    return {{AxesKind::object, Point::Zero()}, mesh.space_dimension < 2};
  }
  return mesh.space_dimension == 2 ? principal_axes_in_plane(mesh, spread) : principal_axes_in_space(spread);
}

RegionAxes axes_for(const Mesh& mesh, const RegionAxes& axes) {
  if (axes.kind() == AxesKind::object) {
    return principal_axes(mesh).axes;
  }
  try {
    check(axes, mesh);
    return axes;
  } catch (const Error&) {
    return {};
  }
}

void check(const RegionAxes& axes, const Mesh& mesh) {
  // The axes of an angle that is too large are not numbers.
  if (!axes.rotation().allFinite() || !axes.matrix().allFinite()) {
    throw Error("frame", "its rotation is not finite", "give an axis and an angle as numbers");
  }
  for (int k = 0; k < 3 && mesh.space_dimension < 3; ++k) {
    const bool leaves_space = mesh.space_dimension == 1 || mesh.has_axis(k);
    if (axes.rotation()[k] != 0 && leaves_space) {
      throw Error("frame", std::string("turned about ") + "xyz"[k] + ", its axes would leave the space of the object",
                  mesh.space_dimension == 1 ? "use the frame 'axes'" : "turn it about the axis across the plane");
    }
  }
}

MeshPointer in_axes(const MeshPointer& mesh, const RegionAxes& axes) {
  if (!axes.is_turned()) {
    return mesh;
  }
  const auto turned = std::make_shared<Mesh>(*mesh);
  const auto step = std::size_t(mesh->space_dimension);
  for (std::size_t at = 0; at < turned->rest.size(); at += step) {
    turn_into_axes(*mesh, axes, turned->rest.data() + at);
  }
  for (std::size_t at = 0; at < turned->shapes.size(); at += step) {
    turn_into_axes(*mesh, axes, turned->shapes.data() + at);
  }
  for (ElementId e = 0; e < turned->element_count(); ++e) {
    const Point position = turned->rest_position(e);
    turned->box[0] = e == 0 ? position : Point(turned->box[0].cwiseMin(position));
    turned->box[1] = e == 0 ? position : Point(turned->box[1].cwiseMax(position));
  }
  return turned;
}

}  // namespace chainmail
