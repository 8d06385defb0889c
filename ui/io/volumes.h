#pragma once

#include <QObject>
#include <memory>

#include "common/jobs.h"
#include "document/document.h"

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
  /// What a job does that opens one: it reads it, on its own thread, and asks in the end. It becomes one step of undo,
  /// or the window's first object.
  Jobs::Finish read(const QString& path, bool first, const Progress& progress);
  /// The same as it would be offered first, with nothing asked.
  Jobs::Finish readAsOffered(const QString& path, const Progress& progress);

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
