#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "measure/converging_reference.h"
#include "measure/pass_times.h"
#include "report/table/contestant.h"
#include "report/table/figure.h"
#include "report/table/machine.h"

namespace chainmail::report {

/// What a report is about. `report_info` describes each.
enum class ReportKind { compare, physics, suite, ramp, calibrate, judge };

/// A measured value: a number, or the median of the times of repetitions with their spread.
struct Value {
  double number = 0;
  std::optional<TimeSpread> spread = {};

  bool operator==(const Value&) const = default;
};

/// One contestant in one drag of one object: its figures, or the reason why there are none.
struct Row {
  std::size_t object = 0;                // index into Results::objects
  std::optional<std::size_t> drag = {};  // index into its drags; none: the figures are of the whole object
  Contestant contestant = {};
  std::string refusal = {};  // empty if there are figures
  std::vector<std::pair<const Figure*, Value>> figures = {};

  bool has_figures() const { return !figures.empty(); }
  /// Returns null if it was not measured.
  const Value* find(const Figure& figure) const;
  /// Returns none if it was not measured.
  std::optional<double> operator[](const Figure& figure) const;
  /// Sets a figure, if there is a value.
  void set(const Figure& figure, const std::optional<double>& value);
  /// Sets a time, if there are repetitions.
  void set(const Figure& figure, const TimeSpread& ms);
};

/// A drag of an object.
struct DragInfo {
  std::string name = {}, description = {};
  std::uint64_t handle = 0;  // an element of the handle
  int moves = 0;
  bool has_cut = false;                       // a cut precedes the last move
  double handle_displacement = 0;             // mesh units; 0: not known
  std::string no_reference = {};              // reason why errors are missing; empty if they are there
  std::optional<Convergence> reference = {};  // if the reference is on refined cells
};

/// An object of a report.
struct ObjectInfo {
  std::string name = {}, description = {};
  std::string series = {};  // objects that grow or are refined, or an experiment of the suite, have the same one
  std::uint64_t elements = 0, links = 0, pins = 0;
  std::string reference = {};  // what errors are measured against
  std::vector<std::string> notes = {};
  double seconds = 0;  // duration of its experiment; 0: not known
  std::vector<DragInfo> drags = {};
};

/// A run of a program on one machine.
struct ReportRun {
  Origin origin;
  std::string shard = {};  // such as 1/4; empty: there is only one
  std::vector<std::string> experiments = {};
};

/// Name and value of an option of a run.
using Setting = std::pair<std::string, std::variant<double, std::string>>;

/// Everything that a report measured, in one table.
struct Results {
  ReportKind kind = ReportKind::compare;
  std::vector<ReportRun> runs = {};
  std::vector<Setting> settings = {};
  std::vector<ObjectInfo> objects = {};
  std::vector<Row> rows = {};  // object by object, drag by drag
  bool stopped = false;        // true: it was cancelled, and contains only what was finished

  const ObjectInfo& object_of(const Row& row) const { return objects[row.object]; }
  /// Returns null for figures of the whole object.
  const DragInfo* drag_of(const Row& row) const { return row.drag ? &objects[row.object].drags[*row.drag] : nullptr; }
  /// Adds the objects and rows of other results, which follow.
  void add(Results other);
};

/// Describes a kind of report.
struct ReportInfo {
  ReportKind kind;
  std::string_view name;   // in files
  std::string_view title;  // of its page
};
/// All kinds, in the order of the constants.
std::span<const ReportInfo> report_kinds();
const ReportInfo& report_info(ReportKind kind);
/// Returns none if no kind has this name.
std::optional<ReportKind> find_report_kind(std::string_view name);

}  // namespace chainmail::report
