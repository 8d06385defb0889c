#include "elastic/free_form.h"

#include <algorithm>
#include <cmath>
#include <span>
#include <utility>

#include "elastic/dense.h"
#include "elastic/methods.h"
#include "mesh/error.h"

namespace chainmail {
namespace {

/// Returns all Bernstein polynomials of one degree at t in [0, 1], by their recurrence.
Eigen::VectorXd polynomials(int count, double t) {
  Eigen::VectorXd values = Eigen::VectorXd::Unit(count, 0);
  for (int degree = 1; degree < count; ++degree) {
    for (int i = degree; i > 0; --i) {
      values[i] = (1 - t) * values[i] + t * values[i - 1];
    }
    values[0] *= 1 - t;
  }
  return values;
}

}  // namespace

BernsteinVolume::BernsteinVolume(const Mesh& mesh, const std::array<std::uint32_t, 3>& counts) : mesh_(mesh) {
  for (int k = 0; k < mesh.space_dimension; ++k) {
    counts_.push_back(static_cast<int>(counts[static_cast<std::size_t>(mesh.axes[k])]));
    count_ *= counts_.back();
  }
}

Eigen::VectorXd BernsteinVolume::rest(Eigen::Index point) const {
  Eigen::VectorXd at(mesh_.space_dimension);
  for (int k = 0; k < mesh_.space_dimension; ++k) {
    const double low = mesh_.box[0][mesh_.axes[k]], high = mesh_.box[1][mesh_.axes[k]];
    at[k] = low + (high - low) * double(point % counts_[k]) / (counts_[k] - 1);
    point /= counts_[k];
  }
  return at;
}

Eigen::VectorXd BernsteinVolume::weights(ElementId element) const {
  Eigen::VectorXd all = Eigen::VectorXd::Ones(1);
  for (int k = 0; k < mesh_.space_dimension; ++k) {
    const double low = mesh_.box[0][mesh_.axes[k]], high = mesh_.box[1][mesh_.axes[k]];
    const double at =
        mesh_
            .rest[std::size_t{element} * static_cast<std::size_t>(mesh_.space_dimension) + static_cast<std::size_t>(k)];
    const double share = high > low ? (at - low) / (high - low) : 0;
    const Eigen::VectorXd along = polynomials(counts_[k], share);
    Eigen::VectorXd products(all.size() * along.size());
    for (Eigen::Index i = 0; i < along.size(); ++i) {
      products.segment(i * all.size(), all.size()) = along[i] * all;
    }
    all = std::move(products);
  }
  return all;
}

namespace {

// Weight of the pins relative to the smallest motion of the control points. Pins stay to a millionth of the handle's
// displacement.
constexpr double pin_weight = 1e6;
// Largest number of elements to which control points are fitted. More would not change a few hundred points much.
constexpr std::size_t max_fitted = 20'000;

/// Returns the Cholesky factor of a positive definite matrix. Where rounding has made a pivot negative, it adds as
/// little to the diagonal as is enough.
Eigen::MatrixXd factored(const Eigen::MatrixXd& matrix) {
  for (int power = -15; power < 0; ++power) {
    const double added = power == -15 ? 0 : std::pow(10.0, power);
    Eigen::MatrixXd factor = matrix;
    factor.diagonal().array() += added * matrix.trace();
    if (factor_positive(factor)) {
      return factor;
    }
  }
  throw Error("free-form deformation", "its control points cannot be computed",
              "use smaller coordinates, or other pins");
}

/// Free-form deformation (Sederberg and Parry 1986) by direct manipulation (Hsu et al. 1992): of all motions of the
/// control points that bring the grabbed element to its target, takes the smallest. Pins stay as well as the lattice
/// allows, and so does the shape of a handle of many elements: its elements are at their targets in any case, but the
/// others follow the control points.
class FreeForm final : public ElasticSolver {
 public:
  explicit FreeForm(const ElasticProblem& problem)
      : mesh_(problem.mesh),
        pins_(problem.pins),
        pinned_(problem.pinned),
        volume_(*problem.mesh, problem.options.lattice),
        dimension_(problem.mesh->space_dimension) {
    reset();
    resistance_ = Eigen::MatrixXd::Identity(volume_.count(), volume_.count());
    add_resistance(pins_, resistance_, {});
    factors_ = factored(resistance_);
  }

