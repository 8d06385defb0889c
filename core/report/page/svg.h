#pragma once

#include <ostream>

#include "report/page/plot.h"

namespace chainmail::report {

/// Writes the plot as an SVG element that is valid alone and within HTML, three panels in a row. Lines and text are in
/// the colour `ink`. Marks have colours that are safe for the colour-blind, and differ in shape.
void write_svg(std::ostream& out, const Plot& plot, const std::string& ink = "currentColor");

}  // namespace chainmail::report
