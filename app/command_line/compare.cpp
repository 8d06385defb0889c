#include "command_line/compare_options.h"
#include "command_line/folder.h"
#include "command_line/progress_line.h"
#include "command_line/report_origin.h"
#include "files/results/report_json.h"
#include "files/session/moves.h"
#include "files/text/outputs.h"
#include "files/text/text.h"
#include "mesh/error.h"
#include "report/page/csv.h"
#include "report/page/html.h"
#include "report/page/table.h"
#include "report/run/drags.h"
#include "report/run/runner.h"
#include "simulate/move_history.h"

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

/// Returns the drags of an object: the recorded ones, or the three standard drags.
std::vector<report::RecordedMoves> drags_of(const report::Case& object, const std::optional<std::string>& recorded) {
  if (!recorded) {
    return report::three_drags(object);
  }
  const std::filesystem::path path = *recorded;
  Watch watch("reading " + printable(*recorded));
  report::RecordedMoves moves{"recorded", "recorded in " + printable(path.filename().string()),
                              read_moves(path, object.mesh, watch.progress())};
  if (first_mesh(moves.commands)) {
    throw Error(printable(*recorded), "its moves split the object, which a comparison cannot repeat",
                "save the split object, and record moves of it");
  }
  if (report::count_moves(moves) == 0) {
    throw Error(printable(*recorded), "it contains no move", "write a grab and a drag, as in compare --help");
  }
  return {std::move(moves)};
}

std::vector<report::Case> cases_to_compare(const CompareArguments& options) {
  const Softness softness = softness_of(options);
  const auto recorded = value_of(options.moves);
  if (options.meshes->count() == 0 && recorded) {
    throw Error("--moves", "the mesh of the recorded moves is missing", "add its file");
  }
  if (options.meshes->count() == 0) {
    refuse_pins(options);
    return with_axes(report::default_cases(softness), options);
  }
  std::vector<report::Case> cases;
  for (const std::string& name : options.meshes->results()) {
    report::Case object = case_of(name, options);
    object.elastic = elastic_of(options.elastic);
    if (options.pins->count() > 0) {
      object.pins = pins_of(options.pins, object.name, *object.mesh);
    }
    object.drags = drags_of(object, recorded);
    cases.push_back(std::move(object));
  }
  return cases;
}

void refuse_physics(const CompareArguments& arguments) {
  for (const CLI::Option* option : {arguments.grow, arguments.calibrated, arguments.reference, arguments.laws.materials,
                                    arguments.laws.gent_limit, arguments.laws.fung_exponent}) {
    if (option->count() > 0) {
      throw Error(option->get_name(), "it works only with --against physics", "add --against physics");
    }
  }
}

void refuse_suite(const CompareArguments& arguments) {
  for (const CLI::Option* option : {arguments.experiments, arguments.shard}) {
    if (option->count() > 0) {
      throw Error(option->get_name(), "it works only with --suite", "add --suite");
    }
  }
}

void compare(const CompareArguments& options, const std::string& command_line) {
  const report::CompareOptions how = contest_of(options, every_algorithm(), "0,10,equilibrium");
  OutputFolder folder(*value_of(options.output));
  const std::vector<report::Case> cases = cases_to_compare(options);

  ProgressLine line;
  const report::Comparison comparison = report::compare(cases, how, [&](double fraction, const std::string& text) {
    line.show([&] { return percent(fraction) + text; });
  });
  const report::Origin origin = origin_of(command_line);

  folder.make();
  Outputs outputs;
  outputs.add(folder.path() / "report.html", [&](std::ostream& out) { write_html(out, comparison, origin); });
  outputs.add(folder.path() / "report.json", [&](std::ostream& out) { write_json(out, comparison, origin); });
  outputs.add(folder.path() / "report.csv", [&](std::ostream& out) { write_csv(out, comparison); });
  outputs.add("-", [&](std::ostream& out) { write_text(out, comparison); });
  outputs.commit();
  folder.keep();
  folder.say_older_plots({});
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
