#include "files/results/trace_csv.h"

#include <string>

#include "files/text/text.h"

namespace chainmail {

void write_trace_csv(std::ostream& out, const std::vector<Trace>& passes) {
  out << "pass,order,element,sponsor,moved\n";
  std::string row;
  for (std::size_t pass = 0; pass < passes.size(); ++pass) {
    std::uint64_t order = 0;
    for (const TraceRow& candidate : passes[pass]) {
      row.clear();
      for (const std::uint64_t number : {std::uint64_t{pass}, order++, std::uint64_t{candidate.element}}) {
        append_number(row, number);
        row += ',';
      }
      if (candidate.sponsor == no_element) {
        row += "-1";
      } else {
        append_number(row, std::uint64_t{candidate.sponsor});
      }
      out << (row += candidate.moved ? ",1\n" : ",0\n");
    }
  }
}

}  // namespace chainmail
