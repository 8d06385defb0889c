#include "report/format.h"
#include "report/page.h"
#include "report/physics_report.h"

namespace chainmail::report {
namespace {

constexpr const char* how_to_read = R"(<h2>How to read it</h2>
<p>Every contestant carries out the same moves of the same hand, on the same object with the same pins, from rest, in
turns within one process and one thread. The <b>truth</b> is neo-Hookean FEM on the object’s own cells, linear elements,
in double precision, converged. <b>Errors</b> are how far elements stand from it at the end of a drag, over the
hand’s displacement: 10% is a tenth of the way that the hand went. <b>What moves</b> are the elements that the truth
displaces by more than 1% of that way: where an object is large and the drag small, the rest stands still with everybody and makes
errors look small. <b>ms a move</b> is the time of a move and of the sweeps of relaxation that follow it, averaged over a
drag: the median over the repetitions.
<b>Prepare</b> is what a method does once for an object, its pins and the element in the hand, before its
first move: factorizations; it is not part of the time a move. BEM works on the outer surface of a volume, and
what is inside follows. The truth is one for a homogeneous, isotropic, compressible material on this mesh: no
mesh is fine enough about a single element that a hand pulls. In the plots, down is better and left is faster.</p>
)";

void write_growths(std::ostream& out, const PhysicsReport& report) {
  if (report.growths.empty()) {
    return;
  }
  out << "<h2>How both grow with size</h2>\n<p>Objects of two kinds double their elements until a contestant has used "
         "up its "
      << figure(report.options.growth_seconds)
      << " s on that kind, building and preparing included. Where the truth has used up its own, errors end. The "
         "exponent is that of the time a move over the elements, from 1000 of them on.</p>\n";
  write_figure(out, growth_time_plot(report.growths));
  write_figure(out, growth_prepare_plot(report.growths));
  write_figure(out, growth_error_plot(report.growths));
  for (const PhysicsGrowth& growth : report.growths) {
    write_html(out, growth_table(growth));
  }
}

}  // namespace

void write_html(std::ostream& out, const PhysicsReport& report, const Origin& origin) {
  begin_page(out, "ChainMail against physics", origin);
  out << how_to_read << "<h2>Time against error</h2>\n";
  if (report.objects.size() > 1) {
    out << "<h3>All objects, means of their drags</h3>\n";
    write_figure(out, physics_overview(report));
  }
  for (const PhysicsObject& object : report.objects) {
    out << "<h3>" << escaped(object.name) << "</h3>\n";
    write_figure(out, physics_plot(object));
  }
  out << "<h2>All figures</h2>\n<p class=\"faint\">Times in milliseconds, medians; errors over the hand’s "
         "displacement.</p>\n";
  for (const PhysicsObject& object : report.objects) {
    write_html(out, physics_table(object));
  }
  write_growths(out, report);
  const Material& material = report.elastic.material;
  const auto& lattice = report.elastic.lattice;
  end_page(out, origin, report.options.contest,
           {{"material", "Young’s modulus " + figure(material.young) + ", Poisson’s ratio " + figure(material.poisson)},
            {"FFD", std::to_string(lattice[0]) + " × " + std::to_string(lattice[1]) + " × " +
                        std::to_string(lattice[2]) + " control points"}});
}

}  // namespace chainmail::report
