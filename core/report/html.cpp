#include "report/html.h"

#include "report/detail.h"
#include "report/format.h"
#include "report/plot.h"
#include "report/table.h"

namespace chainmail::report {
namespace {

constexpr const char* style = R"(
:root { color-scheme: light dark; --ink: #1b1b1b; --paper: #fff; --faint: #666; --rule: #d5d5d5; --band: #f3f4f6; }
@media (prefers-color-scheme: dark) {
  :root { --ink: #e6e6e6; --paper: #17191c; --faint: #a3a3a3; --rule: #3a3d42; --band: #22262b; }
}
body { font: 15px/1.5 system-ui, "DejaVu Sans", sans-serif; color: var(--ink); background: var(--paper);
  max-width: 72rem; margin: 2.5rem auto; padding: 0 1.5rem; }
h1 { font-size: 1.75rem; line-height: 1.2; margin: 0 0 .4rem; }
h2 { font-size: 1.25rem; margin: 2.6rem 0 .5rem; border-bottom: 1px solid var(--rule); padding-bottom: .2rem; }
h3 { font-size: 1.02rem; margin: 1.6rem 0 .3rem; }
p { max-width: 46rem; margin: .5rem 0; }
.faint, caption .faint { color: var(--faint); font-weight: normal; }
table { border-collapse: collapse; width: 100%; font-size: .8rem; margin: 1.1rem 0 1.6rem;
  font-variant-numeric: tabular-nums; }
caption { text-align: left; font-weight: 600; font-size: .95rem; padding: .2rem 0 .4rem; }
th, td { padding: .17rem .5rem; text-align: right; white-space: nowrap; }
th { font-weight: 600; vertical-align: bottom; }
thead tr:last-child th { border-bottom: 1.5px solid var(--ink); }
th.group { text-align: center; border-bottom: 1px solid var(--rule); font-weight: normal; color: var(--faint); }
tbody th, th:first-child { text-align: left; font-weight: normal; vertical-align: top; }
.detail { font-size: .72rem; } .detail th, .detail td { padding: .12rem .33rem; }
.main { table-layout: fixed; min-width: 50rem; } .main th:first-child { width: 17rem; }
tbody tr { border-bottom: 1px solid var(--rule); }
tbody tr:nth-child(even) { background: var(--band); }
td.refusal { text-align: left; white-space: normal; color: var(--faint); font-style: italic; }
figure { margin: .8rem 0 1.4rem; }
svg { max-width: 100%; height: auto; color: var(--ink); display: block; }
dl { display: grid; grid-template-columns: max-content 1fr; gap: .15rem 1.2rem; margin: .5rem 0; }
dt { color: var(--faint); } dd { margin: 0; overflow-wrap: anywhere; }
code { font-family: ui-monospace, "DejaVu Sans Mono", monospace; font-size: .85em; }
.wide { overflow-x: auto; }
@page { size: A4 landscape; margin: 14mm; }
@media print {
  :root { --ink: #000; --paper: #fff; --faint: #444; --rule: #bbb; --band: #f3f3f3; }
  body { margin: 0; max-width: none; padding: 0; font-size: 10.5pt; }
  .main { font-size: 8pt; } .detail { font-size: 6.8pt; }
  table, figure, tr { break-inside: avoid; } h2, h3, caption { break-after: avoid; } .wide { overflow: visible; }
}
)";

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

void write_head(std::ostream& out, const Origin& origin) {
  out << "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\"/>\n"
         "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\"/>\n"
         "<title>ChainMail: speed against error</title>\n<style>"
      << style << "</style>\n</head>\n<body>\n<h1>ChainMail: speed against error</h1>\n<p class=\"faint\">"
      << escaped(origin.date) << " · " << escaped(origin.machine.processor) << "</p>\n";
}

void write_main_row(std::ostream& out, const MainRow& row) {
  out << "<tr><th scope=\"row\">" << escaped(row.contestant) << "</th>";
  if (!row.refusal.empty()) {
    out << "<td class=\"refusal\" colspan=\"" << row.ms_per_move.size() + 5 << "\">" << escaped(row.refusal)
        << "</td></tr>\n";
    return;
  }
  for (const auto& ms : row.ms_per_move) {
    out << "<td>" << figure(ms) << "</td>";
  }
  out << "<td>" << figure(row.violation.max) << "</td><td>" << figure(row.violation.rms) << "</td><td>"
      << percent(row.violation.fraction) << "</td><td>" << (row.to_exact ? figure(row.to_exact->max) : "n/a")
      << "</td><td>" << (row.to_exact ? figure(row.to_exact->rms) : "n/a") << "</td></tr>\n";
}

void write_main_table(std::ostream& out, const MainTable& table) {
  out << "<div class=\"wide\"><table class=\"main\">\n<caption>" << escaped(table.object) << " <span class=\"faint\">"
      << escaped(table.about) << "</span></caption>\n<thead><tr><th></th><th class=\"group\" colspan=\""
      << table.drags.size()
      << "\">ms a move</th><th class=\"group\" colspan=\"3\">violation, worst of the drags</th>"
         "<th class=\"group\" colspan=\"2\">distance to Exact, worst</th></tr>\n<tr><th scope=\"col\">contestant</th>";
  for (const std::string& drag : table.drags) {
    out << "<th scope=\"col\">" << escaped(drag) << "</th>";
  }
  out << "<th scope=\"col\">max</th><th scope=\"col\">RMS</th><th scope=\"col\">links</th>"
         "<th scope=\"col\">max</th><th scope=\"col\">RMS</th></tr></thead>\n<tbody>\n";
  for (const MainRow& row : table.rows) {
    write_main_row(out, row);
  }
  out << "</tbody></table></div>\n";
}

void write_plots(std::ostream& out, const CaseResult& object) {
  out << "<h3>" << escaped(object.name) << "</h3>\n";
  for (const Plot& plot : {violation_plot(object), distance_plot(object)}) {
    out << "<figure>\n";
    write_svg(out, plot);
    out << "</figure>\n";
  }
}

void write_origin(std::ostream& out, const CompareOptions& options, const Origin& origin) {
  const auto item = [&](const char* term, const std::string& what) {
    out << "<dt>" << term << "</dt><dd>" << what << "</dd>\n";
  };
  const Machine& machine = origin.machine;
  out << "<h2>Where the figures come from</h2>\n<dl>\n";
  item("command", "<code>" + escaped(origin.command_line) + "</code>");
  item("version", escaped(origin.version));
  item("date", escaped(origin.date));
  item("processor",
       escaped(machine.processor) + ", " + std::to_string(machine.cores) + " cores, of which one was used");
  item("compiler", escaped(machine.compiler));
  item("build", escaped(machine.build));
  item("precision", options.precision == Precision::single_precision ? "float" : "double");
  item("relaxation", (options.scheme == RelaxationScheme::mean ? "toward the mean of the neighbours" : "link by link") +
                         (", step " + figure(options.relax_step)));
  out << "</dl>\n";
}

}  // namespace

void write_html(std::ostream& out, const Comparison& comparison, const Origin& origin) {
  write_head(out, origin);
  out << how_to_read
      << "<h2>Main table</h2>\n<p class=\"faint\">Lengths in rest lengths; times in milliseconds, medians.</p>\n";
  for (const MainTable& table : main_tables(comparison)) {
    write_main_table(out, table);
  }
  out << "<h2>Time against error</h2>\n";
  for (const CaseResult& object : comparison.cases) {
    write_plots(out, object);
  }
  out << "<h2>All figures</h2>\n";
  for (const CaseResult& object : comparison.cases) {
    write_details(out, object);
  }
  write_origin(out, comparison.options, origin);
  out << "</body>\n</html>\n";
}

}  // namespace chainmail::report
