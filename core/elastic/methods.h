#pragma once

#include <memory>

#include "elastic/elastic.h"

namespace chainmail {

// One maker a method, behind make_elastic, which has checked the options, the kind and the size of the object.
std::unique_ptr<ElasticSolver> make_linear_fem(const ElasticProblem& problem, const Progress& progress);
std::unique_ptr<ElasticSolver> make_neo_hookean(const ElasticProblem& problem, const Progress& progress);
std::unique_ptr<ElasticSolver> make_boundary_elements(const ElasticProblem& problem, const Progress& progress);
std::unique_ptr<ElasticSolver> make_free_form(const ElasticProblem& problem, const Progress& progress);

}  // namespace chainmail
