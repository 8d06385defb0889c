#pragma once

#include <map>
#include <memory>

#include "measure/equilibrium.h"
#include "report/run/runner.h"

namespace chainmail::report {

/// Measures the errors of contestants on a drag, against Exact ChainMail in double and against the same contestant in
/// the other precision.
class References {
 public:
  References(const Case& object, const RecordedMoves& moves, const CompareOptions& options, const Progress& progress);

  /// Reason why there is no result of Exact ChainMail for comparison; empty if there is one.
  const std::string& no_exact() const { return no_exact_; }

  /// Returns the errors of a contestant whose run has just ended.
  Errors errors_of(const Runner& runner, const Contestant& contestant);

 private:
  Distance float_to_double(const Runner& runner, const Contestant& contestant);
  void find_equilibrium();

  const Case& object_;
  const RecordedMoves& moves_;
  const CompareOptions& options_;
  const Progress& progress_;
  std::unique_ptr<Runner> exact_;
  double energy_of_exact_ = 0;
  std::optional<Equilibrium> equilibrium_;  // only if it is a reference for all elements
  std::string no_exact_;
  std::unique_ptr<Runner> other_;  // runs the algorithm of the last contestant in the other precision
};

}  // namespace chainmail::report
