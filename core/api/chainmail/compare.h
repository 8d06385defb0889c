#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "chainmail/body.h"
#include "chainmail/handle.h"
#include "chainmail/job.h"
#include "chainmail/measure.h"
#include "chainmail/types.h"

namespace chainmail::api {

struct Access;

/// A drag from rest: grabs elements, then moves them along a path, one pass per motion.
struct Drag {
  std::string name = {};                 ///< Name in the table.
  std::vector<ElementId> elements = {};  ///< The grabbed elements.
  std::vector<Motion> path = {};         ///< Motions from where they were grabbed, at least one.
};

/// What errors refer to.
enum class Reference {
  exact,   ///< Exact ChainMail in double, on the same drags.
  physics  ///< Neo-Hookean finite elements on the same cells. The object needs pins, and drags grab one element.
};

/// Options of a comparison.
struct CompareOptions {
  std::string title = "object";           ///< Name of the object in the report.
  std::vector<std::string> methods = {};  ///< Names of methods. Empty: the ChainMail family; against physics, all.
  std::vector<int> sweeps{0};             ///< Numbers of sweeps of relaxation after each move; one row for each.
  bool equilibrium = false;  ///< Whether Natural Queue and Exact also relax to the equilibrium; a row each.
  double relax_step = 1;     ///< Share of the way that an element moves per sweep: above 0, to 1.
  RelaxationScheme scheme = RelaxationScheme::mean;   ///< Relaxation scheme of the sweeps: mean or link.
  Precision precision = Precision::single_precision;  ///< Precision of the methods. References are in double.
  /// Number of runs of each drag, for times. Default: as many as fit in `seconds`.
  std::optional<int> repetitions = {};
  double seconds = 4;                    ///< Time for all runs of one drag (s).
  Reference against = Reference::exact;  ///< What errors refer to.
};

/// A row of the table: one method with a number of sweeps, on one drag. A figure that was not measured is empty.
struct ComparisonRow {
  std::string drag = {};     ///< Name of the drag.
  std::string method = {};   ///< Name of the method; `nothing` for an object of which only handle and pins move.
  std::string label = {};    ///< Title of the method, with its sweeps.
  int sweeps = 0;            ///< Sweeps of relaxation after each move.
  bool equilibrium = false;  ///< True: relaxed to the equilibrium after each move.
  std::string refusal = {};  ///< Reason why there is no result; empty if there is one.

  std::optional<double> ms_per_move = {};     ///< Median time of a pass with its sweeps (ms).
  std::optional<double> lower_quartile = {};  ///< Lower quartile of that time (ms).
  std::optional<double> upper_quartile = {};  ///< Upper quartile of that time (ms).
  std::optional<double> prepare_ms = {};      ///< Time of the preparation before the first move (ms), against physics.

  std::optional<Violation> violation = {};       ///< Violation at the end of the drag.
  std::optional<Spread> to_exact = {};           ///< Distance to Exact ChainMail, in mean rest lengths.
  std::optional<double> energy_over_exact = {};  ///< Elastic energy over that of Exact ChainMail.
  std::optional<Spread> float_to_double = {};    ///< Distance between the method in float and in double.
  std::optional<PhysicalError> to_physics = {};  ///< Error against the reference solution, against physics.
};

/// The result of compare(). Copies share the data.
class Comparison {
 public:
  /// The table: object by object, drag by drag, method by method. Valid while a copy of the comparison exists.
  const std::vector<ComparisonRow>& rows() const&;
  /// The table of a comparison that is not kept.
  std::vector<ComparisonRow> rows() &&;
  /// Returns the main table as aligned text.
  std::string text() const;
  /// Returns the report as a self-contained page with tables and plots, as `chainmail compare` writes it.
  std::string html() const;
  /// Returns all figures as JSON.
  std::string json() const;
  /// Returns all figures as CSV: a header, then one row per row of the table.
  std::string csv() const;
  /// Writes report.html, report.csv and, unless the library was built without nlohmann/json, report.json into a folder,
  /// which is created if it is missing; against physics also plots (SVG). Throws Error if a file cannot be written;
  /// then no file is changed.
  void write(const std::filesystem::path& folder) const;

 private:
  friend struct Access;
  struct Impl;
  explicit Comparison(std::shared_ptr<const Impl> impl) : impl_(std::move(impl)) {}
  std::shared_ptr<const Impl> impl_;
};

/// Compares methods on an object and drags: times, and errors at the end of each drag. The object gives its mesh, cuts,
/// pins, softness and elasticity; drags start at rest, whatever its positions are. Without drags, there are three
/// standard ones: local, whole body, back and forth. All figures except times are the same on every machine.
///
/// A method that does not work on the object is listed with the reason. Throws Error for an unknown method, an option
/// out of its range, or a drag that is empty, not finite, or grabs elements that do not exist or are pinned; against
/// physics also if the object has cuts or no pins; and Cancelled.
Comparison compare(const Body& body, const std::vector<Drag>& drags = {}, const CompareOptions& options = {},
                   const Job& job = {});

}  // namespace chainmail::api
