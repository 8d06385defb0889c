#pragma once

#include <ostream>
#include <span>

#include "report/page/figures.h"
#include "report/run/compare.h"

namespace chainmail::report {

/// One contestant in one drag of one object.
struct ComparedRow {
  const CaseResult* object = nullptr;
  const DragResult* drag = nullptr;
  const Entry* entry = nullptr;
};
/// Returns all figures of a row, in the order of the columns in CSV.
std::span<const Figure<ComparedRow>> compared_figures();
inline constexpr std::string_view equilibrium_group = "to equilibrium (mean rest lengths)";

/// Writes a header, then a row for each contestant, drag and object. Numbers have all digits; missing values are empty
/// fields.
void write_csv(std::ostream& out, const Comparison& comparison);

}  // namespace chainmail::report
