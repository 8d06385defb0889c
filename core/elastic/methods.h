#pragma once

#include <cstdint>
#include <memory>

#include "elastic/elastic.h"

namespace chainmail {

// One maker a method, behind make_elastic, which has checked the options, the kind and the size of the object.
std::unique_ptr<ElasticSolver> make_linear_fem(const ElasticProblem& problem, const Progress& progress);
std::unique_ptr<ElasticSolver> make_neo_hookean(const ElasticProblem& problem, const Progress& progress);
std::unique_ptr<ElasticSolver> make_boundary_elements(const ElasticProblem& problem, const Progress& progress);
std::unique_ptr<ElasticSolver> make_free_form(const ElasticProblem& problem, const Progress& progress);

/// Throws Error where boundary elements cannot take a surface of so many triangles, with so many elements about and in
/// the volume inside, none for a surface alone.
void check_boundary_size(std::uint64_t triangles, std::uint64_t elements_of_cells);

}  // namespace chainmail
