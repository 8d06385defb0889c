#pragma once

#include <ostream>
#include <string>
#include <vector>

#include "report/page/plot.h"
#include "report/table/results.h"

namespace chainmail::report {

/// Writes a header, then a row for each contestant, drag and object. Numbers have all digits; what was not measured is
/// empty. A time has columns with its quartiles and its number of repetitions.
void write_csv(std::ostream& out, const Results& results);

/// Writes what the results say, and the main tables, as text.
void write_text(std::ostream& out, const Results& results);

/// Writes a self-contained page: what the results say, explanations, tables, plots, and the origin of the figures.
void write_html(std::ostream& out, const Results& results);

/// A plot of a report, and the name of its file.
struct PlotFile {
  std::string name;
  Plot plot;
};
/// Returns the plots of a report.
std::vector<PlotFile> plots_of(const Results& results);

}  // namespace chainmail::report
