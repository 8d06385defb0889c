#pragma once

#include <QObject>
#include <future>
#include <memory>
#include <thread>

#include "mesh/surface.h"

namespace chainmail {

/// Makes the surfaces of meshes as they are uncut: of small ones at once, of large ones on a thread of its own, while
/// the window goes on.
class SurfaceMaker : public QObject {
  Q_OBJECT

 public:
  SurfaceMaker() = default;
  ~SurfaceMaker() override { giveUp(); }

  /// Whether the mesh's surface can be had without a wait; it is being made from now on.
  bool has(const MeshPointer& mesh);
  /// Waits where it must.
  std::unique_ptr<Surface> take(const MeshPointer& mesh);

 signals:
  /// What was not there when it was asked for is there now. Comes from the thread that has made it.
  void made();

 private:
  void begin(const MeshPointer& mesh);
  void giveUp();

  MeshPointer mesh_;
  std::unique_ptr<Surface> surface_;  // until it is taken
  CellTablePointer table_;            // what another one of the same mesh is made of
  std::unique_ptr<JobState> job_;
  std::future<std::unique_ptr<Surface>> result_;
  std::thread thread_;
};

}  // namespace chainmail
