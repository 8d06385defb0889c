#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "elastic/elastic.h"

namespace chainmail {

/// The answer of a linear method: the displacement field for the pins alone, and the responses of the field to unit
/// motions of the handle from there. A move is one product of a matrix and a vector (condensation: Bro-Nielsen and
/// Cotin 1996).
///
/// The displacement of a handle of many elements is linear in its translation and in R − I of its rotation R: in space
/// these are 12 columns, and one more for its shape if that was deformed when it was grabbed.
class LinearResponse : public ElasticSolver {
 public:
  void hold(const ElasticHandle& handle, const Progress& progress) final;
  void move(const ElasticMotion& motion, const Progress& progress) final;
  void reset() final;
  const std::vector<double>& displacements() const final { return displacements_; }
  const std::string& remark() const final { return none_; }

 protected:
  explicit LinearResponse(const ElasticProblem& problem);

  /// Sets the field while only the pins are prescribed (n coordinates per element). The constructor of a method calls
  /// this.
  void set_base(std::vector<double> displacements);
  /// Forgets the response to the handle, because the object has changed.
  void forget_handle() { response_.resize(0, 0); }
  /// Returns the response of the field to displacements of some elements (ascending), while the pins stay: one column
  /// for each column of `prescribed`, which has n rows per element. At the elements themselves it is what is
  /// prescribed.
  virtual Eigen::MatrixXd respond(std::span<const ElementId> elements, const Eigen::MatrixXd& prescribed,
                                  const Progress& progress) = 0;

 private:
  /// The displacements of the handle for each of its columns.
  Eigen::MatrixXd columns(const ElasticHandle& handle) const;

  int dimension_;
  ElasticHandle handle_;
  std::vector<double> base_, displacements_;
  Eigen::MatrixXd response_;  // empty without a handle
  std::string none_;
};

}  // namespace chainmail
