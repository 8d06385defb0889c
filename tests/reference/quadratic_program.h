#pragma once

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <span>
#include <vector>

#include "body/softness.h"
#include "mesh/cuts.h"
#include "mesh/mesh.h"
#include "reference/object.h"

namespace reference {

using chainmail::Cuts;
using chainmail::EnergyKind;
using chainmail::LinkId;
using chainmail::LinkSoftness;
using chainmail::Mesh;
using chainmail::Softness;

/// The state of least axial or isotropic energy among all valid states, by a dense primal-dual interior-point method
/// (Nocedal and Wright 2006, chapter 16.6). It shares no code with the solver: slow, and only for a few hundred
/// unknowns.
class QuadraticProgram {
 public:
  /// `fixed`: elements that stay at `displacements`, which are from rest, space_dimension per element (mesh units).
  QuadraticProgram(const Mesh& mesh, const Softness& softness, const Cuts& cuts, std::span<const ElementId> fixed,
                   std::vector<double> displacements)
      : mesh_(mesh), softness_(softness), cuts_(cuts), at_(std::move(displacements)), unknown_(at_.size(), none) {
    std::vector<bool> is_fixed(mesh.element_count());
    for (const ElementId element : fixed) {
      is_fixed[element] = true;
    }
    for (std::size_t i = 0; i < at_.size(); ++i) {
      if (!is_fixed[i / dimension()]) {
        unknown_[i] = count_++;
      }
    }
    set_up();
  }

  /// Returns the displacements of the solution.
  std::vector<double> solve() {
    if (count_ > 0) {
      run();
    }
    std::vector<double> result = at_;
    for (std::size_t i = 0; i < result.size(); ++i) {
      if (unknown_[i] != none) {
        result[i] = x_[unknown_[i]];
      }
    }
    return result;
  }

  /// Returns the energy of displacements, fixed or not.
  double energy(const std::vector<double>& displacements) const {
    const Eigen::Map<const Eigen::VectorXd> u(displacements.data(), Eigen::Index(displacements.size()));
    return 0.5 * u.dot(whole_ * u);
  }

 private:
  static constexpr Eigen::Index none = -1;

  std::size_t dimension() const { return static_cast<std::size_t>(mesh_.space_dimension); }

  Eigen::VectorXd rest_vector(LinkId link) const {
    Eigen::VectorXd r(mesh_.space_dimension);
    for (std::size_t k = 0; k < dimension(); ++k) {
      r[Eigen::Index(k)] =
          mesh_.rest[mesh_.links[link][1] * dimension() + k] - mesh_.rest[mesh_.links[link][0] * dimension() + k];
    }
    return r;
  }

  void add_link(LinkId link) {
    const Eigen::VectorXd r = rest_vector(link);
    const LinkSoftness& own = softness_.of(link);
    const double length = r.norm();
    double weight = 1;
    Eigen::MatrixXd block = Eigen::MatrixXd::Identity(r.size(), r.size());
    if (softness_.energy == EnergyKind::axial) {
      const auto& shares = mesh_.shares.of(mesh_);
      weight = own.stiffness * std::pow(length, own.exponent) * (shares.empty() ? 1 : double(shares[link]));
      block = (r * r.transpose() / (length * length) + own.lateral * block).eval();
    }
    for (const int a : {0, 1}) {
      for (const int b : {0, 1}) {
        whole_.block(Eigen::Index(mesh_.links[link][std::size_t(a)] * dimension()),
                     Eigen::Index(mesh_.links[link][std::size_t(b)] * dimension()), r.size(), r.size()) +=
            (a == b ? weight : -weight) * block;
      }
    }
  }

  void set_up() {
    const auto size = Eigen::Index(at_.size());
    whole_ = Eigen::MatrixXd::Zero(size, size);
    std::vector<Eigen::VectorXd> rows;
    std::vector<double> limits;
    for (LinkId link = 0; link < mesh_.link_count(); ++link) {
      if (!cuts_.is_cut(link)) {
        add_link(link);
        for (std::size_t k = 0; k < dimension(); ++k) {
          add_bounds(link, k, rows, limits);
        }
      }
    }
    matrix_ = Eigen::MatrixXd::Zero(count_, count_);
    linear_ = Eigen::VectorXd::Zero(count_);
    for (std::size_t i = 0; i < at_.size(); ++i) {
      for (std::size_t j = 0; j < at_.size() && unknown_[i] != none; ++j) {
        const double entry = whole_(Eigen::Index(i), Eigen::Index(j));
        unknown_[j] != none ? matrix_(unknown_[i], unknown_[j]) = entry : linear_[unknown_[i]] += entry * at_[j];
      }
    }
    matrix_.diagonal().array() += 1e-9;  // parts that nothing holds stay where they are
    for (std::size_t i = 0; i < at_.size(); ++i) {
      if (unknown_[i] != none) {
        linear_[unknown_[i]] -= 1e-9 * at_[i];
      }
    }
    bounds_ = Eigen::MatrixXd::Zero(Eigen::Index(rows.size()), count_);
    limits_.resize(Eigen::Index(rows.size()));
    for (std::size_t i = 0; i < rows.size(); ++i) {
      bounds_.row(Eigen::Index(i)) = rows[i].transpose();
      limits_[Eigen::Index(i)] = limits[i];
    }
  }

