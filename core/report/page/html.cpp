#include "report/page/html.h"

#include "report/page/detail.h"
#include "report/page/figure_table.h"
#include "report/page/format.h"
#include "report/page/page.h"
#include "report/page/table.h"

namespace chainmail::report {
namespace {

constexpr const char* how_to_read = R"(<h2>How to read it</h2>
<p>Every contestant carries out the same recorded moves, in turns within one process and one thread, each repetition from
rest after one that does not count. <b>ms a move</b> is the time of a pass and of the sweeps of relaxation that follow it,
averaged over the moves of a drag: the median over the repetitions. What other programs took meanwhile does not
count. The <b>violation</b> is how far a link lies outside its
valid region, in its rest lengths; a link counts as violated above 10⁻⁴. The <b>distance to Exact</b> is measured from the
positions in which Exact ChainMail ends, run in double precision on the same moves and without relaxation, in mean rest
lengths: Exact moves every element as little as a valid object allows. Relaxation moves elements on purpose, toward the
equilibrium and so away from Exact: there the violation says how good a contestant is, and the distance how far it has
gone. Errors are measured in double precision at the end of a drag, while the hand still holds; figures near 10⁻⁶ are the
rounding of single precision. In the plots, down is better and left is faster: a contestant with no other one below
and left of it is a good choice. Below, <b>float to double</b> is the distance of a contestant from itself in the other
precision, and <b>farthest / hand</b> the largest displacement over the hand’s: above 1, something went further than it
was pulled.</p>
)";

FigureTable table_of(const MainTable& main) {
  FigureTable table{main.object, main.about, "main", "contestant", {}, {}};
  for (const std::string& drag : main.drags) {
    table.columns.push_back({"ms a move", drag});
  }
  for (const char* name : {"max", "RMS", "links"}) {
    table.columns.push_back({"violation, worst of the drags", name});
  }
  table.columns.insert(table.columns.end(), {{"distance to Exact, worst", "max"}, {"distance to Exact, worst", "RMS"}});
  for (const MainRow& row : main.rows) {
    table.rows.push_back(
        {row.contestant, row.refusal.empty() ? cells_of(row) : std::vector<std::string>(), row.refusal});
  }
  return table;
}

}  // namespace

void write_html(std::ostream& out, const Comparison& comparison, const Origin& origin) {
  begin_page(out, "ChainMail: speed against error", origin);
  out << how_to_read
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
