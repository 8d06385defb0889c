#include "window/startup.h"

#include <fcntl.h>
#include <unistd.h>

#include <QApplication>
#include <QFile>
#include <QFileInfo>
#include <QIcon>
#include <QLocale>
#include <QOpenGLContext>
#include <QPointer>
#include <QScreen>
#include <QSettings>
#include <QSocketNotifier>
#include <QStandardPaths>
#include <QSurfaceFormat>
#include <QThread>
#include <array>
#include <atomic>
#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <map>
#include <utility>

#include "common/theme.h"
#include "window/main_window.h"

// Resources of a static library must be initialised explicitly, outside any namespace.
static void loadResources() { Q_INIT_RESOURCE(workbench); }

namespace chainmail {
namespace {

constexpr int leastDepth = 24;  // bits per pixel

std::atomic<int> ending = -1;  // the pipe on which the handler of signals writes

/// Calls only functions that a handler of signals may call.
void receiveSignal(int signal) {
  const char byte = char(signal);
  static_cast<void>(::write(ending, &byte, 1) == 1);
}

/// Keeps the work and lets the signal do what it did before.
void endBy(int signal, const struct sigaction& before, MainWindow& window) {
  if (const QString why = window.keepWork(); !why.isEmpty()) {
    std::fprintf(stderr, "workbench: %s\n", qPrintable(why));
  }
  ::sigaction(signal, &before, nullptr);
  ::raise(signal);
}

/// True if the display is that of another computer, reached by ssh.
bool isRemote() {
  return qEnvironmentVariableIsSet("SSH_CONNECTION") && !qEnvironmentVariable("DISPLAY").startsWith(QLatin1Char(':'));
}

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

void prepareApplication() {
  loadResources();
  for (const char* name : {"XDG_CONFIG_HOME", "XDG_DATA_HOME", "XDG_CACHE_HOME", "XDG_RUNTIME_DIR"}) {
    if (!qgetenv(name).startsWith('/')) {  // the XDG specification ignores relative paths
      qunsetenv(name);
    }
  }
  // Without shared contexts, a view loses its OpenGL objects when it is docked again.
  QCoreApplication::setAttribute(Qt::AA_ShareOpenGLContexts);
  QSurfaceFormat format;
  format.setVersion(3, 3);
  format.setProfile(QSurfaceFormat::CoreProfile);
  format.setOption(QSurfaceFormat::DeprecatedFunctions);  // for lines wider than a pixel
  format.setDepthBufferSize(24);
  QSurfaceFormat::setDefaultFormat(format);
  QCoreApplication::setOrganizationName(QStringLiteral("ChainMail"));
  QCoreApplication::setApplicationName(QStringLiteral("workbench"));
  QSettings::setDefaultFormat(QSettings::IniFormat);
}

void keepWorkAtTheEnd(MainWindow& window) {
  static QPointer<MainWindow> open;  // a function at the exit has no arguments
  open = &window;
  // Qt and the graphics driver exit when the display is lost.
  std::atexit([] {
    if (open != nullptr && open->thread() == QThread::currentThread()) {
      open->keepWork();
    }
  });
  std::array<int, 2> pipe{};
  if (::pipe2(pipe.data(), O_CLOEXEC | O_NONBLOCK) != 0) {
    return;
  }
  ending = pipe[1];
  std::map<int, struct sigaction> before;
  for (const int signal : {SIGINT, SIGTERM, SIGHUP}) {
    struct sigaction present {};
    if (::sigaction(signal, nullptr, &present) == 0 && present.sa_handler != SIG_IGN) {  // not for nohup
      struct sigaction own {};
      own.sa_handler = receiveSignal;
      own.sa_flags = SA_RESTART;
      ::sigaction(signal, &own, &before[signal]);
    }
  }
  auto* notifier = new QSocketNotifier(pipe[0], QSocketNotifier::Read, &window);
  QObject::connect(notifier, &QSocketNotifier::activated, &window, [&window, before, from = pipe[0]] {
    char signal = 0;
    if (::read(from, &signal, 1) == 1) {
      endBy(signal, before.at(signal), window);
    }
  });
}

void styleApplication() {
  // The texts are English, and so are their numbers, on every system: plots and files have a decimal point, too.
  QLocale::setDefault(QLocale(QLocale::English, QLocale::UnitedStates));
  QGuiApplication::setDesktopFileName(QStringLiteral("org.chainmail.workbench"));
  QApplication::setWindowIcon(QIcon(QStringLiteral(":/org.chainmail.workbench.png")));
  QApplication::setStyle(new WorkbenchStyle);
  applyGround(rememberedGround());
}

QString whyNoWindow() {
  const QString platform = QGuiApplication::platformName();
  // These crash with the first OpenGL widget.
  for (const char* without : {"offscreen", "minimal", "linuxfb", "vnc"}) {
    if (platform == QLatin1String(without)) {
      return QStringLiteral(
                 "the platform '%1' has no OpenGL widgets; use xcb or wayland, or the command line "
                 "program chainmail")
          .arg(platform);
    }
  }
  const QScreen* screen = QGuiApplication::primaryScreen();
  if (screen != nullptr && screen->depth() < leastDepth) {
    return QStringLiteral(
               "the display has %1 bits per pixel, with which the panels would stay black; set it to 24 bits, or use "
               "the "
               "command line program chainmail")
        .arg(screen->depth());
  }
  QOpenGLContext context;
  if (!context.create() || context.format().version() < qMakePair(3, 3)) {
    return isRemote()
               ? QStringLiteral(
                     "OpenGL 3.3 is not available over ssh; set LIBGL_ALWAYS_SOFTWARE=1 to draw on this computer, "
                     "or use a remote desktop, or the command line program chainmail")
               : QStringLiteral(
                     "OpenGL 3.3 is not available; update the graphics driver, or use the command line program "
                     "chainmail");
  }
  return {};
}

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
