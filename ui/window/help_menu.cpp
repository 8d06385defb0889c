#include "window/help_menu.h"

#include <QClipboard>
#include <QCoreApplication>
#include <QDialogButtonBox>
#include <QEvent>
#include <QGuiApplication>
#include <QMainWindow>
#include <QOffscreenSurface>
#include <QOpenGLContext>
#include <QOpenGLFunctions>
#include <QPlainTextEdit>
#include <QPushButton>
#include <QSettings>
#include <QSysInfo>
#include <QVBoxLayout>
#include <algorithm>
#include <cmath>

#include "common/actions.h"

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

constexpr int moveMilliseconds = 16;  // between two moves
constexpr double longest = 40;        // seconds until the example stops without user input
constexpr double swing = 5.2;         // seconds per period, horizontal
constexpr double rise = 3.4;          // seconds per period, vertical
constexpr double beginning = 2;       // seconds until the full amplitude
constexpr double reachInLinks = 3.5;  // horizontal amplitude in mean link lengths; the vertical one is 0.6 of it

bool isTouch(const QEvent& event) {
  switch (event.type()) {
    case QEvent::MouseButtonPress:
    case QEvent::Wheel:
    case QEvent::TouchBegin:
    case QEvent::KeyPress:
    case QEvent::ShortcutOverride:  // comes before the action of a key
    case QEvent::DragEnter:
    case QEvent::Close:
      return true;
    default:
      return false;
  }
}

constexpr int exampleDelay = 300;  // milliseconds
const QString welcomedKey = QStringLiteral("hintsSeen");

/// Shows a window in front, which is made on first use.
template <class Window>
void present(Window*& window, QMainWindow& parent) {
  if (window == nullptr) {
    window = new Window(&parent);
  }
  window->show();
  window->raise();
  window->activateWindow();
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

ExampleDrag::ExampleDrag(Document& document, QObject* parent) : QObject(parent), document_(document) {
  clock_.setTimerType(Qt::PreciseTimer);
  clock_.setInterval(moveMilliseconds);
  connect(&clock_, &QTimer::timeout, this, &ExampleDrag::move);
}

ExampleDrag::~ExampleDrag() { QCoreApplication::instance()->removeEventFilter(this); }

void ExampleDrag::start() {
  if (running() || document_.undoStack().count() != 0 || document_.highlight().marks().grabbed) {
    return;
  }
  const Mesh& mesh = *document_.mesh();
  element_ = mesh.element_count() * 4 / 5;  // away from the centre, so that near and far elements move differently
  from_ = mesh.rest_position(element_);
  reach_ = reachInLinks * mesh.mean_link_length;
  QCoreApplication::instance()->installEventFilter(this);
  document_.handle().grab(element_);
  since_.start();
  clock_.start();
}

void ExampleDrag::move() {
  const double seconds = double(since_.elapsed()) / 1000;
  if (seconds > longest) {
    stop();
    return;
  }
  const double share = reach_ * std::min(1.0, seconds / beginning);
  document_.highlight().set({element_, true, {}});
  document_.handle().drag(from_ + Point(share * std::sin(2 * M_PI * seconds / swing),
                                        share * 0.6 * std::sin(2 * M_PI * seconds / rise), 0));
}

void ExampleDrag::stop() {
  if (!running()) {
    return;
  }
  clock_.stop();
  QCoreApplication::instance()->removeEventFilter(this);
  document_.handle().release();
  document_.undo();
  document_.undoStack().clear();
  document_.moves().forget();
  document_.highlight().set({});
}

bool ExampleDrag::eventFilter(QObject* /*watched*/, QEvent* event) {
  if (isTouch(*event)) {
    stop();
  }
  return false;
}

HelpMenu::HelpMenu(QMainWindow& window, Document& document)
    : QObject(&window), window_(window), example_(document, nullptr) {}

void HelpMenu::fill(Actions& actions) {
  actions.add("Help", {{"showManual", "&Manual", "help", "Ctrl+F1",
                        "Opens the manual: a tour, the algorithms, results, files and the command line",
                        [this] { present(manual_, window_); }},
                       {"showShortcuts", "&Keys", "keyboard", QKeySequence::HelpContents,
                        "Lists all keys on one page, by task", [this] { present(keys_, window_); }},
                       {},
                       {"showAbout", "&About ChainMail workbench", "", "",
                        "Shows version, licences, Qt and OpenGL as text that can be copied",
                        [this] { present(about_, window_); }}});
}

bool HelpMenu::welcome() {
  QSettings settings;
  if (settings.value(welcomedKey).toBool()) {
    return false;
  }
  settings.setValue(welcomedKey, true);
  // The views fit the object when the legends have their places, but not during a drag.
  QTimer::singleShot(exampleDelay, &example_, &ExampleDrag::start);
  return true;
}

}  // namespace chainmail
