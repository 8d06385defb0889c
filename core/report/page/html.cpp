#include "report/page/html.h"

#include <algorithm>

#include "report/page/compared_figures.h"
#include "report/page/figure_table.h"
#include "report/page/format.h"
#include "report/page/page.h"
#include "report/page/plot.h"
#include "report/page/table.h"

namespace chainmail::report {
namespace {

constexpr const char* how_to_read_comparison = R"(<h2>How to read it</h2>
<p>Every contestant carries out the same recorded moves, in turns within one process and one thread. Each repetition starts
from rest; the first one does not count. <b>ms per move</b> is the time of a pass and of the sweeps of relaxation that
follow it, as a mean over the moves of a drag: the median over the repetitions. Time of other programs does not count. The
<b>violation</b> is the distance of a link from its valid region, in its rest lengths; a link is violated above 10⁻⁴. The
<b>distance to Exact</b> is the distance to the final positions of Exact ChainMail in double precision, on the same moves
and without relaxation, in mean rest lengths: Exact moves every element as little as a valid object allows. Relaxation
moves elements toward the equilibrium and so away from Exact: for a contestant with relaxation, the violation shows the
quality and the distance shows how far it moved. <b>+ equilibrium</b> relaxes after each move to the valid state of least
energy, until the residual is at most 0.001, in at most 200 iterations. Errors are measured in double precision at the end of a drag, while the
handle is still held; figures near 10⁻⁶ are the rounding of single precision. In the plots, lower is better and further
left is faster: a contestant with no other one below and left of it is a good choice. In the tables, <b>float to
double</b> is the distance between a contestant in both precisions, and <b>farthest / handle</b> is the largest
displacement over that of the handle: above 1, an element moved further than the handle. The <b>Hausdorff distance</b> is
the largest distance from a point of one surface to the nearest point of the other. Volume is that of the cells, or what
the faces enclose; in a plane it is the area. A cell is <b>inverted</b> if it is turned inside out. The <b>largest
stretch</b> is the largest factor by which any direction in a cell is lengthened.</p>
)";

int repetitions_of(const DragResult& drag) {
  int most = 0;
  for (const Entry& entry : drag.entries) {
    most = std::max(most, entry.measurement ? entry.measurement->ms_per_move.count : 0);
  }
  return most;
}

std::string about(const DragResult& drag) {
  return drag.description + "; " + std::to_string(drag.moves) + " moves, " + std::to_string(repetitions_of(drag)) +
         " repetitions" + (drag.no_exact.empty() ? "" : "; no distance to Exact: " + drag.no_exact);
}

/// Leaves out the distance to the equilibrium if nobody has one.
FigureTable table_of(const CaseResult& object, const DragResult& drag) {
  FigureTable table{object.name + ", " + drag.name, about(drag), "detail", "contestant", {}, {}};
  std::vector<Figure<ComparedRow>> shown;
  const bool has_equilibrium = std::ranges::any_of(
      drag.entries, [](const Entry& entry) { return entry.measurement && entry.measurement->errors.to_equilibrium; });
  for (const Figure<ComparedRow>& one : compared_figures()) {
    if (!one.heading.empty() && (has_equilibrium || one.group != equilibrium_group)) {
      shown.push_back(one);
      table.columns.push_back({std::string(one.group), std::string(one.heading)});
    }
  }
  for (const Entry& entry : drag.entries) {
    auto& row = table.rows.emplace_back();
    row.label = label(entry.contestant);
    row.refusal = entry.measurement ? "" : entry.refusal;
    for (std::size_t i = 0; entry.measurement && i < shown.size(); ++i) {
      row.cells.push_back(cell_of(shown[i], {&object, &drag, &entry}));
    }
  }
  return table;
}

/// Writes all figures of an object, one table per drag.
void write_details(std::ostream& out, const CaseResult& object) {
  for (const DragResult& drag : object.drags) {
    write_html(out, table_of(object, drag));
  }
}

FigureTable table_of(const MainTable& main) {
  FigureTable table{main.object, main.about, "main", "contestant", {}, {}};
  for (const std::string& drag : main.drags) {
    table.columns.push_back({"ms per move", drag});
  }
  for (const char* name : {"max", "RMS"}) {
    table.columns.push_back({"violation, worst of the drags (rest lengths)", name});
  }
  table.columns.push_back({"violated links, worst", "share (%)"});
  for (const char* name : {"max", "RMS"}) {
    table.columns.push_back({"distance to Exact, worst (mean rest lengths)", name});
  }
  for (const MainRow& row : main.rows) {
    table.rows.push_back(
        {row.contestant, row.refusal.empty() ? cells_of(row) : std::vector<std::string>(), row.refusal});
  }
  return table;
}

}  // namespace

void write_html(std::ostream& out, const Comparison& comparison, const Origin& origin) {
  begin_page(out, "ChainMail: time against error", origin);
  out << how_to_read_comparison
      << "<h2>Main table</h2>\n<p class=\"faint\">Lengths in rest lengths; times in milliseconds, medians.</p>\n";
  for (const MainTable& table : main_tables(comparison)) {
    write_html(out, table_of(table));
  }
  out << "<h2>Time against error</h2>\n";
  for (const CaseResult& object : comparison.cases) {
    out << "<h3>" << escaped(object.name) << "</h3>\n";
    write_figure(out, violation_plot(object));
    write_figure(out, distance_plot(object));
  }
  out << "<h2>All figures</h2>\n";
  for (const CaseResult& object : comparison.cases) {
    write_details(out, object);
  }
  end_page(out, origin, comparison.options);
}

}  // namespace chainmail::report
