#include "window/startup.h"

#include <sys/mman.h>

#include <QApplication>
#include <QIcon>
#include <QLocale>
#include <QOpenGLContext>
#include <QScreen>
#include <QSettings>
#include <QSurfaceFormat>

#include "common/theme.h"
#include "common/workbench_style.h"

// Resources of a static library must be initialised explicitly, outside any namespace.
static void loadResources() { Q_INIT_RESOURCE(workbench); }

namespace chainmail {
namespace {

// Address space that the window takes with a small object. OpenGL without a graphics card takes most of it.
constexpr std::size_t windowBytes = std::size_t{1024} * 1024 * 1024;

constexpr int leastDepth = 24;  // bits per pixel

/// True if the display is that of another computer, reached by ssh.
bool isRemote() {
  return qEnvironmentVariableIsSet("SSH_CONNECTION") && !qEnvironmentVariable("DISPLAY").startsWith(QLatin1Char(':'));
}

}  // namespace

void prepareApplication() {
  loadResources();
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

void styleApplication() {
  // The texts are English, and so are their numbers, on every system: plots and files have a decimal point, too.
  QLocale::setDefault(QLocale(QLocale::English, QLocale::UnitedStates));
  QGuiApplication::setDesktopFileName(QStringLiteral("org.chainmail.workbench"));
  QApplication::setWindowIcon(QIcon(QStringLiteral(":/org.chainmail.workbench.png")));
  QApplication::setStyle(new WorkbenchStyle);
  applyGround(rememberedGround());
}

QString whyNoMemory() {
  // Takes no memory of the machine: such pages cannot be used.
  void* space = ::mmap(nullptr, windowBytes, PROT_NONE, MAP_PRIVATE | MAP_ANONYMOUS | MAP_NORESERVE, -1, 0);
  if (space == MAP_FAILED) {
    return QStringLiteral(
        "memory: the window needs 1 GB of address space; raise the limit (ulimit -v), or use the command line program "
        "chainmail");
  }
  ::munmap(space, windowBytes);
  return {};
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

}  // namespace chainmail