  void hold(const ElasticHandle& handle, const Progress& progress) override {
    handle_ = handle;
    begin();
    control_response_ = handle.elements.size() == 1 ? respond_to_one() : respond_to_many(progress.part(0, 0.5));
    response_.resize(control_response_.cols(), mesh_->element_count());
    for (ElementId e = 0; e < mesh_->element_count(); ++e) {
      progress.part(0.5, 1).report(e, mesh_->element_count());
      const Eigen::VectorXd weights = volume_.weights(e);
      for (Eigen::Index i = 0; i < response_.rows(); ++i) {
        response_(i, e) = weights.dot(control_response_.col(i));
      }
    }
  }

  void move(const ElasticMotion& motion, const Progress& /*progress*/) override {
    const Eigen::MatrixXd displacement = way_of(motion);
    controls_ = begun_controls_;
    add_product(controls_, 1, control_response_, displacement);
    displacements_ = begun_;
    add_transposed_product(fields(displacements_), 1, displacement, response_);
    for (std::size_t i = 0; i < handle_.elements.size(); ++i) {
      fields(displacements_).col(handle_.elements[i]) = displacement_of(handle_, i, motion);  // exact, without rounding
    }
    hold_pins();
    place_controls();
  }

  void reset() override {
    displacements_.assign(mesh_->rest.size(), 0.0);
    controls_ = Eigen::MatrixXd::Zero(volume_.count(), dimension_);
    hold_pins();
    place_controls();
    begin();
  }

  /// Moves the control points to where they explain these displacements best. The remainder is kept.
  void start_from(std::span<const double> displacements) override {
    displacements_.assign(displacements.begin(), displacements.end());
    const bool at_rest = std::ranges::all_of(displacements_, [](double one) { return one == 0; });
    controls_ = at_rest ? Eigen::MatrixXd(Eigen::MatrixXd::Zero(volume_.count(), dimension_)) : fitted();
    place_controls();
    begin();
  }

  const std::vector<double>& displacements() const override { return displacements_; }
  const std::string& remark() const override { return none_; }
  std::span<const double> control_points() const override { return control_places_; }

  void move_control_point(std::size_t point, std::span<const double> position) override {
    const auto row = static_cast<Eigen::Index>(point);
    const Eigen::Map<const Eigen::VectorXd> to(position.data(), dimension_);
    const Eigen::VectorXd displacement = to - volume_.rest(row) - controls_.row(row).transpose();
    controls_.row(row) += displacement.transpose();
    for (ElementId e = 0; e < mesh_->element_count(); ++e) {
      fields(displacements_).col(e) += volume_.weights(e)[row] * displacement;
    }
    hold_pins();
    place_controls();
    begin();
  }

 private:
  using Fields = Eigen::Map<Eigen::MatrixXd>;  // one column per element

  Fields fields(std::vector<double>& all) const {
    return {all.data(), dimension_, static_cast<Eigen::Index>(mesh_->element_count())};
  }

  void add_resistance(std::span<const ElementId> elements, Eigen::MatrixXd& to, const Progress& progress) const {
    for (std::size_t i = 0; i < elements.size(); ++i) {
      progress.report(i, elements.size());
      const Eigen::VectorXd weights = volume_.weights(elements[i]);
      add_square(pin_weight, weights, to);
    }
  }

  /// Adds factor · a aᵀ to a sum.
  static void add_square(double factor, const Eigen::VectorXd& a, Eigen::MatrixXd& sum) {
    for (Eigen::Index column = 0; column < a.size(); ++column) {
      sum.col(column) += factor * a[column] * a;
    }
  }

  /// Replaces right sides by the solutions, from the Cholesky factor of a matrix.
  static Eigen::MatrixXd solved(const Eigen::MatrixXd& factor, Eigen::MatrixXd right) {
    solve_lower(factor, right);
    solve_lower_transposed(factor, right);
    return right;
  }

  /// Returns the response of the control points to a unit displacement of the handle, the same along each axis.
  Eigen::MatrixXd respond_to_one() const {
    const Eigen::VectorXd weights = volume_.weights(handle_.elements[0]);
    const Eigen::MatrixXd response = solved(factors_, weights);
    return response / weights.dot(response.col(0));
  }

