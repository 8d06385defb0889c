#pragma once

#include <ostream>
#include <span>

#include "report/page/figures.h"
#include "report/run/physics.h"

namespace chainmail::report {

/// One contestant in one drag of one object, or at one size of a growing object. What was not measured is null.
struct PhysicsRow {
  const PhysicsObject* object = nullptr;
  const PhysicsDrag* drag = nullptr;
  const PhysicsEntry* entry = nullptr;
  const PhysicsGrowth* growth = nullptr;
  const GrowthSeries* series = nullptr;
  const GrowthPoint* point = nullptr;
};
/// Returns all figures of a row, in the order of the columns in CSV.
std::span<const Figure<PhysicsRow>> physics_figures();
// Names of groups and headings that tables treat in their own way.
inline constexpr std::string_view relative_error = "relative error (ratio)", time_unit = " (ms)",
                                  after_cut = "after cut";

/// Writes a header, then a row for each contestant, drag and object. Numbers have all digits.
void write_csv(std::ostream& out, const PhysicsReport& report);

}  // namespace chainmail::report
