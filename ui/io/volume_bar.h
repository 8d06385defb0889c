#pragma once

#include <QCheckBox>
#include <QDoubleSpinBox>
#include <QSlider>
#include <QSpinBox>
#include <memory>
#include <vector>

#include "common/ask_bar.h"
#include "files/formats/voxel_block.h"

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

}  // namespace chainmail
