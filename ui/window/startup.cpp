#include "window/startup.h"

#include <QApplication>
#include <QIcon>
#include <QOpenGLContext>
#include <QSettings>
#include <QSurfaceFormat>

#include "common/theme.h"
#include "common/workbench_style.h"

// Resources of a static library must be initialised explicitly, outside any namespace.
static void loadResources() { Q_INIT_RESOURCE(workbench); }

namespace chainmail {

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
  QOpenGLContext context;
  if (!context.create() || context.format().version() < qMakePair(3, 3)) {
    return QStringLiteral(
        "OpenGL 3.3 is not available; update the graphics driver, or use the command line program "
        "chainmail");
  }
  return {};
}

}  // namespace chainmail
