#pragma once

#include <ostream>
#include <string>
#include <utility>
#include <vector>

#include "report/page/plot.h"
#include "report/run/compare.h"
#include "report/run/machine.h"

namespace chainmail::report {

/// The frame of a page that needs nothing else; it prints well.
void begin_page(std::ostream& out, const std::string& title, const Origin& origin);
/// Closes it with where its figures come from; `more` are terms and what they are.
void end_page(std::ostream& out, const Origin& origin, const CompareOptions& options,
              const std::vector<std::pair<std::string, std::string>>& more = {});

void write_figure(std::ostream& out, const Plot& plot);

}  // namespace chainmail::report
