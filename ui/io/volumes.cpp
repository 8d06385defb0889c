#include "io/volumes.h"

#include <QSignalBlocker>
#include <algorithm>
#include <cmath>
#include <utility>

#include "common/as_path.h"
#include "common/number_field.h"
#include "files/mesh/mesh_formats.h"
#include "files/text/text.h"

namespace chainmail {
namespace {

constexpr int densitySteps = 1000;

double highestOf(const OpenedVolume& one) {
  return one.volume.lowest + one.volume.step * double(one.atLeast.size() - 1);
}

}  // namespace

OpenedVolume::OpenedVolume(Volume&& opened) : volume(std::move(opened)), standardThreshold(otsu_threshold(volume)) {
  const auto highest = *std::max_element(volume.densities.begin(), volume.densities.end());
  atLeast.resize(std::size_t{highest} + 1);
  for (const std::uint16_t density : volume.densities) {
    ++atLeast[density];
  }
  for (std::size_t i = atLeast.size() - 1; i > 0; --i) {
    atLeast[i - 1] += atLeast[i];
  }
}

std::uint64_t OpenedVolume::above(double density) const {
  const double step = std::ceil((density - volume.lowest) / volume.step);
  return step >= double(atLeast.size()) ? 0 : atLeast[std::size_t(std::max(step, 0.0))];
}

VolumeBar::VolumeBar()
    : AskBar(QStringLiteral("volume"), QStringLiteral("Open &volume"),
             QStringLiteral("Replaces the object with the dense voxels of the volume, as one undo step")),
      slider_(new QSlider(Qt::Horizontal)),
      threshold_(new NumberField(QStringLiteral("Threshold"))),
      every_(new QSpinBox),
      stiff_(new QCheckBox(QStringLiteral("So&ftness from density"))) {
  makeFields();
  connect(slider_, &QSlider::valueChanged, this, [this](int position) { threshold_->setValue(fromSlider(position)); });
  connect(threshold_, &QDoubleSpinBox::valueChanged, this, &VolumeBar::describe);
  connect(every_, &QSpinBox::valueChanged, this, &VolumeBar::describe);
}

void VolumeBar::makeFields() {
  slider_->setObjectName(QStringLiteral("volumeSlider"));
  slider_->setAccessibleName(QStringLiteral("Lowest density (slider)"));
  slider_->setRange(0, densitySteps);
  slider_->setMinimumWidth(60);
  threshold_->setObjectName(QStringLiteral("volumeThreshold"));
  threshold_->setAccessibleName(QStringLiteral("Lowest density"));
  every_->setObjectName(QStringLiteral("volumeEvery"));
  every_->setAccessibleName(QStringLiteral("Voxels per element along each axis"));
  every_->setRange(0, 64);
  every_->setSpecialValueText(QStringLiteral("auto"));
  stiff_->setObjectName(QStringLiteral("volumeStiff"));
  stiff_->setChecked(VoxelOptions().stiff_where_dense);
  slider_->setToolTip(QStringLiteral("Voxels of this density or more become elements"));
  threshold_->setToolTip(slider_->toolTip() +
                         QStringLiteral(". The default separates the densities best (Otsu's method)"));
  every_->setToolTip(
      QStringLiteral("Number of voxels along each axis that become one element; auto gives at most %L1 elements")
          .arg(voxel_elements));
  stiff_->setToolTip(QStringLiteral(
      "Sets the softness of links by density: from the default at the lowest density to rigid at the highest"));
  addField(QStringLiteral("Lowest &density"), threshold_);
  addField({}, slider_);
  addField(QStringLiteral("Vo&xels per element"), every_);
  addField({}, stiff_);
}

int VolumeBar::toSlider(double density) const {
  const double range = highestOf(*volume_) - volume_->volume.lowest;
  return range > 0 ? int(std::lround(densitySteps * (density - volume_->volume.lowest) / range)) : 0;
}

double VolumeBar::fromSlider(int position) const {
  return volume_->volume.lowest + (highestOf(*volume_) - volume_->volume.lowest) * position / densitySteps;
}

void VolumeBar::ask(const QString& name, std::shared_ptr<const OpenedVolume> volume) {
  volume_ = std::move(volume);
  const Volume& of = volume_->volume;
  const double range = highestOf(*volume_) - of.lowest;
  const QSignalBlocker quiet(threshold_);
  threshold_->setDecimals(range >= 100 ? 0 : range >= 1 ? 2 : 6);
  threshold_->setRange(of.lowest, highestOf(*volume_));
  threshold_->setSingleStep(range / 100);
  threshold_->setValue(volume_->standardThreshold);
  describe();
  QString title =
      QStringLiteral("%1: %L2 × %L3 × %L4 voxels").arg(name).arg(of.size[0]).arg(of.size[1]).arg(of.size[2]);
  if (of.merged > 1) {
    title += QStringLiteral(", each the mean of up to %L1 × %L1 × %L1 of the file").arg(of.merged);
  }
  AskBar::ask(title, threshold_);
}

VoxelOptions VolumeBar::options() const {
  return {.threshold = threshold_->value(),
          .every = every_->value() > 0 ? std::optional(std::uint32_t(every_->value())) : std::nullopt,
          .stiff_where_dense = stiff_->isChecked()};
}

void VolumeBar::describe() {
  const QSignalBlocker quiet(slider_);
  slider_->setValue(toSlider(threshold_->value()));
  const std::uint64_t above = volume_->above(threshold_->value());
  const int merged = int(volume_->volume.merged);
  const int every = every_->value() > 0 ? (every_->value() - 1) / merged + 1 : 1;  // voxels in memory, as it opens
  const double elements = double(above) / std::pow(every, 3);
  QString result = QStringLiteral("%L1 voxels").arg(above);
  if (every_->value() > 1) {
    result += QStringLiteral(", about %L1 elements").arg(std::llround(elements));
  }
  showResult(result, above > 0 && elements <= double(element_limit));
}

Volumes::Volumes(Document& document, Jobs& jobs)
    : QObject(&jobs), document_(document), jobs_(jobs), bar_(new VolumeBar) {
  connect(bar_, &AskBar::agreed, this, &Volumes::build);
}

Jobs::Finish Volumes::read(InputFile input, const QString& path, edits::Opening opening, bool asks,
                           const Progress& progress) {
  Volume volume = input.format->read_volume(std::move(input.file), {}, progress.part(0, asks ? 1 : 0.5));
  if (!asks) {
    return objectOf(volume, {}, path, opening, progress.part(0.5, 1));
  }
  return [this, path, opening, voxels = std::make_shared<const OpenedVolume>(std::move(volume))] {
    path_ = path;
    opening_ = opening;
    volume_ = voxels;
    bar_->ask(shownName(path), voxels);
  };
}

void Volumes::build() {
  jobs_.start(Jobs::Kind::load, QStringLiteral("Opening %1").arg(shownName(path_)),
              [this, path = path_, opening = opening_, volume = std::move(volume_), options = bar_->options()](
                  const Progress& progress) { return objectOf(volume->volume, options, path, opening, progress); });
}

Jobs::Finish Volumes::objectOf(const Volume& volume, const VoxelOptions& options, const QString& path,
                               edits::Opening opening, const Progress& progress) {
  const auto block = std::make_shared<VoxelBlock>(voxel_block(volume, options, shown(asPath(path)), progress));
  return [this, path, opening, block] {
    const QString name = shownName(path);
    edits::replaceMesh(document_, block->mesh, name, QStringLiteral("open %1").arg(name), opening,
                       std::move(block->softness));
    emit opened(path);
  };
}

}  // namespace chainmail
