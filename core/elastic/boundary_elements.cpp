#include "elastic/methods.h"
#include "mesh/error.h"

namespace chainmail {

std::unique_ptr<ElasticSolver> make_boundary_elements(const ElasticProblem& /*problem*/, const Progress& /*progress*/) {
  throw Error("boundary_elements", "it is not built yet", "choose another method");
}

}  // namespace chainmail
