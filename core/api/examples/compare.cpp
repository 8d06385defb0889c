// Compares two algorithms on the same drag of a sheet: time per pass, and what they do to the links.
//   compare [FOLDER]      also writes the report into FOLDER
#include <chainmail/chainmail.h>

#include <iostream>

namespace cm = chainmail::api;

int main(int argc, char** argv) {
  const cm::Body sheet(cm::make_cloth(24, 24));

  cm::Drag drag{.name = "corner", .elements = {0}, .path = {}};
  for (int step = 1; step <= 20; ++step) {
    drag.path.push_back({{-0.3 * step, 0.2 * step, 0}, {}});
  }

  cm::CompareOptions options;
  options.title = "sheet";
  options.methods = {"generalized", "exact"};
  options.repetitions = 5;
  const cm::Comparison comparison = cm::compare(sheet, {drag}, options);

  for (const cm::ComparisonRow& row : comparison.rows()) {
    std::cout << row.label << ": " << *row.ms_per_move << " ms per pass, largest violation " << row.violation->max
              << " of rest length, " << 100 * row.violation->fraction << " % of the links violated\n";
  }
  if (argc > 1) {
    comparison.write(argv[1]);
  }
  return 0;
}
