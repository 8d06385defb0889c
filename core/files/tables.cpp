#include "files/tables.h"

#include <string>

#include "files/text.h"

namespace chainmail {

void write_positions_csv(std::ostream& out, const Mesh& mesh, const PositionView& positions, const Progress& progress) {
  TextBlocks text(out);
  text << "id,x,y,z\n";
  for (ElementId element = 0; element < mesh.element_count(); ++element) {
    progress.report(element, mesh.element_count());
    text << element;
    for (const double coordinate : point_of(mesh, positions, element)) {
      text << ',' << coordinate;
    }
    text << '\n';
  }
  text.flush();
}

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
