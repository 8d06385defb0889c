#include "docks/size_test/size_test.h"

#include "common/panel_names.h"
#include "report/page/format.h"

namespace chainmail {

QString sizeText(std::uint32_t width) { return QStringLiteral("%1×%1").arg(width); }

std::vector<std::uint32_t> widthsOf(const SizeTestOptions& options) {
  return report::ramp_widths(options.first, options.largest, options.growth);
}

report::RampVerdict verdictOf(const SizeTestContestant& contestant, std::span<const SizeTestRow> rows) {
  std::vector<report::RampRow> own;
  for (const SizeTestRow& row : rows) {
    if (row.panel == contestant.panel) {
      own.push_back(row.figures);
    }
  }
  return report::ramp_verdict(contestant.algorithm, own);
}

void writeCsv(std::ostream& out, std::span<const SizeTestRow> rows) {
  out << "width,elements,links,panel,algorithm,passes,median_ms,p99_ms,mean_moved,painted_per_s,repeated,real_time\n";
  for (const auto& [panel, one, painted] : rows) {
    out << one.width << ',' << one.elements << ',' << one.links << ',' << panelName(panel).toStdString() << ','
        << info(one.algorithm).name << ',' << one.passes << ',' << report::all_digits(one.median_ms) << ','
        << report::all_digits(one.p99_ms) << ',' << report::all_digits(one.mean_moved) << ',' << painted << ','
        << one.repeated << ',' << one.in_real_time << '\n';
  }
}

}  // namespace chainmail
