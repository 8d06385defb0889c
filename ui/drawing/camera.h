#pragma once

#include <QMatrix4x4>
#include <QPointF>
#include <QSizeF>
#include <QVector3D>
#include <span>

#include "mesh/mesh.h"

namespace chainmail {

inline QVector3D asVector(const Point& point) { return {float(point.x()), float(point.y()), float(point.z())}; }

/// Where an object is looked at from: straight down on the plane in 1D and 2D, in perspective or
/// by parallel rays about a centre in 3D. Lengths are in mesh units, places in the view in logical pixels from its top
/// left.
class Camera {
 public:
  /// Shows the whole box: straight down on the plane of the axes that the scene carries, or obliquely
  /// from above where it carries all three.
  void fit(const std::array<Point, 2>& box, std::span<const int> axes, QSizeF view);
  /// The same from the side it looks from now.
  void frame(const std::array<Point, 2>& box, QSizeF view);
  /// Whether nobody has shifted it or changed what it shows since then: a view that changes its size may frame again.
  bool framed() const { return framed_; }
  void orbit(QPointF pixels);
  void pan(QPointF pixels, QSizeF view);
  /// Brings the object nearer (factor > 1) about the place under the cursor.
  void zoom(double factor, QPointF cursor, QSizeF view);

  /// Turns about the centre, to a side given by angles (degrees): 0, 0 is from +z, yaw -90 from +x, pitch 90 from +y.
  void lookFrom(double yaw, double pitch);
  const QVector3D& centre() const { return centre_; }
  /// What is turned about comes into the middle of the view.
  void centreOn(const QVector3D& centre);
  /// Parallel rays where a scene has depth, instead of perspective.
  void setParallel(bool parallel) { parallel_ = parallel; }
  bool parallel() const { return parallel_; }

  /// The way it looks, apart from the object: the centre of the view and the height that it shows (mesh units), and
  /// the angles (degrees), which count where it is spatial.
  struct Pose {
    QVector3D centre;
    double height = 2, yaw = 0, pitch = 0;
    bool parallel = false, framed = false;
  };
  Pose pose() const { return {centre_, height_, yaw_, pitch_, parallel_, framed_}; }
  void setPose(const Pose& pose);

  bool spatial() const { return spatial_; }
  QMatrix4x4 toView() const;
  QMatrix4x4 toClip(QSizeF view) const;
  /// Mesh units that a pixel spans, in the plane through the centre.
  double unitsPerPixel(QSizeF view) const;
  /// Distances from the eye between which the object lies, for fading with depth.
  std::array<double, 2> depthRange() const;
  /// The point under a place of the view, in the plane parallel to the view through `through`.
  QVector3D pointAt(QPointF place, const QVector3D& through, QSizeF view) const;

 private:
  QVector3D centre_;
  double radius_ = 1;  // of the object (mesh units)
  double height_ = 2;  // of what the view shows in the plane through the centre (mesh units)
  double yaw_ = 0;     // degrees
  double pitch_ = 0;
  bool spatial_ = false;
  bool parallel_ = false;
  bool framed_ = false;
};

}  // namespace chainmail