  /// Returns the responses of the control points to a unit turn about each coordinate of the arms, and to a unit
  /// displacement. The elements of the handle are fitted like pins, since the lattice may not contain the motion. Also
  /// moves the state of the beginning to where the handle has the shape with which it was grabbed.
  Eigen::MatrixXd respond_to_many(const Progress& progress) {
    const Eigen::Index count = volume_.count(), n = dimension_;
    Eigen::MatrixXd resistance = resistance_;
    add_resistance(handle_.elements, resistance, progress);
    Eigen::MatrixXd right = Eigen::MatrixXd::Zero(count, 2 * n + 1);
    for (std::size_t i = 0; i < handle_.elements.size(); ++i) {
      const Eigen::VectorXd weights = pin_weight * volume_.weights(handle_.elements[i]);
      right.col(n) += weights;
      for (Eigen::Index k = 0; k < n; ++k) {
        const std::size_t at = i * std::size_t(n) + std::size_t(k);
        right.col(k) += handle_.arms[at] * weights;
        right.col(n + 1 + k) += (handle_.displacements[at] - fields(begun_)(k, handle_.elements[i])) * weights;
      }
    }
    const Eigen::MatrixXd responses = solved(factored(resistance), std::move(right));
    take_shape(responses.rightCols(n));
    return responses.leftCols(n + 1);
  }

  void take_shape(const Eigen::MatrixXd& controls) {
    if (controls.isZero(0)) {
      return;
    }
    begun_controls_ += controls;
    for (ElementId e = 0; e < mesh_->element_count(); ++e) {
      fields(begun_).col(e) += controls.transpose() * volume_.weights(e);
    }
  }

  /// The factors of the responses, one row each.
  Eigen::MatrixXd way_of(const ElasticMotion& motion) {
    if (handle_.elements.size() == 1) {
      return (displacement_of(handle_, 0, motion) - fields(begun_).col(handle_.elements[0])).transpose();
    }
    Eigen::MatrixXd displacement(dimension_ + 1, dimension_);
    displacement << motion.turn.transpose(), motion.translation.transpose();
    return displacement;
  }

  /// Sets the state from which the handle's displacement is measured.
  void begin() {
    begun_ = displacements_;
    begun_controls_ = controls_;
  }

  void hold_pins() {
    for (std::size_t i = 0; i < pins_.size(); ++i) {
      std::copy_n(pinned_.begin() + static_cast<std::ptrdiff_t>(i) * dimension_, dimension_,
                  displacements_.begin() + std::ptrdiff_t{pins_[i]} * dimension_);
    }
  }

  void place_controls() {
    control_places_.resize(static_cast<std::size_t>(volume_.count() * dimension_));
    for (Eigen::Index c = 0; c < volume_.count(); ++c) {
      Eigen::Map<Eigen::VectorXd>(control_places_.data() + c * dimension_, dimension_) =
          volume_.rest(c) + controls_.row(c).transpose();
    }
  }

  Eigen::MatrixXd fitted() {
    // A small weight on all motion decides where the elements leave control points free.
    Eigen::MatrixXd normal = 1e-9 * Eigen::MatrixXd::Identity(volume_.count(), volume_.count());
    Eigen::MatrixXd right = Eigen::MatrixXd::Zero(volume_.count(), dimension_);
    const std::size_t stride = std::max<std::size_t>(1, mesh_->element_count() / max_fitted);
    for (std::size_t e = 0; e < mesh_->element_count(); e += stride) {
      const Eigen::VectorXd weights = volume_.weights(static_cast<ElementId>(e));
      add_square(1, weights, normal);
      for (int k = 0; k < dimension_; ++k) {
        right.col(k) += fields(displacements_)(k, static_cast<Eigen::Index>(e)) * weights;
      }
    }
    return solved(factored(normal), std::move(right));
  }

  MeshPointer mesh_;
  std::vector<ElementId> pins_;
  std::vector<double> pinned_;
  BernsteinVolume volume_;
  int dimension_;
  Eigen::MatrixXd resistance_, factors_;  // of the control points to motion, and its Cholesky factor
  ElasticHandle handle_;
  // Responses to the motion of the handle: of the control points, a row each, and of the elements, a column each.
  Eigen::MatrixXd control_response_, response_;
  std::vector<double> displacements_, begun_;  // now, and where the handle's displacement begins
  Eigen::MatrixXd controls_, begun_controls_;  // displacements, one row per control point
  std::vector<double> control_places_;
  std::string none_;
};

}  // namespace

std::unique_ptr<ElasticSolver> make_free_form(const ElasticProblem& problem, const Progress& /*progress*/) {
  return std::make_unique<FreeForm>(problem);
}

}  // namespace chainmail
