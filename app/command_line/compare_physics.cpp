#include <algorithm>

#include "command_line/compare_options.h"
#include "command_line/progress_line.h"

namespace chainmail::command_line {
namespace {

api::CompareOptions physics_options(const CompareArguments& arguments, const std::string& command_line) {
  api::CompareOptions options = contest_of(arguments, "0,1,3,10,30,100,equilibrium", command_line);
  options.against = api::Reference::physics;
  options.seconds = 1.5;
  std::ranges::sort(options.sweeps);  // in ascending order, because a curve connects them
  options.calibrated = is_calibrated(arguments, true);
  const std::string reference = value_of(arguments.reference).value_or("same-cells");
  check_word("--reference", reference, {"same-cells", "refined"});
  options.refined = reference == "refined";
  const auto seconds = value_of(arguments.grow);
  options.growth_seconds = seconds ? parse_number_of("--grow", *seconds) : 1;
  if (options.growth_seconds < 0) {
    throw api::Error("--grow", *seconds + " is below 0", "use a number of seconds, or 0");
  }
  return options;
}

std::vector<api::ComparedObject> physics_objects(const CompareArguments& arguments, const api::Elasticity& elastic) {
  if (arguments.moves->count() > 0) {
    throw api::Error("--moves", "the comparison with physics uses its own drags", "leave out the option");
  }
  if (arguments.meshes->count() == 0) {
    return built_in_objects(api::Reference::physics, arguments, elastic);
  }
  std::vector<api::ComparedObject> objects;
  for (const std::string& file : arguments.meshes->results()) {
    api::ComparedObject object = object_of(file, arguments);
    object.body.pin(pins_of(arguments.pins, api::printable(object.name), object.body.mesh()));
    object.body.set_elasticity(elastic);
    objects.push_back(std::move(object));
  }
  return objects;
}

}  // namespace

void compare_with_physics(const CompareArguments& arguments, const std::string& command_line) {
  api::CompareOptions options = physics_options(arguments, command_line);
  OutputFolder folder(*value_of(arguments.output));
  const api::Elasticity elastic = elastic_of(arguments.elastic);
  options.materials = strain_laws_of(arguments.laws, elastic);
  const auto objects = physics_objects(arguments, elastic);
  const api::Comparison comparison = [&] {
    const Watch watch(report_progress);
    return api::compare(objects, options, watch.job());
  }();
  write_report(folder, comparison.files(), comparison.text());
}

}  // namespace chainmail::command_line
