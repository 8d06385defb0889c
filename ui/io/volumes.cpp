#include "io/volumes.h"

#include <QFileInfo>
#include <filesystem>

#include "common/as_path.h"
#include "document/edits.h"
#include "files/mesh/open_mesh.h"
#include "files/text/text.h"
#include "io/volume_bar.h"

namespace chainmail {
Volumes::Volumes(Document& document, Jobs& jobs)
    : QObject(&jobs), document_(document), jobs_(jobs), bar_(new VolumeBar) {
  connect(bar_, &AskBar::agreed, this, &Volumes::build);
}

Jobs::Finish Volumes::read(const QString& path, bool first, const Progress& progress) {
  auto volume = std::make_shared<const OpenedVolume>(read_volume(asPath(path), progress));
  return [this, path, first, volume] {
    path_ = path;
    first_ = first;
    volume_ = volume;
    bar_->ask(shownName(path), volume);
  };
}

void Volumes::build() {
  const QString name = shownName(path_);
  jobs_.start(Jobs::Kind::load, QStringLiteral("Opening %1").arg(name),
              [this, path = path_, first = first_, volume = std::move(volume_),
               options = bar_->options()](const Progress& progress) -> Jobs::Finish {
                auto block =
                    std::make_shared<VoxelBlock>(voxel_block(volume->volume, options, shown(asPath(path)), progress));
                return [this, path, first, block] { show(*block, path, first); };
              });
}

Jobs::Finish Volumes::readAsOffered(const QString& path, const Progress& progress) {
  const auto volume = read_volume(asPath(path), progress.part(0, 0.5));
  auto block = std::make_shared<VoxelBlock>(voxel_block(volume, {}, shown(asPath(path)), progress.part(0.5, 1)));
  return [this, path, block] { show(*block, path, false); };
}

void Volumes::show(VoxelBlock& block, const QString& path, bool first) {
  const QString name = shownName(path);
  edits::replaceMesh(document_, block.mesh, name, QStringLiteral("open %1").arg(name),
                     first ? edits::Opening::first : edits::Opening::next, std::move(block.softness));
  emit opened(path);
}

}  // namespace chainmail
