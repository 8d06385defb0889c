#include "window/about_dialog.h"

#include <QClipboard>
#include <QDialogButtonBox>
#include <QGuiApplication>
#include <QOffscreenSurface>
#include <QOpenGLContext>
#include <QOpenGLFunctions>
#include <QPlainTextEdit>
#include <QPushButton>
#include <QSysInfo>
#include <QVBoxLayout>

namespace chainmail {
namespace {

constexpr QSize aboutSize(640, 320);

/// Asks a context of its own: those of the views belong to them.
QString openGl() {
  QOpenGLContext context;
  QOffscreenSurface surface;
  surface.create();
  if (!context.create() || !context.makeCurrent(&surface)) {
    return QStringLiteral("OpenGL: not available");
  }
  const auto word = [&context](GLenum name) {
    return QString::fromLatin1(reinterpret_cast<const char*>(context.functions()->glGetString(name)));
  };
  QString text =
      QStringLiteral("OpenGL: %1\nRenderer: %2, %3").arg(word(GL_VERSION), word(GL_RENDERER), word(GL_VENDOR));
  context.doneCurrent();
  return text;
}

QString aboutText() {
  return QStringLiteral("ChainMail workbench %1\n\n%2\n\nQt: %3 (built with %4), platform %5\n%6\nSystem: %7, %8\n")
      .arg(QCoreApplication::applicationVersion(), licenceInWords(), QLatin1String(qVersion()),
           QLatin1String(QT_VERSION_STR), QGuiApplication::platformName(), openGl(), QSysInfo::prettyProductName(),
           QSysInfo::currentCpuArchitecture());
}

}  // namespace

QString licenceInWords() {
  return QStringLiteral(
      "MIT licence. Linked libraries: Qt 6 (LGPL-3), Eigen (MPL-2.0), zlib and "
      "nlohmann/json (MIT).\n"
      "It starts chainmail-import, which is under the GPL, as a separate program.");
}

AboutDialog::AboutDialog(QWidget* parent) : QDialog(parent) {
  setObjectName(QStringLiteral("aboutDialog"));
  setWindowTitle(QStringLiteral("About ChainMail workbench"));
  resize(aboutSize);
  auto* text = new QPlainTextEdit(aboutText());
  text->setObjectName(QStringLiteral("aboutText"));
  text->setAccessibleName(QStringLiteral("Version, licences, Qt and OpenGL"));
  text->setReadOnly(true);
  text->setTextInteractionFlags(Qt::TextSelectableByMouse | Qt::TextSelectableByKeyboard);
  auto* buttons = new QDialogButtonBox(QDialogButtonBox::Close);
  auto* copy = buttons->addButton(QStringLiteral("Co&py"), QDialogButtonBox::ActionRole);
  copy->setObjectName(QStringLiteral("aboutCopy"));
  copy->setToolTip(QStringLiteral("Copies the whole text"));
  connect(copy, &QPushButton::clicked, text, [text] { QGuiApplication::clipboard()->setText(text->toPlainText()); });
  connect(buttons, &QDialogButtonBox::rejected, this, &QDialog::close);
  auto* column = new QVBoxLayout(this);
  column->addWidget(text);
  column->addWidget(buttons);
}

}  // namespace chainmail
