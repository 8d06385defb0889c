#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <optional>

#include "measure/distance.h"
#include "mesh/error.h"
#include "report/run/clocks.h"
#include "report/run/physics.h"
#include "report/run/preparing.h"
#include "report/run/runner.h"

namespace chainmail::report {
namespace {

// Contestants whose move takes longer than this (s), with all preparation, do not run on the turned objects.
constexpr double longest_answer = 10;

/// An angle by which an object is turned, and its figures.
struct Turn {
  double degrees;
  const Figure *max, *relative;
};
constexpr std::array turns{Turn{45, &figures::turned_45_max, &figures::turned_45_relative},
                           Turn{90, &figures::turned_90_max, &figures::turned_90_relative}};

/// Returns the axes turned with the object. Principal axes are found anew, as a user's would be.
RegionAxes turned(const RegionAxes& axes, const Mesh& mesh, const Eigen::Matrix3d& turn) {
  if (axes.kind() != AxesKind::given) {
    return axes_for(mesh, axes);
  }
  const Eigen::AngleAxisd both(Eigen::Matrix3d(turn * axes.matrix()));
  return {AxesKind::given, both.angle() * both.axis()};
}

/// Returns one move to the end of a drag without a cut.
RecordedMoves one_move(const Case& object) {
  const auto bend = std::ranges::find(object.drags, "bend", &RecordedMoves::name);
  const RecordedMoves& moves = bend == object.drags.end() ? object.drags.front() : *bend;
  RecordedMoves result{moves.name, moves.description, {moves.commands.front()}};
  for (const Command& command : moves.commands) {
    if (std::holds_alternative<commands::Drag>(command)) {
      result.commands.resize(1, command);
      result.commands.push_back(command);
    }
  }
  return result;
}

/// Returns the answer of a contestant, turned back: space_dimension coordinates per element. Throws Error, also if the
/// contestant does not reach its target.
std::vector<double> answer_of(const Case& object, const Contestant& contestant, const RunOptions& options,
                              const RegionAxes& back, const Progress& progress) {
  Runner runner(object, *contestant.algorithm, Precision::double_precision, options);
  runner.run(object.drags.front(), {contestant.sweeps, contestant.equilibrium}, progress);
  const Simulation& simulation = runner.simulation();
  if (const std::string& remark = simulation.statistics().remark; !remark.empty()) {
    throw Error(object.name, remark, "drag it less far");
  }
  std::vector<double> positions(object.mesh->rest.size());
  simulation.body().copy_positions(positions);
  for (std::size_t at = 0; at < positions.size(); at += std::size_t(object.mesh->space_dimension)) {
    turn_into_axes(*object.mesh, back, positions.data() + at);
  }
  return positions;
}

bool takes_part(const Contestant& contestant) {
  return contestant.algorithm && (contestant.sweeps == 0 || contestant.calibrated);
}

}  // namespace

Point rotation_by(const Mesh& mesh, double degrees) {
  const Point axis = mesh.space_dimension == 2 ? Point(Point::Unit(mesh.axes[0]).cross(Point::Unit(mesh.axes[1])))
                                               : Point(Point::Unit(2));
  return axis * (degrees * std::numbers::pi / 180);
}

Case turned(const Case& object, const Point& rotation) {
  const RegionAxes turn(AxesKind::given, rotation), back(AxesKind::given, -rotation);
  Case result = object;
  result.mesh = in_axes(object.mesh, back);
  result.softness.axes = turned(object.softness.axes, *result.mesh, turn.matrix());
  for (RecordedMoves& moves : result.drags) {
    for (Command& command : moves.commands) {
      if (auto* drag = std::get_if<commands::Drag>(&command)) {
        drag->target = turn.into_world(drag->target);
        drag->rotation.axis = turn.into_world(drag->rotation.axis);
      }
    }
  }
  return result;
}

void add_turned(Results& results, const Case& asked, const std::vector<Contestant>& contestants,
                const RunOptions& options, const Progress& progress) {
  if (asked.mesh->space_dimension < 2 || asked.drags.empty()) {
    return;
  }
  const Clocks clocks = machine_clocks();
  Case object = asked;
  object.drags = {one_move(asked)};
  for (std::size_t i = 0; i < contestants.size() && !progress.cancelled(); ++i) {
    progress.show(double(i) / double(contestants.size()));
    if (!takes_part(contestants[i])) {
      continue;
    }
    Row row{.object = results.objects.size() - 1, .contestant = contestants[i]};
    object.softness = softness_of(contestants[i], asked.softness);
    try {
      const Mesh& mesh = *object.mesh;
      const double start = clocks.wall();
      const std::vector<double> own = answer_of(object, contestants[i], options, {}, progress);
      if (const double seconds = clocks.wall() - start; seconds > longest_answer) {
        throw Error(object.name, "one move takes " + std::to_string(int(seconds)) + " s, so it is not repeated turned",
                    "use a smaller object");
      }
      const double displacement = measure_distance(mesh, view_of(mesh, own), view_of(mesh, mesh.rest)).rms;
      for (const Turn& turn : turns) {
        const Point rotation = rotation_by(mesh, turn.degrees);
        const std::vector<double> back = answer_of(turned(object, rotation), contestants[i], options,
                                                   RegionAxes(AxesKind::given, rotation), progress);
        const Distance apart = measure_distance(mesh, view_of(mesh, own), view_of(mesh, back));
        row.set(*turn.max, apart.max);
        row.set(*turn.relative, displacement > 0 ? apart.rms / displacement : 0);
      }
    } catch (const Error& error) {
      row.figures.clear();
      row.refusal = error.what();
    }
    if (!progress.cancelled()) {
      results.rows.push_back(std::move(row));
    }
  }
}

}  // namespace chainmail::report
