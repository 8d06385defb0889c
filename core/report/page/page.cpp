#include "report/page/page.h"

#include "report/page/format.h"
#include "report/page/svg.h"

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
caption div { max-width: min(60rem, 90vw); }
th, td { padding: .17rem .5rem; text-align: right; white-space: nowrap; }
th { font-weight: 600; vertical-align: bottom; }
thead tr:last-child th { border-bottom: 1.5px solid var(--ink); }
th.group { text-align: center; white-space: normal; border-bottom: 1px solid var(--rule); font-weight: normal;
  color: var(--faint); }
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

}  // namespace

void begin_page(std::ostream& out, const std::string& title, const Origin& origin) {
  out << "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\"/>\n"
         "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\"/>\n<title>"
      << escaped(title) << "</title>\n<style>" << style << "</style>\n</head>\n<body>\n<h1>" << escaped(title)
      << "</h1>\n<p class=\"faint\">" << escaped(origin.date) << " · " << escaped(origin.machine.processor) << "</p>\n";
}

void end_page(std::ostream& out, const Origin& origin, const CompareOptions& options,
              const std::vector<std::pair<std::string, std::string>>& more) {
  const auto item = [&](const std::string& term, const std::string& what) {
    out << "<dt>" << term << "</dt><dd>" << what << "</dd>\n";
  };
  const Machine& machine = origin.machine;
  out << "<h2>Origin of the figures</h2>\n<dl>\n";
  item("command", "<code>" + escaped(origin.command_line) + "</code>");
  item("version", escaped(origin.version));
  item("date", escaped(origin.date));
  item("processor", escaped(machine.processor) + ", " + std::to_string(machine.cores) + " cores, one of them used");
  item("compiler", escaped(machine.compiler));
  item("build", escaped(machine.build));
  item("precision", options.precision == Precision::single_precision ? "float" : "double");
  item("relaxation", escaped(std::string(info(options.scheme).summary)) + ", step " + figure(options.relax_step));
  for (const auto& [term, what] : more) {
    item(escaped(term), escaped(what));
  }
  out << "</dl>\n</body>\n</html>\n";
}

void write_figure(std::ostream& out, const Plot& plot) {
  out << "<figure>\n";
  write_svg(out, plot);
  out << "</figure>\n";
}

}  // namespace chainmail::report
