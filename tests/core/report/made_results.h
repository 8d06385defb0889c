#pragma once

#include <initializer_list>
#include <string>
#include <utility>

#include "report/table/results.h"

namespace chainmail::report::test {

/// Text from outside that breaks a file if it is not escaped.
inline const std::string nasty = "a<b & \"c\" 'd', ]]> \x01\xff \xc3\xa9";

inline TimeSpread ms(double median) { return {median, median / 2, 2 * median, median / 4, 4 * median, 5}; }

/// Adds a row of the first object with some figures; those in ms have a spread.
inline Row& add_row(Results& results, std::size_t drag, const Contestant& contestant,
                    std::initializer_list<std::pair<const Figure*, double>> figures, const std::string& refusal = {}) {
  Row row{.drag = drag, .contestant = contestant, .refusal = refusal};
  for (const auto& [figure, value] : figures) {
    if (figure->unit == "ms") {
      row.set(*figure, ms(value));
    } else {
      row.set(*figure, value);
    }
  }
  return results.rows.emplace_back(std::move(row));
}

/// Returns results of one object with drags of four moves.
inline Results results_of(ReportKind kind, std::initializer_list<const char*> drags) {
  Results results{.kind = kind};
  results.objects.push_back({.name = "bar", .description = "an object", .elements = 9, .links = 12});
  for (const char* drag : drags) {
    results.objects.back().drags.push_back({.name = drag, .moves = 4});
  }
  return results;
}

}  // namespace chainmail::report::test
