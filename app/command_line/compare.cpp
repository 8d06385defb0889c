#include "command_line/compare_options.h"
#include "command_line/progress_line.h"

namespace chainmail::command_line {
namespace {

constexpr const char* compare_footer =
    "Without MESH, six built-in objects are used, which takes about two minutes. Each object is dragged three times\n"
    "from rest: locally, as a whole, and back and forth. Writes report.html, report.json and report.csv to FOLDER and\n"
    "prints the main table.\n\n"
    "--against physics: the reference is neo-Hookean FEM on the same cells. The methods of elasticity and an\n"
    "object that does not move are added. Without MESH, a bar and a sheet are used. Each object is nudged, pulled and\n"
    "bent, near and far, at three handles, and cut once between two moves. FOLDER also receives the plots as SVG.\n\n"
    "Recorded moves are JSON. Other commands are release, pin, unpin, cut, uncut, softness, relax and reset:\n"
    "  {\"version\": 1, \"commands\": [{\"do\": \"pin\", \"elements\": [0]}, {\"do\": \"grab\", \"element\": 5},\n"
    "    {\"do\": \"drag\", \"target\": [1, 2, 0]}, {\"do\": \"drag\", \"target\": [2, 3, 0]},\n"
    "    {\"do\": \"grab\", \"elements\": [5, 6]}, {\"do\": \"drag\", \"by\": [1, 2, 0],\n"
    "     \"rotate\": {\"axis\": [0, 0, 1], \"degrees\": 20}}]}\n\n"
    "Example:\n"
    "  chainmail compare cloth.obj --algorithms natural-queue,exact --relax 0,10 -o report\n"
    "  chainmail compare organ.msh --against physics --pins bottom --poisson 0.45 -o report\n"
    "  chainmail compare --suite -o suite\n"
    "  chainmail compare --merge part1/report.json part2/report.json -o suite";

/// Reads recorded moves of an object that a comparison can repeat.
api::RecordedMoves moves_of(const std::string& file, const api::Mesh& mesh) {
  const std::string name = api::printable(file);
  const Watch watch("reading " + name);
  api::RecordedMoves moves = api::read_moves(file, mesh, watch.job());
  if (!(moves.last_mesh() == mesh)) {
    throw api::Error(name, "its moves split the object, which a comparison cannot repeat",
                     "save the split object, and record moves of it");
  }
  if (moves.pass_count() == 0) {
    throw api::Error(name, "it contains no move", "write a grab and a drag, as in compare --help");
  }
  return moves;
}

std::vector<api::ComparedObject> objects_to_compare(const CompareArguments& options) {
  const auto recorded = value_of(options.moves);
  if (options.meshes->count() == 0 && recorded) {
    throw api::Error("--moves", "the mesh of the recorded moves is missing", "add its file");
  }
  if (options.meshes->count() == 0) {
    return built_in_objects(api::Reference::exact, options, {});
  }
  std::vector<api::ComparedObject> objects;
  for (const std::string& name : options.meshes->results()) {
    api::ComparedObject object = object_of(name, options);
    object.body.set_elasticity(elastic_of(options.elastic));
    if (options.pins->count() > 0) {
      object.body.pin(pins_of(options.pins, api::printable(object.name), object.body.mesh()));
    }
    if (recorded) {
      object.recorded.push_back(moves_of(*recorded, object.body.mesh()));
    }
    objects.push_back(std::move(object));
  }
  return objects;
}

void refuse_physics(const CompareArguments& arguments) {
  for (const CLI::Option* option : {arguments.grow, arguments.calibrated, arguments.reference, arguments.laws.materials,
                                    arguments.laws.gent_limit, arguments.laws.fung_exponent}) {
    if (option->count() > 0) {
      throw api::Error(option->get_name(), "it works only with --against physics", "add --against physics");
    }
  }
}

void refuse_suite(const CompareArguments& arguments) {
  for (const CLI::Option* option : {arguments.experiments, arguments.shard}) {
    if (option->count() > 0) {
      throw api::Error(option->get_name(), "it works only with --suite", "add --suite");
    }
  }
}

void compare(const CompareArguments& options, const std::string& command_line) {
  const api::CompareOptions how = contest_of(options, "0,10,equilibrium", command_line);
  OutputFolder folder(*value_of(options.output));
  const auto objects = objects_to_compare(options);
  const api::Comparison comparison = [&] {
    const Watch watch(report_progress);
    return api::compare(objects, how, watch.job());
  }();
  write_report(folder, comparison.files(), comparison.text());
}

}  // namespace

Command add_compare(CLI::App& root, const std::string& command_line) {
  CLI::App* app = root.add_subcommand("compare", "Compare algorithms: a report of time against error");
  const CompareArguments arguments = add_compare_arguments(*app);
  app->footer(compare_footer);
  return {app, [app, arguments, command_line] {
            if (arguments.merge->count() > 0) {
              return merge_suites(*app, arguments);
            }
            if (arguments.judge->count() > 0) {
              return judge_answers(*app, arguments);
            }
            if (arguments.cases->count() > 0) {
              return write_cases(*app, arguments);
            }
            if (arguments.suite->count() > 0) {
              return run_suite(*app, arguments, command_line);
            }
            refuse_suite(arguments);
            const std::string against = value_of(arguments.against).value_or("exact");
            check_word("--against", against, {"exact", "physics"});
            if (against == "physics") {
              compare_with_physics(arguments, command_line);
            } else {
              refuse_physics(arguments);
              compare(arguments, command_line);
            }
          }};
}

}  // namespace chainmail::command_line
