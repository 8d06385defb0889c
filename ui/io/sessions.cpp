#include "io/sessions.h"

#include <sys/stat.h>

#include <QDir>
#include <QFileInfo>
#include <QJsonDocument>
#include <QJsonObject>

#include "common/as_path.h"
#include "document/session_draft.h"
#include "drawing/mesh_levels.h"
#include "files/mesh/input_file.h"
#include "files/text/text.h"
#include "io/picture_file.h"
#include "io/samples.h"
#include "io/unsaved_work.h"
#include "mesh/error.h"

namespace chainmail {
namespace {

QString found(const QString& session, const QString& name) {
  for (const QString& folder : {QFileInfo(session).path(), samplesFolder()}) {
    QString path = QDir(folder).filePath(name);
    if (std::error_code none; !folder.isEmpty() && std::filesystem::exists(asPath(path), none)) {
      return path;
    }
  }
  throw Error(shown(asPath(session)), "its mesh " + in_quotes(name.toStdString()) + " was not found",
              "put that file into the folder of the session");
}

/// Returns the file that an automatically saved session was opened from or saved to, if any.
QString ownFile(const Session& session) {
  const auto layout = QJsonDocument::fromJson(QByteArray::fromStdString(session.ui)).object();
  return pathOfKept(layout[QStringLiteral("file")].toString());
}

}  // namespace

std::optional<FileState> stateOf(const QString& path) {
  struct stat status {};
  if (stat(asPath(path).c_str(), &status) != 0) {
    return std::nullopt;
  }
  return FileState{std::uint64_t(status.st_dev), std::uint64_t(status.st_ino), std::uint64_t(status.st_size),
                   std::int64_t(status.st_mtim.tv_sec), std::int64_t(status.st_mtim.tv_nsec)};
}

void KnownFiles::know(const QString& path, const std::optional<FileState>& state) {
  if (state) {
    known_[path] = *state;
  } else {
    known_.erase(path);
  }
}

bool KnownFiles::isChanged(const QString& path) const {
  const auto known = known_.find(path);
  const auto now = stateOf(path);
  return known != known_.end() && now && *now != known->second;
}

namespace {

/// Returns what opens the meshes and pictures that a session names: in the folder of the session, or among the samples.
MeshOpener meshesNear(const QString& session) {
  return [session](const std::string& name, std::uint32_t across, const Progress& progress) -> MeshPointer {
    InputFile input = open_file(asPath(found(session, QString::fromStdString(name))));
    return input.kind == FileKind::picture
               ? readSheet(std::move(input.file), across > 0 ? across : elementsAcross, progress)
               : open_mesh(std::move(input), {}, progress).mesh;
  };
}

}  // namespace

Sessions::Sessions(Document& document, Jobs& jobs, LayoutAccess layout, QObject* parent)
    : QObject(parent), document_(document), jobs_(jobs), layout_(std::move(layout)), recovery_(new RecoveryBar) {
  connect(recovery_, &RecoveryBar::restoreRequested, this, &Sessions::restore);
  connect(recovery_, &RecoveryBar::discarded, this, [this] {
    emit noted(
        QStringLiteral("The unsaved work is deleted when this window closes. Until then, File > Take back discarded "
                       "work offers it again"));
  });
  connect(&document_.undoStack(), &QUndoStack::indexChanged, this, [this] { ++steps_; });
}

Sessions::~Sessions() = default;

Jobs::Finish Sessions::read(RegularFile file, const QString& path, edits::Opening opening, const Progress& progress) {
  const auto session =
      std::make_shared<const Session>(read_session(std::move(file), progress.part(0, 0.9), meshesNear(path)));
  prepareLevels(session->mesh, progress.part(0.9, 1));
  return [this, session, path, opening] {
    const QString own = isSample(path) ? QString() : QFileInfo(path).absoluteFilePath();
    edits::restore(document_, session, own, QStringLiteral("open %1").arg(shownName(path)), opening);
    layout_.set(session->ui);
    emit opened(path);
  };
}

void Sessions::savePath(const QString& path) {
  jobs_.start(Jobs::Kind::save, QStringLiteral("Saving %1").arg(shownName(path)),
              [this, path, steps = steps_, mesh = document_.unsplitMesh(),
               draft = SessionDraft(document_, layout_.read())](const Progress& progress) -> Jobs::Finish {
                save_session(asPath(path), draft.finished(progress), progress);
                return [this, path, steps, mesh, state = stateOf(path)] {
                  know(path, state);
                  if (autosave_) {
                    autosave_->discardAdopted(mesh);
                  }
                  document_.files().setSession(QFileInfo(path).absoluteFilePath());
                  // Changes during saving are not in the file.
                  if (steps_ == steps) {
                    document_.undoStack().setClean();
                  }
                  emit this->saved(path);
                };
              });
}

void Sessions::know(const QString& path, const std::optional<FileState>& state) {
  files_.know(QFileInfo(path).absoluteFilePath(), state);
}

bool Sessions::isChangedOutside(const QString& path) const { return files_.isChanged(path); }

void Sessions::protect() {
  autosave_ = std::make_unique<Autosave>(document_, layout_, this);
  connect(autosave_.get(), &Autosave::failed, this, &Sessions::failed);
  connect(autosave_.get(), &Autosave::recovered, this, &Sessions::recovered);
  recovery_->offer();
}

QString Sessions::keep() {
  QString why = autosave_ ? autosave_->keep() : QString();
  if (why.isEmpty()) {
    recovery_->release();
    unsaved_work::discardOldest();
  }
  return why;
}

QString Sessions::setAside() {
  if (!autosave_ || !document_.isModified()) {
    return {};
  }
  QString why = autosave_->setAside();
  if (why.isEmpty()) {
    const auto say = [this] {
      emit noted(QStringLiteral("Your unsaved work is kept: Undo returns to it, and the next start offers it, too"));
    };
    QMetaObject::invokeMethod(this, say, Qt::QueuedConnection);  // another object removes older messages
  }
  return why;
}

void Sessions::close() {
  recovery_->release();
  autosave_.reset();
}

/// Restores unsaved work. From now on, this window saves it.
void Sessions::restore(const QString& path) {
  jobs_.start(Jobs::Kind::load, QStringLiteral("Restoring unsaved work"),
              [this, path](const Progress& progress) -> Jobs::Finish {
                const auto session = std::make_shared<const Session>(unsaved_work::read(path, progress.part(0, 0.9)));
                prepareLevels(session->mesh, progress.part(0.9, 1));
                return [this, session, path] {
                  edits::restore(document_, session, ownFile(*session), QStringLiteral("restore unsaved work"),
                                 edits::Opening::unsaved);
                  layout_.set(session->ui);
                  auto lock = recovery_->take(path);
                  if (autosave_) {
                    autosave_->adopt(path, std::move(lock), document_.unsplitMesh());
                  }
                };
              });
}

}  // namespace chainmail
