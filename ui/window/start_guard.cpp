#include "window/start_guard.h"

#include <unistd.h>

#include <QFile>
#include <QFileInfo>
#include <QSettings>
#include <QStandardPaths>
#include <algorithm>
#include <array>
#include <cerrno>
#include <csignal>
#include <utility>

namespace chainmail {
namespace {

constexpr qint64 largestFile = 4 << 20;  // bytes
constexpr int patience = 2;              // starts without a frame

const QString startsKey = QStringLiteral("unfinishedStarts");  // ids of their processes

struct OldSetting {
  const char* key;
  const char* name;
};
// Settings of earlier versions, which have no meaning any more. Those without a name go with another one.
constexpr std::array oldSettings{OldSetting{"layout", "the layout of the docks"},
                                 OldSetting{"geometry", nullptr},
                                 OldSetting{"folds", nullptr},
                                 OldSetting{"matcapShading", "matcap shading"},
                                 OldSetting{"shortcuts", "keys of your own"},
                                 OldSetting{"systemTheme", "the theme of the desktop"}};

bool isRunning(const QString& process) {
  const pid_t id = process.toInt();
  return id > 0 && id != ::getpid() && (::kill(id, 0) == 0 || errno == EPERM);
}

/// Returns the ids of other processes that start now.
QStringList runningStarts(QStringList starts) {
  starts.removeIf([](const QString& process) { return !isRunning(process); });
  return starts;
}

/// Returns true if a file holds values in the binary format of Qt, which our settings do not have: Qt trusts them.
bool holdsBinaryValues(const QString& path) {
  QFile file(path);
  const QByteArray text = file.open(QIODevice::ReadOnly) ? file.read(largestFile) : QByteArray();
  return text.contains("@Variant") || text.contains("@DateTime");
}

QString moveAside(const QString& path) {
  const QString aside = path + QStringLiteral(".old");
  QFile::remove(aside);
  return QFile::rename(path, aside) ? aside : QString();
}

}  // namespace

StartGuard::StartGuard() {
  const QString folder = QStandardPaths::writableLocation(QStandardPaths::GenericConfigLocation);
  for (const char* name : {"/ChainMail/workbench.ini", "/ChainMail.ini"}) {  // those that QSettings reads
    check(folder + QLatin1String(name));
  }
  dropOldSettings();
  countStarts();
}

StartGuard::~StartGuard() { succeed(); }

void StartGuard::check(const QString& path) {
  const QFileInfo file(path);
  if (!file.exists()) {
    return;
  }
  const bool isFile = file.isFile();
  if (isFile && file.size() <= largestFile && !holdsBinaryValues(path)) {
    return;
  }
  if (const QString aside = isFile ? moveAside(path) : QString(); !aside.isEmpty()) {
    notes_ << QStringLiteral("The settings are damaged, so the window has its defaults. The damaged file is now %1.")
                  .arg(aside);
    return;
  }
  spare_ = std::make_unique<QTemporaryDir>();
  QSettings::setPath(QSettings::IniFormat, QSettings::UserScope, spare_->path());
  notes_ << QStringLiteral("%1 cannot be read as settings. Remove it; until then, settings are not kept.").arg(path);
}

/// Says once what the settings lose.
void StartGuard::dropOldSettings() {
  QSettings settings;
  QStringList names;
  for (const OldSetting& old : oldSettings) {
    const QString key = QLatin1String(old.key);
    settings.beginGroup(key);
    const bool isGroup = !settings.allKeys().isEmpty();
    settings.endGroup();
    if ((settings.contains(key) || isGroup) && old.name != nullptr) {
      names << QLatin1String(old.name);
    }
    settings.remove(key);
  }
  if (!names.isEmpty()) {
    notes_ << QStringLiteral("The settings are of an earlier version. Left out: %1.")
                  .arg(names.join(QStringLiteral(", ")));
  }
}

void StartGuard::countStarts() {
  QSettings settings;
  const QStringList before = settings.value(startsKey).toStringList();
  QStringList now = runningStarts(before);
  if (before.size() - now.size() >= patience) {
    const QString aside = settings.fileName() + QStringLiteral(".old");
    QFile::remove(aside);
    QFile::copy(settings.fileName(), aside);
    settings.clear();
    notes_
        << QStringLiteral(
               "The last starts ended before the window was on the screen, so this one begins with default settings. "
               "The former settings are in %1.")
               .arg(aside);
  } else {
    now = before;
  }
  settings.setValue(startsKey, now << QString::number(::getpid()));
}

void StartGuard::succeed() {
  if (!std::exchange(isDone_, true)) {
    QSettings settings;
    const QStringList others = runningStarts(settings.value(startsKey).toStringList());
    others.isEmpty() ? settings.remove(startsKey) : settings.setValue(startsKey, others);
  }
}

}  // namespace chainmail
