#pragma once

#include <QVector3D>
#include <vector>

#include "panels/overlay.h"

namespace chainmail {

/// Where an element of a frame stands in space (mesh units).
QVector3D placeOf(const Frame& frame, ElementId element);

/// Arrows from sponsors to the elements that they have updated, as pairs of ends. One to an element that stayed has no
/// head: nothing was passed on.
class SponsorArrows {
 public:
  /// `gap` (logical pixels across) is left free about elements, which are marked there.
  SponsorArrows(const Overlay::Canvas& canvas, float gap);

  /// The arrow of a step; its value is the step. Nothing, where there is no sponsor.
  void add(const TraceRow& row, std::size_t step);

  const std::vector<QVector3D>& places() const { return places_; }
  const std::vector<float>& values() const { return values_; }

 private:
  void add(const QVector3D& from, const QVector3D& to, std::size_t step);

  const Frame& frame_;
  QVector3D toEye_;
  float gap_, head_;  // mesh units
  std::vector<QVector3D> places_;
  std::vector<float> values_;
};

}  // namespace chainmail
