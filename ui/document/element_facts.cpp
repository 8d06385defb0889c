#include "document/element_facts.h"

#include <QStringList>
#include <algorithm>

#include "common/text.h"
#include "measure/violation.h"

namespace chainmail {
namespace {

constexpr int digits = 6;  // significant digits; a position in single precision has about 7

/// Calls `visit` with each uncut link of an element.
template <class Visit>
void eachLink(const Document& document, ElementId element, Visit visit) {
  const Mesh& mesh = *document.mesh();
  for (EntryId entry = mesh.first_entry[element]; entry < mesh.first_entry[element + 1]; ++entry) {
    if (!document.cuts().is_cut(mesh.entry_link[entry])) {
      visit(mesh.entry_link[entry]);
    }
  }
}

}  // namespace

SoftnessRange softnessOf(const Document& document, ElementId element) {
  SoftnessRange result;
  eachLink(document, element, [&](LinkId link) {
    const LinkSoftness& one = document.wholeSoftness()->of(link);
    if (result.links++ == 0) {
      result.least = result.most = one;
    }
    for (const auto& [parameter, member] : softness_numbers) {
      result.least.*member = std::min(result.least.*member, one.*member);
      result.most.*member = std::max(result.most.*member, one.*member);
    }
  });
  return result;
}

bool isPinned(const Document& document, ElementId element) {
  return std::ranges::binary_search(document.pins(), element);
}

/// Free-form deformation is the only elastic method that needs no pins.
bool lacksPins(const Document& document, int panel) {
  return document.pins().empty() && info(document.algorithm(panel)).needs_pins;
}

Point positionIn(const Document& document, int panel, ElementId element) {
  const Frame* frame = document.solvers().frame(panel);
  return frame == nullptr ? document.mesh()->rest_position(element) : point_of(*frame->mesh, frame->view(), element);
}

Point middleIn(const Document& document, int panel, std::span<const ElementId> elements) {
  Point sum = Point::Zero();
  for (const ElementId element : elements) {
    sum += positionIn(document, panel, element);
  }
  return sum / double(std::max<std::size_t>(1, elements.size()));
}

double violationOfLink(const Document& document, int panel, LinkId link) {
  const Frame* frame = document.solvers().frame(panel);
  return frame == nullptr ? 0 : link_violation(*frame->mesh, *document.wholeSoftness(), frame->view(), link);
}

double violationIn(const Document& document, int panel, ElementId element) {
  double largest = 0;
  eachLink(document, element,
           [&](LinkId link) { largest = std::max(largest, violationOfLink(document, panel, link)); });
  return largest;
}

QString figure(double value) { return shownNumber(value, 'g', digits); }

QString coordinates(const Mesh& mesh, const Point& point, const QString& prefix) {
  QStringList parts;
  for (int k = 0; k < mesh.space_dimension; ++k) {
    const int axis = mesh.axes[std::size_t(k)];
    parts << QStringLiteral("%1%2 %3").arg(prefix, QChar::fromLatin1("xyz"[axis]), figure(point[axis]));
  }
  return parts.join(QStringLiteral(", "));
}

QString range(double least, double most) {
  return least == most ? figure(least) : QStringLiteral("%1–%2").arg(figure(least), figure(most));
}

}  // namespace chainmail
