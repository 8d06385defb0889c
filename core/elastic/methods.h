#pragma once

#include <cstdint>
#include <memory>

#include "elastic/elastic.h"

namespace chainmail {

// Makers of the methods, for the table in elastic.cpp. make_elastic has checked options, kind and size of the object.
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

}  // namespace chainmail
