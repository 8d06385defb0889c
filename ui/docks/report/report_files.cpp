#include "docks/report/report_files.h"

#include <QDateTime>

#include "files/results/report_json.h"
#include "files/text/outputs.h"
#include "report/page/html.h"
#include "report/page/table.h"

namespace chainmail {

void saveReport(const std::filesystem::path& folder, const report::Comparison& comparison) {
  const QString date = QDateTime::currentDateTimeUtc().toString(QStringLiteral("yyyy-MM-dd HH:mm 'UTC'"));
  const report::Origin origin{report::this_machine(), "the workbench's Report dock, while its window was open",
                              date.toStdString(), "chainmail " CHAINMAIL_VERSION};
  Outputs outputs;
  outputs.add(folder / "report.html", [&](std::ostream& out) { write_html(out, comparison, origin); });
  outputs.add(folder / "report.json", [&](std::ostream& out) { write_json(out, comparison, origin); });
  outputs.add(folder / "report.csv", [&](std::ostream& out) { write_csv(out, comparison); });
  outputs.commit();
}

}  // namespace chainmail
