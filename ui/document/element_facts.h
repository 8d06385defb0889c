#pragma once

#include <QString>

#include "common/panel_names.h"
#include "document/document.h"

namespace chainmail {

/// Data of single elements, and its text for the interface. The cost is that of the links of the element.

/// The range of the softness of the uncut links of an element.
struct SoftnessRange {
  LinkSoftness least, most;
  std::size_t links = 0;
};
SoftnessRange softnessOf(const Document& document, ElementId element);

/// Returns the position of an element in a panel (mesh units); at rest while the panel shows nothing.
Point positionIn(const Document& document, int panel, ElementId element);
/// Returns the largest violation of an element's links in a panel (rest lengths of the link).
double violationIn(const Document& document, int panel, ElementId element);
double violationOfLink(const Document& document, int panel, LinkId link);

/// Returns the coordinates that the scene has: 'x 3, y 2.5'.
QString coordinates(const Mesh& mesh, const Point& point, const QString& prefix = {});
/// Returns a number with as many digits as the positions of a panel have.
QString figure(double value);
/// Returns '0.8', or '0.8–0.9'.
QString range(double least, double most);

}  // namespace chainmail
