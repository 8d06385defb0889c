#include "report/page/physics_html.h"

#include "report/page/format.h"
#include "report/page/page.h"
#include "report/page/physics_plot.h"
#include "report/page/physics_table.h"

namespace chainmail::report {
namespace {

constexpr const char* how_to_read_physics = R"(<h2>How to read it</h2>
<p>Every contestant carries out the same moves of the same handle, on the same object with the same pins, from rest, in
turns within one process and one thread. An object has up to three handles; figures are means over them. The
<b>reference</b> is neo-Hookean FEM, linear elements, in double precision, converged <b>on the same cells</b> that the
object, linear FEM and neo-Hookean FEM have. It is not converged under refinement of the mesh, and one displaced node has
no continuum limit, so errors depend on the mesh, and linear FEM has an advantage over methods with other cells, such as
BEM with its surface mesh.</p>
<p>The <b>relative error</b> is the RMS distance of all elements from the reference at the end of a drag, over the RMS
displacement of the reference. <b>Nothing moves</b> is an object in which only the handle and the pins have their
prescribed positions: its relative error is about 1, and a method with a larger error is no better than no method. The
other errors are over the displacement of the handle: 10% is a tenth of it. They look small if most of the object moves
little, also when nothing moves. <b>What moves</b> are the elements that the reference displaces by more than 1% of that
displacement.</p>
<p><b>Shape</b>: the Hausdorff distance is the largest distance from a point of one surface to the nearest point of the
other, between the answer and the reference. Volume is that of the cells, or what the faces enclose; in a plane it is the
area. A cell is inverted if it is turned inside out. The stretch is the largest factor by which any direction in a cell is
lengthened. Violation is that of the valid regions of ChainMail, which methods of elasticity do not know.</p>
<p><b>Times</b> include the sweeps of relaxation that follow a move: time of the first move of a drag, mean time of a later
move, and time of the move <b>after a cut</b> in the middle of a drag, with all repeated preparation. <b>Prepare</b> is the
work of a method before its first move: it factorizes once for an object, its pins and its cuts, and finds the response of
the object to each element that is grabbed. Preparation is repeated for one second. Drags that take longer than 0.3 seconds
are not repeated. The brackets contain the quartiles and the number of repetitions. <b>Calibrated</b> contestants have the
softness and the sweeps (at most 10) that are closest to the reference on drags of other elements. <b>+ equilibrium</b>
relaxes after each move to the valid state of least energy.</p>
<p>One rule ends all <b>iterations</b>: a contestant makes the least number per move with which its answer at the end of
the drag is within 1 % of its own limit, the answer after as many as it wants. The reference is for a homogeneous, isotropic, compressible material. In
the plots, lower is better and further left is faster.</p>
)";

void write_growths(std::ostream& out, const PhysicsReport& report) {
  if (report.growths.empty()) {
    return;
  }
  out << "<h2>Growth of time and error with size</h2>\n<p>Objects of two kinds "
         "double their elements until a contestant has used up its "
      << figure(report.options.growth_seconds)
      << " s for that kind, with building and preparing. Errors end where the reference has used up its own time. The "
         "exponent is the growth of the time per move with the number of elements, from 1000 elements on.</p>\n";
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
  out << how_to_read_physics;
  if (has_refined(report)) {
    out << "<p>" << escaped(how_to_read_refined) << "</p>\n";
  }
  out << "<h2>Time against error</h2>\n";
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
  if (const FigureTable turned = symmetry_table(report); !turned.rows.empty()) {
    out << "<h2>Turned objects</h2>\n<p>The object, its pins and one move are turned by 45° and 90°, in the plane or "
           "about z, and the answer is turned back. A method that does not depend on the axes differs by about 0. The "
           "largest distance is over all elements; the relative one is RMS over RMS of the displacements. The valid "
           "regions of ChainMail lie along axes: choose those of the object with <code>--frame object</code>.</p>\n";
    write_html(out, turned);
  }
  write_growths(out, report);
  const Material& material = report.elastic.material;
  const auto& lattice = report.elastic.lattice;
  end_page(out, origin, report.options.contest,
           {{"material", "Young’s modulus " + figure(material.young) + ", Poisson’s ratio " + figure(material.poisson)},
            {"FFD", std::to_string(lattice[0]) + " × " + std::to_string(lattice[1]) + " × " +
                        std::to_string(lattice[2]) + " control points"},
            {"XPBD, neo-Hookean XPBD, Projective Dynamics",
             "at most " + std::to_string(report.elastic.iterations) + " iterations per move"}});
}

}  // namespace chainmail::report
