#pragma once

#include <QCheckBox>
#include <QDoubleSpinBox>
#include <QObject>
#include <QSlider>
#include <QSpinBox>
#include <memory>
#include <vector>

#include "common/ask_bar.h"
#include "common/jobs.h"
#include "document/document.h"
#include "document/edits.h"
#include "files/formats/voxel_block.h"
#include "files/mesh/input_file.h"

namespace chainmail {

/// A volume before it becomes an object, with the number of voxels above each density.
struct OpenedVolume {
  /// Counts the voxels, which is slow for large volumes.
  explicit OpenedVolume(Volume&& volume);
  /// Returns the number of voxels of this density or more.
  std::uint64_t above(double density) const;

  Volume volume;
  double standardThreshold = 0;
  std::vector<std::uint64_t> atLeast;  // number of voxels with at least this density, per density step
};

/// Asks for the lowest density of voxels in the object and for the number of voxels per element.
class VolumeBar : public AskBar {
  Q_OBJECT

 public:
  VolumeBar();

  void ask(const QString& name, std::shared_ptr<const OpenedVolume> volume);
  VoxelOptions options() const;

 private:
  void makeFields();
  void describe();
  /// Convert between densities and positions of the slider.
  int toSlider(double density) const;
  double fromSlider(int position) const;

  std::shared_ptr<const OpenedVolume> volume_;
  QSlider* slider_;
  QDoubleSpinBox* threshold_;
  QSpinBox* every_;
  QCheckBox* stiff_;
};

/// Reads voxel volumes in the background and makes objects of them with the options of their bar.
class Volumes : public QObject {
  Q_OBJECT

 public:
  Volumes(Document& document, Jobs& jobs);

  VolumeBar& bar() { return *bar_; }
  /// Reads a volume in the thread of a job. The returned function runs in the window: it asks for the options, or shows
  /// the object that the default options make.
  Jobs::Finish read(InputFile input, const QString& path, edits::Opening opening, bool asks, const Progress& progress);

 signals:
  void opened(const QString& path);

 private:
  void build();
  Jobs::Finish objectOf(const Volume& volume, const VoxelOptions& options, const QString& path, edits::Opening opening,
                        const Progress& progress);

  Document& document_;
  Jobs& jobs_;
  VolumeBar* bar_;
  QString path_;
  edits::Opening opening_ = edits::Opening::next;
  std::shared_ptr<const OpenedVolume> volume_;  // while the bar asks about it
};

}  // namespace chainmail
