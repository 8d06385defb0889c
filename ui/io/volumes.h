#pragma once

#include <QObject>
#include <memory>

#include "common/jobs.h"
#include "document/document.h"

namespace chainmail {

struct OpenedVolume;
struct VoxelBlock;
class VolumeBar;

/// Reads voxel volumes in the background and makes objects of them with the options of their bar.
class Volumes : public QObject {
  Q_OBJECT

 public:
  Volumes(Document& document, Jobs& jobs);

  VolumeBar& bar() { return *bar_; }
  /// Reads a volume in the thread of a job. The returned function runs in the window and asks for the options. The
  /// object becomes one undo step, or the first object of the window.
  Jobs::Finish read(const QString& path, bool first, const Progress& progress);
  /// Reads a volume and makes the object with the default options, without asking.
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
  std::shared_ptr<const OpenedVolume> volume_;  // while the bar asks about it
};

}  // namespace chainmail
