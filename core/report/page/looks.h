#pragma once

#include <string_view>

#include "solve/solver.h"

namespace chainmail::report {

/// How an algorithm is drawn in plots, whoever else takes part.
struct Look {
  std::string_view path;    // SVG's, about (0, 0), of size 1
  std::string_view colour;  // empty: that of lines and text
};

/// The place of an algorithm's look among them.
std::size_t look_of(Algorithm algorithm);
/// There is one an algorithm; after the last they begin anew.
const Look& look_at(std::size_t place);

}  // namespace chainmail::report