  /// Adds low ≤ u_j − u_i ≤ high on one axis.
  void add_bounds(LinkId link, std::size_t k, std::vector<Eigen::VectorXd>& rows, std::vector<double>& limits) const {
    const auto [i, j] = mesh_.links[link];
    const Eigen::VectorXd r = rest_vector(link);
    const LinkSoftness& own = softness_.of(link);
    const double along = r[Eigen::Index(k)], others = r.lpNorm<1>() - std::abs(along);
    const double low = std::min(own.compression * along, own.stretch * along) - own.shear * others - along;
    const double high = std::max(own.compression * along, own.stretch * along) + own.shear * others - along;
    Eigen::VectorXd row = Eigen::VectorXd::Zero(count_);
    double constant = 0;
    for (const auto& [element, sign] : {std::pair(j, 1.0), std::pair(i, -1.0)}) {
      const std::size_t at = element * dimension() + k;
      unknown_[at] != none ? row[unknown_[at]] = sign : constant += sign * at_[at];
    }
    if (!row.isZero(0)) {
      rows.insert(rows.end(), {row, -row});
      // The method needs some room inside the bounds, also for rigid links and for taut chains.
      const double room = 1e-6 * mesh_.mean_link_length;
      limits.insert(limits.end(), {high - constant + room, constant - low + room});
    }
  }

  void run() {
    const Eigen::Index bounds = limits_.size();
    x_ = Eigen::VectorXd::Zero(count_);
    Eigen::VectorXd slack = (limits_ - bounds_ * x_).cwiseMax(1), force = Eigen::VectorXd::Ones(bounds);
    for (int i = 0; i < 200; ++i) {
      const Eigen::VectorXd dual = matrix_ * x_ + linear_ + bounds_.transpose() * force;
      const Eigen::VectorXd primal = bounds_ * x_ + slack - limits_;
      const double gap = bounds > 0 ? slack.dot(force) / double(bounds) : 0;
      if (dual.lpNorm<Eigen::Infinity>() < 1e-11 && gap < 1e-13 &&
          (bounds == 0 || primal.lpNorm<Eigen::Infinity>() < 1e-11)) {
        break;
      }
      const Eigen::VectorXd ratio = force.cwiseQuotient(slack);
      const Eigen::VectorXd target = Eigen::VectorXd::Constant(bounds, 0.15 * gap);
      const Eigen::MatrixXd system = matrix_ + bounds_.transpose() * ratio.asDiagonal() * bounds_;
      const Eigen::VectorXd push = target.cwiseQuotient(slack) - force + ratio.cwiseProduct(primal);
      if (!system.allFinite() || gap < 1e-15) {
        break;  // rounding: some links have no room at all
      }
      const Eigen::VectorXd step = system.ldlt().solve(-dual - bounds_.transpose() * push);
      const Eigen::VectorXd slack_step = -primal - bounds_ * step;
      const Eigen::VectorXd force_step = target.cwiseQuotient(slack) - force - ratio.cwiseProduct(slack_step);
      double length = 1;
      for (Eigen::Index k = 0; k < bounds; ++k) {
        length = std::min(length, slack_step[k] < 0 ? -0.99 * slack[k] / slack_step[k] : 1);
        length = std::min(length, force_step[k] < 0 ? -0.99 * force[k] / force_step[k] : 1);
      }
      x_ += length * step;
      slack += length * slack_step;
      force += length * force_step;
    }
  }

  const Mesh& mesh_;
  const Softness& softness_;
  const Cuts& cuts_;
  std::vector<double> at_;
  std::vector<Eigen::Index> unknown_;  // of each coordinate, or none
  Eigen::Index count_ = 0;
  Eigen::MatrixXd whole_, matrix_, bounds_;
  Eigen::VectorXd linear_, limits_, x_;
};

}  // namespace reference
