#include "startup.h"

#include <QApplication>
#include <QIcon>
#include <QOpenGLContext>
#include <QPalette>
#include <QSettings>
#include <QStyleFactory>
#include <QSurfaceFormat>

// The shaders lie in a static library: they must be asked for, outside any namespace.
static void loadResources() { Q_INIT_RESOURCE(workbench); }

namespace chainmail {

void prepareApplication() {
  loadResources();
  // Without sharing, a view that is docked anew loses all that the graphics card holds.
  QCoreApplication::setAttribute(Qt::AA_ShareOpenGLContexts);
  QSurfaceFormat format;
  format.setVersion(3, 3);
  format.setProfile(QSurfaceFormat::CoreProfile);
  format.setOption(QSurfaceFormat::DeprecatedFunctions);  // lines wider than a pixel: marks, and colours with a meaning
  format.setDepthBufferSize(24);
  QSurfaceFormat::setDefaultFormat(format);
  QCoreApplication::setOrganizationName(QStringLiteral("ChainMail"));
  QCoreApplication::setApplicationName(QStringLiteral("workbench"));
  QSettings::setDefaultFormat(QSettings::IniFormat);
}

void styleApplication() {
  QGuiApplication::setDesktopFileName(QStringLiteral("org.chainmail.workbench"));
  QApplication::setWindowIcon(QIcon(QStringLiteral(":/org.chainmail.workbench.png")));
  QApplication::setStyle(QStyleFactory::create(QStringLiteral("Fusion")));
  QPalette palette;
  const QColor window(0x24, 0x29, 0x30), base(0x1b, 0x1f, 0x25), text(0xe4, 0xe7, 0xeb), faint(0x7d, 0x85, 0x90);
  palette.setColor(QPalette::Window, window);
  palette.setColor(QPalette::WindowText, text);
  palette.setColor(QPalette::Base, base);
  palette.setColor(QPalette::AlternateBase, window);
  palette.setColor(QPalette::ToolTipBase, base);
  palette.setColor(QPalette::ToolTipText, text);
  palette.setColor(QPalette::PlaceholderText, faint);
  palette.setColor(QPalette::Text, text);
  palette.setColor(QPalette::Button, QColor(0x30, 0x36, 0x3f));
  palette.setColor(QPalette::ButtonText, text);
  palette.setColor(QPalette::BrightText, Qt::white);
  palette.setColor(QPalette::Light, QColor(0x46, 0x4e, 0x59));
  palette.setColor(QPalette::Midlight, QColor(0x3a, 0x41, 0x4b));
  palette.setColor(QPalette::Mid, QColor(0x3a, 0x41, 0x4b));
  palette.setColor(QPalette::Dark, QColor(0x14, 0x17, 0x1c));
  palette.setColor(QPalette::Shadow, QColor(0x0c, 0x0e, 0x11));
  palette.setColor(QPalette::Highlight, QColor(0x2f, 0x7f, 0xb5));
  palette.setColor(QPalette::HighlightedText, Qt::white);
  palette.setColor(QPalette::Link, QColor(0x56, 0xb4, 0xe9));
  for (const auto role : {QPalette::WindowText, QPalette::Text, QPalette::ButtonText}) {
    palette.setColor(QPalette::Disabled, role, faint);
  }
  QApplication::setPalette(palette);
  // Fusion hardly tells a checked button from an unchecked one on a dark ground.
  qApp->setStyleSheet(
      QStringLiteral("QToolButton:checked { background: #2f7fb5; color: white; border: 1px solid "
                     "#3f93cb; border-radius: 3px; padding: 3px 6px; }"));
}

QString whyNoWindow() {
  const QString platform = QGuiApplication::platformName();
  // These crash at the first OpenGL widget.
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
