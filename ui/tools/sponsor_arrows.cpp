#include "tools/sponsor_arrows.h"

namespace chainmail {
namespace {

constexpr float headPixels = 8;
constexpr float headWidth = 0.45F;    // of its length, to either side
constexpr float largestHead = 0.35F;  // of the arrow
constexpr float smallestArrow = 2;    // pixels between the gaps; a shorter one goes from place to place

}  // namespace

QVector3D placeOf(const Frame& frame, ElementId element) {
  const int dimension = frame.mesh->space_dimension;
  double carried[3]{};
  std::copy_n(frame.positions.data() + std::size_t{element} * std::size_t(dimension), dimension, carried);
  const Point point = frame.mesh->to_point(carried);
  return {float(point.x()), float(point.y()), float(point.z())};
}

SponsorArrows::SponsorArrows(const Overlay::Canvas& canvas, float gap)
    : frame_(canvas.frame),
      toEye_(canvas.scene.toView.row(2).toVector3D().normalized()),
      gap_(gap / 2 * float(canvas.unitsPerPixel)),
      head_(headPixels * float(canvas.unitsPerPixel)) {}

void SponsorArrows::add(const TraceRow& row, std::size_t step) {
  if (row.sponsor == no_element) {
    return;
  }
  QVector3D from = placeOf(frame_, row.sponsor), to = placeOf(frame_, row.element);
  const float length = (to - from).length();
  const QVector3D along = (to - from).normalized();
  if (length > 2 * gap_ + smallestArrow * head_ / headPixels) {
    from += along * gap_;
    to -= along * gap_;
  }
  add(from, to, step);
  if (row.moved) {
    const float head = std::min(head_, largestHead * (to - from).length());
    const QVector3D aside = QVector3D::crossProduct(along, toEye_).normalized() * (headWidth * head);
    add(to - along * head + aside, to, step);
    add(to - along * head - aside, to, step);
  }
}

void SponsorArrows::add(const QVector3D& from, const QVector3D& to, std::size_t step) {
  places_.insert(places_.end(), {from, to});
  values_.insert(values_.end(), 2, float(step));
}

}  // namespace chainmail
