#pragma once

#include <QObject>
#include <future>
#include <memory>
#include <thread>

#include "mesh/surface.h"

namespace chainmail {

/// Computes the surfaces of uncut meshes. Surfaces of small meshes are computed at once, those of large meshes on a
/// separate thread, so that the window stays responsive.
class SurfaceMaker : public QObject {
  Q_OBJECT

 public:
  SurfaceMaker() = default;
  ~SurfaceMaker() override { giveUp(); }

  /// Returns true if take() would not wait. Starts the computation for a new mesh.
  bool has(const MeshPointer& mesh);
  /// Returns the surface; waits if it is still being computed.
  std::unique_ptr<Surface> take(const MeshPointer& mesh);

 signals:
  /// A surface for which has() returned false is ready. Emitted on the thread that computed it.
  void made();

 private:
  void begin(const MeshPointer& mesh);
  void giveUp();

  MeshPointer mesh_;
  std::unique_ptr<Surface> surface_;  // until take()
  CellTablePointer table_;            // for another surface of the same mesh
  std::unique_ptr<JobState> job_;
  std::future<std::unique_ptr<Surface>> result_;
  std::thread thread_;
};

}  // namespace chainmail
