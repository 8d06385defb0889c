#pragma once

#include <QMatrix4x4>
#include <QPointF>
#include <QSizeF>
#include <QString>
#include <QVector3D>
#include <algorithm>
#include <array>
#include <span>

#include "mesh/mesh.h"

namespace chainmail {

inline QVector3D asVector(const Point& point) { return {float(point.x()), float(point.y()), float(point.z())}; }

/// Returns the eight corners of a box.
std::array<QVector3D, 8> cornersOf(const std::array<Point, 2>& box);

/// The camera of a view. In 1D and 2D, it looks straight at the plane. In 3D, it orbits a centre, with perspective or
/// parallel projection. Points and lengths are those of frames (FrameSpace), which are mesh units for most objects.
/// Positions in the view are in logical pixels from its top left corner.
class Camera {
 public:
  /// Shows the whole box: straight at the plane of the given axes, or obliquely from above if there are three of them.
  void fit(const std::array<Point, 2>& box, std::span<const int> axes, QSizeF view);
  /// Shows all points from the current side, as large as possible with a small margin.
  void frame(std::span<const QVector3D> points, QSizeF view);
  /// True if the camera was neither panned nor zoomed since fit() or frame(). A resized view may then frame
  /// it again.
  bool framed() const { return framed_; }
  void orbit(QPointF pixels);
  void pan(QPointF pixels, QSizeF view);
  /// Enlarges the object if factor > 1, or reduces it. The point under the cursor stays there.
  void zoom(double factor, QPointF cursor, QSizeF view);

  /// The axis that points up in the view at pitch 0 (3D only).
  enum class Up { y, z };
  void setUp(Up up) { up_ = up; }
  Up up() const { return up_; }
  /// Looks at the centre from a direction (degrees). If y is up: yaw 0 and pitch 0 from +z, yaw -90 from +x, pitch 90
  /// from +y. If z is up: from -y, +x and +z.
  void lookFrom(double yaw, double pitch);
  /// Looks at the centre from the positive or negative end of an axis (0 to 2).
  void lookFromAxis(int axis, bool positive);
  const QVector3D& centre() const { return centre_; }
  /// Moves this point to the middle of the view and makes it the centre of rotation.
  void centreOn(const QVector3D& centre);
  /// Switches between parallel projection and perspective in 3D.
  void setParallel(bool parallel) { parallel_ = parallel; }
  bool parallel() const { return parallel_; }

  /// The state of the camera without the size of the object: centre and visible height, and angles
  /// (degrees), which are used only in 3D.
  struct Pose {
    QVector3D centre;
    double height = 2, yaw = 0, pitch = 0;
    bool parallel = false, framed = false;
    Up up = Up::y;
  };
  Pose pose() const { return {centre_, height_, yaw_, pitch_, parallel_, framed_, up_}; }
  void setPose(const Pose& pose);

  bool spatial() const { return spatial_; }
  QMatrix4x4 toView() const;
  QMatrix4x4 toClip(QSizeF view) const;
  /// Returns the units per pixel in the plane through the centre.
  double unitsPerPixel(QSizeF view) const;
  /// Returns the smallest and the largest distance of the object from the eye, for fading with depth.
  std::array<double, 2> depthRange() const;
  /// Returns the point in space under a position in the view. It lies in the plane that contains `through` and is
  /// parallel to the view.
  QVector3D pointAt(QPointF position, const QVector3D& through, QSizeF view) const;

 private:
  QMatrix4x4 rotation() const;
  void frameFlat(std::span<const QVector3D> turned, double aspect);
  void frameInPerspective(std::span<const QVector3D> turned, double aspect);

  QVector3D centre_;
  double radius_ = 1;  // of the object
  double height_ = 2;  // visible height in the plane through the centre
  double yaw_ = 0;     // degrees
  double pitch_ = 0;   // degrees
  bool spatial_ = false;
  bool parallel_ = false;
  bool framed_ = false;
  Up up_ = Up::y;
};

/// True if objects in files of this format usually stand on the xy plane: parts for printing, and scans of patients.
/// Otherwise the y axis usually points up, as in graphics.
inline bool usuallyZUp(const QString& fileName) {
  constexpr std::array endings{".stl", ".nrrd", ".nhdr", ".mha", ".mhd"};
  return std::ranges::any_of(
      endings, [&](const char* ending) { return fileName.endsWith(QLatin1String(ending), Qt::CaseInsensitive); });
}

}  // namespace chainmail
