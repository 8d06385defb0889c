#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "elastic/elastic.h"

namespace chainmail {

/// The answer of a linear method: a displacement field for the pins alone, and how the field answers to each unit of
/// the hand's way from there. A move is a product of a matrix and a vector (condensation: Bro-Nielsen and Cotin 1996).
class LinearResponse : public ElasticSolver {
 public:
  void hold(ElementId element, const Progress& progress) final;
  void move(std::span<const double> displacement, const Progress& progress) final;
  void reset() final;
  const std::vector<double>& displacements() const final { return displacements_; }
  const std::string& remark() const final { return none_; }

 protected:
  explicit LinearResponse(const ElasticProblem& problem);

  /// To be called by the constructor of a method: the field while the pins alone are prescribed (n coordinates an
  /// element).
  void set_base(std::vector<double> displacements);
  /// How the field answers to unit displacements of an element along each axis while the pins stay: n coordinates an
  /// element in each of the n columns, at the element itself the identity.
  virtual Eigen::MatrixXd respond(ElementId element, const Progress& progress) = 0;

 private:
  int dimension_;
  ElementId held_;
  std::vector<double> base_, displacements_;
  Eigen::MatrixXd response_;
  std::string none_;
};

}  // namespace chainmail
