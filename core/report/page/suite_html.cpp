#include "report/page/suite_html.h"

#include "report/page/format.h"
#include "report/page/page.h"
#include "report/page/suite_plot.h"
#include "report/page/suite_table.h"

namespace chainmail::report {
namespace {

constexpr const char* how_to_read_suite = R"(<h2>How to read it</h2>
<p>Every contestant carries out the same moves of the same handle on the same object, from rest, in turns within one
process and one thread. The <b>relative error</b> is the RMS distance from the reference at the end of a drag, over the
RMS displacement of the reference, over the elements that are neither pinned nor in the handle: an object that does not
move has 1. <b>Turned by 45°</b> is the error of the same drag on the object turned about the origin; it equals the other
one for a method that does not depend on the axes. The reference is the closed form where there is one, else finite
elements on refined cells.</p>
<p><b>Factorize</b> happens once for an object, its pins and cuts, <b>grab</b> once for each handle. <b>First</b> and
<b>later</b> are moves after all preparation; <b>after cut</b> is the move after a cut in the middle of a drag, with all
preparation that it repeats. Times are medians. <b>Bytes</b> is the memory of a solver after its first drag, without the
mesh. A contestant that does not converge has no figures. The <b>time to an error</b> is the shortest with which a
contestant has at most this error, over all numbers of iterations or sweeps per move. These numbers, one after the other,
are the points of its curve in the plots: × 10 means ten per move.</p>
<p>One rule ends all <b>iterations</b>: a contestant makes the least number per move with which its answer at the end of the
drag is within 1 % of its own limit, the answer after as many as it wants. A contestant is on the <b>front</b> if no other
one is at least as fast and as close, and better in one of both. Where <b>regions bind</b> is 0, ChainMail's valid regions
had no part in the answer: it is that of the energy. <b>Calibrated</b> contestants, with <code>--calibrated on</code>, have
the softness that is closest to the reference on drags of other elements.</p>
)";

void write_runs(std::ostream& out, const Suite& suite) {
  out << "<h2>Origin of the figures</h2>\n<dl>\n";
  for (const SuiteRun& run : suite.runs) {
    const Machine& machine = run.origin.machine;
    std::string names;
    for (const std::string& name : run.experiments) {
      names += (names.empty() ? "" : ", ") + name;
    }
    out << "<dt>part " << escaped(run.shard) << "</dt><dd><code>" << escaped(run.origin.command_line) << "</code><br/>"
        << escaped(run.origin.date + " · " + run.origin.version + " · " + machine.processor + ", " +
                   std::to_string(machine.cores) + " cores, one of them used · " + machine.compiler + " · " +
                   machine.build + " · " + names)
        << "</dd>\n";
  }
  out << "</dl>\n</body>\n</html>\n";
}

}  // namespace

void write_html(std::ostream& out, const Suite& suite) {
  begin_page(out, "ChainMail and the methods of today", suite.runs.front().origin);
  out << "<h2>Who is closest</h2>\n<ul>\n";
  for (const std::string& sentence : suite_findings(suite)) {
    out << "<li>" << escaped(sentence) << "</li>\n";
  }
  out << "</ul>\n";
  std::string missing;
  for (const std::string& name : missing_from(suite)) {
    missing += (missing.empty() ? "" : ", ") + name;
  }
  if (!missing.empty()) {
    out << "<p class=\"faint\">Not part of this report: " << escaped(missing) << "</p>\n";
  }
  if (const FigureTable summary = suite_summary(suite); !summary.rows.empty()) {
    write_html(out, summary);
  }
  for (const SpeedAgainstError& measure : speeds_against_error) {
    if (const Plot plot = suite_plot(suite, measure); !plot.panels.empty()) {
      write_figure(out, plot);
    }
  }
  out << how_to_read_suite;
  for (const SuiteResult& result : suite.results) {
    out << "<h2>" << escaped(result.name) << "</h2>\n";
    if (!result.times.empty()) {
      write_html(out, time_table(result));
    }
    if (!result.orders.empty()) {
      write_html(out, order_table(result));
    }
    if (!result.rows.empty()) {
      write_html(out, suite_table(result));
    }
  }
  write_runs(out, suite);
}

}  // namespace chainmail::report
