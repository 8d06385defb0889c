#include <Eigen/Cholesky>
#include <algorithm>
#include <array>
#include <cmath>

#include "elastic/bernstein.h"
#include "elastic/methods.h"

namespace chainmail {
namespace {

// Weight of the pins relative to the smallest motion of the control points. Pins stay to a millionth of the handle's
// displacement.
constexpr double pin_weight = 1e6;
// Largest number of elements to which control points are fitted. More would not change a few hundred points much.
constexpr std::size_t most_fitted = 20'000;

/// Free-form deformation (Sederberg and Parry 1986) by direct manipulation (Hsu et al. 1992): of all motions of the
/// control points that bring the grabbed element to its target, takes the smallest. Pins stay as well as the lattice
/// allows.
class FreeForm final : public ElasticSolver {
 public:
  explicit FreeForm(const ElasticProblem& problem)
      : mesh_(problem.mesh),
        pins_(problem.pins),
        pinned_(problem.pinned),
        volume_(*problem.mesh, problem.options.lattice),
        dimension_(problem.mesh->space_dimension) {
    reset();
    Eigen::MatrixXd resistance = Eigen::MatrixXd::Identity(volume_.count(), volume_.count());
    for (const ElementId pin : pins_) {
      const Eigen::VectorXd weights = volume_.weights(pin);
      resistance += pin_weight * weights * weights.transpose();
    }
    resistance_.compute(resistance);
  }

  void hold(ElementId element, const Progress& progress) override {
    held_ = element;
    const Eigen::VectorXd weights = volume_.weights(element);
    control_response_ = resistance_.solve(weights);
    control_response_ /= weights.dot(control_response_);
    response_.resize(mesh_->element_count());
    for (ElementId e = 0; e < mesh_->element_count(); ++e) {
      progress.report(e, mesh_->element_count());
      response_[e] = volume_.weights(e).dot(control_response_);
    }
    begin();
  }

  void move(std::span<const double> displacement, const Progress& /*progress*/) override {
    const Eigen::Map<const Eigen::VectorXd> to(displacement.data(), dimension_);
    const Eigen::RowVectorXd way = (to - fields(begun_).col(held_)).transpose();
    controls_ = begun_controls_ + control_response_ * way;
    fields(displacements_).noalias() = fields(begun_) + way.transpose() * response_.transpose();
    fields(displacements_).col(held_) = to;  // exact, without rounding
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
    const Eigen::VectorXd way = to - volume_.rest(row) - controls_.row(row).transpose();
    controls_.row(row) += way.transpose();
    for (ElementId e = 0; e < mesh_->element_count(); ++e) {
      fields(displacements_).col(e) += volume_.weights(e)[row] * way;
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
    const std::size_t stride = std::max<std::size_t>(1, mesh_->element_count() / most_fitted);
    for (std::size_t e = 0; e < mesh_->element_count(); e += stride) {
      const Eigen::VectorXd weights = volume_.weights(static_cast<ElementId>(e));
      normal += weights * weights.transpose();
      right += weights * fields(displacements_).col(static_cast<Eigen::Index>(e)).transpose();
    }
    return normal.ldlt().solve(right);
  }

  MeshPointer mesh_;
  std::vector<ElementId> pins_;
  std::vector<double> pinned_;
  BernsteinVolume volume_;
  int dimension_;
  Eigen::LLT<Eigen::MatrixXd> resistance_;  // of the control points to motion
  ElementId held_ = 0;
  Eigen::VectorXd control_response_, response_;  // to a unit displacement of the handle, the same along each axis
  std::vector<double> displacements_, begun_;    // now, and where the handle's displacement begins
  Eigen::MatrixXd controls_, begun_controls_;    // displacements, one row per control point
  std::vector<double> control_places_;
  std::string none_;
};

}  // namespace

std::unique_ptr<ElasticSolver> make_free_form(const ElasticProblem& problem, const Progress& /*progress*/) {
  return std::make_unique<FreeForm>(problem);
}

}  // namespace chainmail
