#pragma once

#include <ostream>

#include "report/page/plot.h"

namespace chainmail::report {

/// The ink of a file, readable on light and dark backgrounds.
inline constexpr const char* file_ink = "#808080";

/// Writes the plot as an SVG element, which is valid as a file and within HTML. It has three panels per row. Lines and
/// text have the colour `ink`. Marks differ in shape, and in colours that colour-blind readers can tell apart.
void write_svg(std::ostream& out, const Plot& plot, const std::string& ink = "currentColor");

}  // namespace chainmail::report
