#include "volumes.h"

#include <QFileInfo>
#include <filesystem>

#include "files/open_mesh.h"
#include "files/text.h"
#include "volume_bar.h"

namespace chainmail {
namespace {

std::filesystem::path asPath(const QString& path) { return {path.toStdU16String()}; }

}  // namespace

Volumes::Volumes(Document& document, Jobs& jobs)
    : QObject(&jobs), document_(document), jobs_(jobs), bar_(new VolumeBar) {
  connect(bar_, &AskBar::agreed, this, &Volumes::build);
}

void Volumes::openPath(const QString& path, bool first) {
  const QString name = QFileInfo(path).fileName();
  jobs_.start(Jobs::Kind::load, QStringLiteral("Reading %1").arg(name),
              [this, path, name, first](const Progress& progress) -> Jobs::Finish {
                auto volume = std::make_shared<const OpenedVolume>(read_volume(asPath(path), progress));
                return [this, path, name, first, volume] {
                  path_ = path;
                  first_ = first;
                  volume_ = volume;
                  bar_->ask(name, volume);
                };
              });
}

void Volumes::build() {
  const QString name = QFileInfo(path_).fileName();
  jobs_.start(Jobs::Kind::load, QStringLiteral("Opening %1").arg(name),
              [this, path = path_, first = first_, volume = std::move(volume_),
               options = bar_->options()](const Progress& progress) -> Jobs::Finish {
                auto block =
                    std::make_shared<VoxelBlock>(voxel_block(volume->volume, options, shown(asPath(path)), progress));
                return [this, path, first, block] { show(*block, path, first); };
              });
}

void Volumes::open(const QString& path) {
  jobs_.start(Jobs::Kind::load, QStringLiteral("Opening %1").arg(QFileInfo(path).fileName()),
              [this, path](const Progress& progress) -> Jobs::Finish {
                const auto volume = read_volume(asPath(path), progress.part(0, 0.5));
                auto block =
                    std::make_shared<VoxelBlock>(voxel_block(volume, {}, shown(asPath(path)), progress.part(0.5, 1)));
                return [this, path, block] { show(*block, path, false); };
              });
}

void Volumes::show(VoxelBlock& block, const QString& path, bool first) {
  const QString name = QFileInfo(path).fileName();
  document_.replaceMesh(block.mesh, name, QStringLiteral("open %1").arg(name), std::move(block.softness));
  if (first) {
    document_.undoStack().clear();
  }
  emit opened(path);
}

}  // namespace chainmail
