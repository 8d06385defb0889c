#pragma once

#include <QString>
#include <span>

#include "common/text.h"
#include "document/document.h"

namespace chainmail {

/// Data of single elements, and its text for the interface. The time depends only on the number of links of the
/// element.

/// The range of the softness of the uncut links of an element.
struct SoftnessRange {
  LinkSoftness least, most;
  std::size_t links = 0;
};
SoftnessRange softnessOf(const Document& document, ElementId element);

bool isPinned(const Document& document, ElementId element);
/// True if a panel's method has no solution because no element is pinned.
bool lacksPins(const Document& document, int panel);

/// Returns the position of an element in a panel (mesh units); its rest position while the panel shows nothing.
Point positionIn(const Document& document, int panel, ElementId element);
/// Returns the mean position of elements in a panel (mesh units): the pivot of a handle that holds them.
Point middleIn(const Document& document, int panel, std::span<const ElementId> elements);
/// Returns the largest violation of an element's links in a panel (rest lengths of the link).
double violationIn(const Document& document, int panel, ElementId element);
double violationOfLink(const Document& document, int panel, LinkId link);

/// Returns the coordinates of a point on the axes of the mesh as text, such as 'x 3, y 2.5'.
QString coordinates(const Mesh& mesh, const Point& point, const QString& prefix = {});
/// Returns a number as text, with 6 significant digits.
QString figure(double value);
/// Returns a range as text, such as '0.8–0.9', or '0.8' if both ends are equal.
QString range(double least, double most);

}  // namespace chainmail
