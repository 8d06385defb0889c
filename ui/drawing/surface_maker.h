#pragma once

#include <QObject>
#include <exception>
#include <future>
#include <memory>

#include "common/jobs.h"
#include "mesh/surface.h"

namespace chainmail {

/// Computes the surfaces of uncut meshes. Surfaces of small meshes are computed at once, those of large meshes on a
/// separate thread, so that the window stays responsive.
class SurfaceMaker : public QObject {
  Q_OBJECT

 public:
  SurfaceMaker() = default;
  ~SurfaceMaker() override { giveUp(); }

  /// Returns true if take() would neither wait nor throw. Starts the computation for a new mesh.
  bool has(const MeshPointer& mesh);
  /// Returns true if take() would not throw; waits if it is still being computed.
  bool succeeds(const MeshPointer& mesh);
  /// Returns the surface; waits if it is still being computed. If that failed, throws the reason.
  std::unique_ptr<Surface> take(const MeshPointer& mesh);

 signals:
  /// The computation of a surface for which has() returned false has ended. Emitted on the thread that computed it.
  void made();
  /// There is no surface of a mesh: `sentence` gives the reason. Emitted by has() or take(), once for each mesh.
  void failed(const QString& sentence);

 private:
  void begin(const MeshPointer& mesh);
  bool beginInBackground(const MeshPointer& mesh);
  void receive();
  void giveUp();

  MeshPointer mesh_;
  std::unique_ptr<Surface> surface_;  // until take()
  CellTablePointer table_;            // for another surface of the same mesh
  Progress job_;
  std::future<std::unique_ptr<Surface>> result_;  // valid while it is being computed
  std::exception_ptr failure_;                    // why there is none
  TaskThread thread_;                             // last: ends before the members that its tasks use
};

}  // namespace chainmail
