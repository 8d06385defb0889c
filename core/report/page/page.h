#pragma once

#include <ostream>
#include <string>
#include <utility>
#include <vector>

#include "report/page/plot.h"
#include "report/run/compare.h"
#include "report/run/machine.h"

namespace chainmail::report {

/// Writes the beginning of a self-contained HTML page that can be printed.
void begin_page(std::ostream& out, const std::string& title, const Origin& origin);
/// Writes the end of the page with the origin of its figures; `more` are terms with their descriptions.
void end_page(std::ostream& out, const Origin& origin, const CompareOptions& options,
              const std::vector<std::pair<std::string, std::string>>& more = {});

void write_figure(std::ostream& out, const Plot& plot);

}  // namespace chainmail::report
