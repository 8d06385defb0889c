#include "chainmail/method.h"

#include "api/access.h"
#include "solver/algorithms.h"

namespace chainmail::api {
namespace {

MethodInfo info_of(const AlgorithmInfo& one) {
  return {.name = std::string(one.offered_name()),
          .label = std::string(one.label),
          .source = std::string(one.source),
          .summary = std::string(one.summary),
          .family = one.family() == Family::chainmail ? MethodFamily::chainmail : MethodFamily::elastic,
          .needs_grid = one.needs_grid,
          .needs_pins = one.needs_pins,
          .holds_links = one.holds_links,
          .is_registered = one.is_added()};
}

}  // namespace

std::vector<MethodInfo> methods() {
  std::vector<MethodInfo> all;
  for (const AlgorithmInfo& one : every_algorithm()) {
    all.push_back(info_of(one));
  }
  return all;
}

MethodInfo method_info(std::string_view name) { return info_of(info(algorithm_of(name))); }

void check_method(std::string_view method, const Mesh& mesh) {
  const Algorithm algorithm = algorithm_of(method);
  guarded([&] { check(algorithm, *Access::pointer(mesh)); });
}

std::string refusal(std::string_view method, const Mesh& mesh) {
  const Algorithm algorithm = algorithm_of(method);
  try {
    check(algorithm, *Access::pointer(mesh));
  } catch (const inner::Error& error) {
    return error.what();
  }
  return {};
}

}  // namespace chainmail::api
