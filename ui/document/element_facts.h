#pragma once

#include <QString>

#include "common/panel_names.h"
#include "document/document.h"

namespace chainmail {

/// What there is to say about single elements, in words for the window. All cost an element's links, no more.

/// The softness of an element's links that are not cut, from the least to the most.
struct SoftnessRange {
  LinkSoftness least, most;
  std::size_t links = 0;
};
SoftnessRange softnessOf(const Document& document, ElementId element);

/// Where an element stands in a panel; at rest as long as the panel shows nothing (mesh units).
Point positionIn(const Document& document, int panel, ElementId element);
/// The largest violation of an element's links in a panel (rest lengths of the link).
double violationIn(const Document& document, int panel, ElementId element);
double violationOfLink(const Document& document, int panel, LinkId link);

/// The coordinates that the scene carries: 'x 3, y 2.5'.
QString coordinates(const Mesh& mesh, const Point& point, const QString& prefix = {});
/// A figure to as many digits as a panel's positions have.
QString figure(double value);
/// '0.8', or '0.8–0.9'.
QString range(double least, double most);

}  // namespace chainmail
