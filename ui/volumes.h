#pragma once

#include <QObject>
#include <memory>

#include "document.h"
#include "jobs.h"

namespace chainmail {

struct OpenedVolume;
struct VoxelBlock;
class VolumeBar;

/// Volumes of voxels: read in the background, and made into objects as their bar is told.
class Volumes : public QObject {
  Q_OBJECT

 public:
  Volumes(Document& document, Jobs& jobs);

  VolumeBar& bar() { return *bar_; }
  /// Reads it and asks; as one step of undo, or as the window's first object.
  void openPath(const QString& path, bool first = false);
  /// Opens it as it is offered first, and asks nothing.
  void open(const QString& path);

 signals:
  void opened(const QString& path);

 private:
  void build();
  void show(VoxelBlock& block, const QString& path, bool first);

  Document& document_;
  Jobs& jobs_;
  VolumeBar* bar_;
  QString path_;
  bool first_ = false;
  std::shared_ptr<const OpenedVolume> volume_;  // as long as it is asked about
};

}  // namespace chainmail
