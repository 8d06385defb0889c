#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "elastic/elastic.h"

namespace chainmail {

/// The answer of a linear method: the displacement field for the pins alone, and the response of the field to a unit
/// displacement of the handle from there. A move is one product of a matrix and a vector (condensation: Bro-Nielsen and
/// Cotin 1996).
class LinearResponse : public ElasticSolver {
 public:
  void hold(ElementId element, const Progress& progress) final;
  void move(std::span<const double> displacement, const Progress& progress) final;
  void reset() final;
  const std::vector<double>& displacements() const final { return displacements_; }
  const std::string& remark() const final { return none_; }

 protected:
  explicit LinearResponse(const ElasticProblem& problem);

  /// Sets the field while only the pins are prescribed (n coordinates per element). The constructor of a method calls
  /// this.
  void set_base(std::vector<double> displacements);
  /// Returns the response of the field to a unit displacement of an element along each axis, while the pins stay: n
  /// columns, n coordinates per element. It is the identity at the element itself.
  virtual Eigen::MatrixXd respond(ElementId element, const Progress& progress) = 0;

 private:
  int dimension_;
  ElementId held_;
  std::vector<double> base_, displacements_;
  Eigen::MatrixXd response_;
  std::string none_;
};

}  // namespace chainmail
