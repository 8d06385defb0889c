#pragma once

#include <string>
#include <vector>

#include "elastic/elastic.h"
#include "elastic/simplices.h"

namespace chainmail {

/// A method that finds the static answer by iterations from the last one. If they do not converge, the answer is the
/// last iterate, and a remark says so.
class IteratedSolver : public ElasticSolver {
 public:
  void hold(const ElasticHandle& handle, const Progress& progress) final;
  void move(const ElasticMotion& motion, const Progress& progress) final;
  void reset() final;
  void start_from(std::span<const double> displacements) final;
  const std::vector<double>& displacements() const final { return displacements_; }
  const std::string& remark() const final { return remark_; }
  bool reached() const final { return true; }
  bool follows_path() const final { return true; }

 protected:
  IteratedSolver(const ElasticProblem& problem, const Simplices& cells);

  /// Computes the answer to the pins alone. The constructor of a method calls this last.
  void find_base(const Progress& progress);
  /// Prepares for these elements with prescribed displacements.
  virtual void prescribe(const std::vector<ElementId>& prescribed, const Progress& progress) = 0;
  /// Improves the displacements of the other elements. Returns an empty text if they converged, else the reason.
  virtual std::string relax(std::vector<double>& displacements, const Progress& progress) = 0;

 private:
  ElasticProblem problem_;
  std::vector<bool> in_cell_;  // of each element
  ElasticHandle handle_;
  bool holds_ = false;
  std::vector<double> base_, displacements_;
  std::string base_remark_, remark_;
};

/// Returns the remark of a method that still moves elements by up to `step` (mean edge lengths) after so many
/// iterations.
std::string not_converged(std::uint32_t iterations, double step);

/// Returns the displacements of all elements (space_dimension coordinates each) in the rigid motion that comes closest
/// to those of the pins. The search for the answer to displaced pins starts there.
std::vector<double> rigid_fit(const ElasticProblem& problem);

}  // namespace chainmail
