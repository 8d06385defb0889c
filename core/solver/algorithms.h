#pragma once

#include <memory>
#include <optional>
#include <span>
#include <string_view>

#include "body/method.h"
#include "elastic/elastic.h"
#include "mesh/mesh.h"

namespace chainmail {

/// ChainMail, or the methods that ChainMail is compared with.
enum class Family { chainmail, elastic };

/// Mark of an algorithm in plots.
struct PlotStyle {
  std::string_view path;    // SVG path about (0, 0), of size 1
  std::string_view colour;  // empty: the colour of lines and text
};

struct RecordedPass;   // see chainmail/recorded_pass.h
class WaitingHistory;  // see chainmail/recorded_pass.h

/// One row of the algorithm table: everything that other code knows about an algorithm.
struct AlgorithmInfo {
  Algorithm algorithm;
  std::string_view name;        // value in JSON, CSV and session files; the command line accepts it
  std::string_view alias = {};  // another name for the command line, which offers it instead of `name`
  std::string_view label;       // title in the window and in reports
  std::string_view source;      // publication
  std::string_view summary;     // one sentence for help texts
  PlotStyle style;

  MakeMethod make;  // what answers a move
  /// Finds the waiting list of a recorded pass at each of its steps; null if the algorithm has no list.
  WaitingHistory (*history)(const RecordedPass& pass) = nullptr;
  std::optional<ElasticMethod> elastic = {};  // of the methods of elasticity

  // What the object needs. Methods of elasticity also need cells or faces: see ElasticMethod::check.
  bool needs_grid = false;  // links along the axes only
  bool needs_pins = false;

  // What other code may assume.
  bool holds_links = false;       // all links are valid after each pass
  bool from_rest = false;         // the body stores displacements from rest instead of positions
  bool obeys_iterations = false;  // ElasticOptions::iterations limits its iterations

  /// Owns the texts above, if they are not literals.
  std::shared_ptr<const void> texts = {};

  Family family() const { return elastic ? Family::elastic : Family::chainmail; }
  /// Name in help texts and in messages of the command line.
  std::string_view offered_name() const { return alias.empty() ? name : alias; }
  /// True if softness changes the answer.
  bool uses_softness() const { return family() == Family::chainmail; }
  /// True if relaxation may follow a pass. The answer of the other methods is an equilibrium already.
  bool relaxes() const { return family() == Family::chainmail; }
  /// True if a program added it to the table: see add_algorithm.
  bool is_added() const { return texts != nullptr; }
  /// True if a pass is a series of steps, element after element, that can be replayed.
  bool has_steps() const { return family() == Family::chainmail && !is_added(); }
  /// True if the algorithm can answer any state at once when it takes over, without a move.
  bool answers_any_state() const { return holds_links || family() == Family::elastic; }
};

/// Returns the ChainMail family, in the order of menus and tables.
std::span<const AlgorithmInfo> algorithms();
/// Returns the methods that ChainMail is compared with.
std::span<const AlgorithmInfo> elastic_algorithms();
/// Returns the ChainMail family, then the others.
std::span<const AlgorithmInfo> every_algorithm();
/// Returns the entry of an algorithm.
const AlgorithmInfo& info(Algorithm algorithm);
/// Returns the algorithm with this name or alias, if any.
std::optional<Algorithm> find_algorithm(std::string_view name);
/// Returns the algorithm with this name or alias. Throws Error, with all names, if there is none.
Algorithm algorithm_of(std::string_view name);

/// Returns the waiting list at each step of a recorded pass. The history is unknown (see WaitingHistory::known) if the
/// algorithm has no list.
WaitingHistory waiting_history(const RecordedPass& pass);

/// True if the algorithm works on the mesh.
bool fits(Algorithm algorithm, const Mesh& mesh);
/// Throws Error, with the reason, if the algorithm does not work on the mesh.
void check(Algorithm algorithm, const Mesh& mesh);

/// Returns the largest number of elements of a solid in space that a method of elasticity works on; none if there is no
/// limit.
std::optional<std::uint64_t> max_solid_elements(Algorithm method);
/// Makes a solver of a method of elasticity. Throws Error if the method does not work on the object or if options are
/// out of range, and as ElasticMethod::make.
std::unique_ptr<ElasticSolver> make_elastic(Algorithm method, const ElasticProblem& problem,
                                            const Progress& progress = {});

/// Adds an entry to the table for good, in its family, and returns its new number; that of `entry` is ignored. No other
/// thread may read the table meanwhile, and references to entries become invalid.
Algorithm add_algorithm(AlgorithmInfo entry);

/// Adds an entry to the table while this object exists. For tests: no other thread may read the table meanwhile, and
/// references to entries become invalid.
class ExtraAlgorithm {
 public:
  explicit ExtraAlgorithm(const AlgorithmInfo& entry);
  ExtraAlgorithm(const ExtraAlgorithm&) = delete;
  ExtraAlgorithm& operator=(const ExtraAlgorithm&) = delete;
  ~ExtraAlgorithm();

 private:
  Algorithm algorithm_;
};

}  // namespace chainmail
