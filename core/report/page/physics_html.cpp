#include "report/page/physics_html.h"

#include "report/page/format.h"
#include "report/page/page.h"
#include "report/page/physics_plot.h"
#include "report/page/physics_table.h"

namespace chainmail::report {
namespace {

constexpr const char* how_to_read = R"(<h2>How to read it</h2>
<p>Every contestant carries out the same moves of the same handle, on the same object with the same pins, from rest, in
turns within one process and one thread. An object has up to three handles; figures are means over them. The
<b>reference</b> is neo-Hookean FEM, linear elements, in double precision, converged <b>on the same cells</b> that the
object, linear FEM and neo-Hookean FEM have. It is not converged under refinement of the mesh, and one displaced node has
no continuum limit, so errors depend on the mesh, and linear FEM has an advantage over methods with other cells, such as
BEM with its surface mesh.</p>
<p>The <b>relative error</b> is the RMS of how far elements stand from the reference at the end of a drag, over the RMS of
the reference’s displacements, over all elements. <b>Nothing moves</b> is an object of which only the handle and the pins
stand where they are prescribed: its relative error is about 1, and a method with more is no better than no method. The
other errors are over the handle’s displacement: 10% is a tenth of the way that the handle went. They look small where
most of the object moves little, with nothing moving too. <b>What moves</b> are the elements that the reference displaces
by more than 1% of that way.</p>
<p><b>Times</b> are of a move and of the sweeps of relaxation that follow it: of the first move of a drag, of a later move
on average, and of the move <b>after a cut</b> in the middle of a drag, with all that must be prepared anew. <b>Prepare</b>
is what a method does before its first move: it factorizes once for an object, its pins and its cuts, and works out how the
object answers to each element that is grabbed. Preparation is repeated as long as a second lasts, drags that take longer
than 0.3 seconds are not repeated; the number of repetitions stands in brackets with the quartiles. <b>Calibrated</b>
contestants have the softness and the sweeps that come closest to the reference on drags of other elements, of up to 10 sweeps. The reference
is one for a homogeneous, isotropic, compressible material. In the plots, down is better and left is faster.</p>
)";

void write_growths(std::ostream& out, const PhysicsReport& report) {
  if (report.growths.empty()) {
    return;
  }
  out << "<h2>How both grow with size</h2>\n<p>Objects of two kinds double their elements until a contestant has used "
         "up its "
      << figure(report.options.growth_seconds)
      << " s on that kind, building and preparing included. Where the reference has used up its own, errors end. The "
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
  out << "<h2>All figures</h2>\n<p class=\"faint\">Times in milliseconds, medians; errors in percent are over "
         "the handle’s displacement.</p>\n";
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
