#include "elastic/methods.h"
#include "mesh/error.h"

namespace chainmail {

std::unique_ptr<ElasticSolver> make_free_form(const ElasticProblem& /*problem*/, const Progress& /*progress*/) {
  throw Error("free_form", "it is not built yet", "choose another method");
}

}  // namespace chainmail
