#include "api/report_files.h"

#include <system_error>

#include "chainmail/files.h"
#include "chainmail/text.h"
#include "report/page/svg.h"
#ifdef CHAINMAIL_HAS_CALIBRATE
#include "calibrate/for_report.h"
#endif

namespace chainmail::api {

report::Origin origin_of(const std::string& command, const std::string& program) {
  return {report::this_machine(), command, report::now_in_words(),
          program.empty() ? "chainmail " + std::string(version()) : program};
}

report::Progress teller_of(const Job& job) {
  return [job, progress = Access::progress(job)](double share, const std::string& text) {
    Access::say(job, text);
    progress.report(share);
  };
}

#ifdef CHAINMAIL_HAS_CALIBRATE
report::Calibrator calibrator_of(inner::RelaxationScheme scheme) { return calibrator_for_reports(scheme); }
#else
report::Calibrator calibrator_of(inner::RelaxationScheme /*scheme*/) { refuse_without("NLopt", "calibrated"); }
#endif

ReportFile plot_file(const std::string& name, const report::Plot& plot) {
  return {name, written([&](std::ostream& out) { write_svg(out, plot, "#808080"); })};
}

void write_report(const std::filesystem::path& folder, const std::vector<ReportFile>& files) {
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (error) {
    throw Error(shown(folder), "the folder cannot be created (" + error.message() + ")", "use another folder");
  }
  Outputs outputs;
  for (const ReportFile& file : files) {
    outputs.add(folder / file.name, [&](std::ostream& out) { out << file.content; });
  }
  outputs.commit();
}

}  // namespace chainmail::api
