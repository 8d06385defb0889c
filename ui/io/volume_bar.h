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

/// A volume that is about to become an object, and how many of its voxels each density leaves.
struct OpenedVolume {
  /// Counts; what takes a while for large volumes.
  explicit OpenedVolume(Volume&& volume);
  /// How many voxels are as dense as this or denser.
  std::uint64_t above(double density) const;

  Volume volume;
  double standardThreshold = 0;
  std::vector<std::uint64_t> atLeast;  // how many voxels have each step of density or more
};

/// Asks which voxels of a volume there are, and how many become one element.
class VolumeBar : public AskBar {
  Q_OBJECT

 public:
  VolumeBar();

  void ask(const QString& name, std::shared_ptr<const OpenedVolume> volume);
  VoxelOptions options() const;

 private:
  void makeFields();
  void describe();
  /// The slider's place for a density, and back.
  int toSlider(double density) const;
  double fromSlider(int place) const;

  std::shared_ptr<const OpenedVolume> volume_;
  QSlider* slider_;
  QDoubleSpinBox* threshold_;
  QSpinBox* every_;
  QCheckBox* stiff_;
};

}  // namespace chainmail
