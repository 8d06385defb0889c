#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <string>

#include "elastic/elastic.h"

namespace chainmail {

/// Largest number of elements by space dimension, for acceptable time and memory of a factorization (measured).
using SizeLimits = std::array<std::uint64_t, 4>;
inline constexpr SizeLimits linear_limit{0, 1'000'000, 150'000, 30'000};
inline constexpr SizeLimits nonlinear_limit{0, 100'000, 20'000, 6'000};
inline constexpr SizeLimits edge_limit{0, 1'000'000, 150'000, 100'000};
inline constexpr std::uint64_t boundary_inner_limit = 5'000;  // elements of volumes; takes 3 s more for each new handle

// Checks of the kind and size of an object: see ElasticMethod::check.
void check_fem(const std::string& where, const Mesh& mesh, const SizeLimits& limits);
/// For methods that work on the edges of cells or faces, of surfaces in space as well.
void check_cells(const std::string& where, const Mesh& mesh);
void check_boundary(const Mesh& mesh);

// Makers: see ElasticMethod::make. Options, kind and size of the object have been checked.
// make_neo_hookean and make_corotational are in nonlinear_fem.cpp.
std::unique_ptr<ElasticSolver> make_linear_fem(const ElasticProblem& problem, const Progress& progress);
std::unique_ptr<ElasticSolver> make_neo_hookean(const ElasticProblem& problem, const Progress& progress);
std::unique_ptr<ElasticSolver> make_boundary_elements(const ElasticProblem& problem, const Progress& progress);
std::unique_ptr<ElasticSolver> make_free_form(const ElasticProblem& problem, const Progress& progress);
std::unique_ptr<ElasticSolver> make_corotational(const ElasticProblem& problem, const Progress& progress);
std::unique_ptr<ElasticSolver> make_arap(const ElasticProblem& problem, const Progress& progress);
std::unique_ptr<ElasticSolver> make_xpbd(const ElasticProblem& problem, const Progress& progress);
std::unique_ptr<ElasticSolver> make_projective(const ElasticProblem& problem, const Progress& progress);
std::unique_ptr<ElasticSolver> make_quasi_newton(const ElasticProblem& problem, const Progress& progress);
std::unique_ptr<ElasticSolver> make_neo_hookean_xpbd(const ElasticProblem& problem, const Progress& progress);

/// Throws Error if boundary elements do not support so many triangles, or so many elements of a volume (0 for a
/// surface).
void check_boundary_size(std::uint64_t triangles, std::uint64_t elements_of_cells);

/// A solver that can go on after links were cut or restored, with less work than a new one needs.
class CutUpdate {
 public:
  virtual ~CutUpdate() = default;

  /// Goes on with these cuts of the same mesh, at rest or at the answer to the pins, without a handle. Later answers
  /// are those of a new solver, bit for bit. Returns false if it cannot: a new solver is needed then. Throws Error as
  /// making one does, and Cancelled; the solver is of no use after that.
  virtual bool recut(const Cuts& cuts, const Progress& progress) = 0;
};

}  // namespace chainmail
