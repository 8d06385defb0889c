// The workbench program: reads the arguments and opens the main window.

#include <QCommandLineParser>
#include <QOpenGLWidget>
#include <algorithm>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <initializer_list>
#include <string_view>

#include "common/application.h"
#include "common/as_path.h"
#include "docks/mesh_dock.h"
#include "files/text/temporary_folder.h"
#include "io/sessions.h"
#include "mesh/error.h"
#include "panels/panel.h"
#include "version/version.h"
#include "window/bars.h"
#include "window/help_menu.h"
#include "window/main_window.h"
#include "window/startup.h"

namespace {

int fail(const QString& sentence) {
  std::fprintf(stderr, "workbench: %s\n", qPrintable(sentence));
  return 2;
}

/// Returns true if there is a display. Without one, Qt would end the process without a helpful message.
bool has_display(int argc, char** argv) {
  const auto names_platform = [](const char* argument) { return std::string_view(argument) == "-platform"; };
  return !qEnvironmentVariableIsEmpty("DISPLAY") || !qEnvironmentVariableIsEmpty("WAYLAND_DISPLAY") ||
         !qEnvironmentVariableIsEmpty("QT_QPA_PLATFORM") || std::any_of(argv, argv + argc, names_platform);
}

/// Receives what Qt says while it connects to the display. If it cannot, it would end the process as after a crash.
void refuse_display(QtMsgType type, const QMessageLogContext& /*context*/, const QString& /*message*/) {
  if (type == QtFatalMsg) {
    const QString platform = qEnvironmentVariable("QT_QPA_PLATFORM");
    const QString display = qEnvironmentVariable("DISPLAY", qEnvironmentVariable("WAYLAND_DISPLAY"));
    std::_Exit(
        fail(QStringLiteral("no window can be opened on the display '%1'%2; start it in a desktop session, or use "
                            "the command line program chainmail")
                 .arg(display,
                      platform.isEmpty() ? QString() : QStringLiteral(" (QT_QPA_PLATFORM is '%1')").arg(platform))));
  }
}

/// Returns true if one of these options is among the arguments.
bool asks(int argc, char** argv, std::initializer_list<std::string_view> options) {
  return std::any_of(argv + 1, std::find(argv + 1, argv + argc, std::string_view("--")), [&](std::string_view one) {
    return std::find(options.begin(), options.end(), one) != options.end();
  });
}

/// Sets the options and the help text.
void describe(QCommandLineParser& parser) {
  parser.setApplicationDescription(
      QStringLiteral("Deforms soft objects with the ChainMail family of algorithms, two of them side by side.\n"
                     "Example: workbench meshes/sphere.obj"));
  parser.addHelpOption();
  parser.addVersionOption();
  parser.addPositionalArgument(QStringLiteral("FILE"),
                               QStringLiteral("a session (.chainmail), a mesh or a picture (.png, .jpg) to open"),
                               QStringLiteral("[FILE]"));
}

/// Reads the arguments, opens the window and runs until it is closed. Returns the exit status.
int run(int argc, char** argv) {
  QCommandLineParser parser;
  describe(parser);
  if (asks(argc, argv, {"--version", "-v"})) {
    std::printf("%s\n%s\n", chainmail::version_in_words("workbench").c_str(), qPrintable(chainmail::licenceInWords()));
    return 0;
  }
  if (asks(argc, argv, {"--help", "-h", "--help-all"})) {
    const QCoreApplication application(argc, argv);
    parser.process(application);
  }
  if (!has_display(argc, argv)) {
    return fail(
        QStringLiteral("there is no display; start it in a desktop session, or use the command line program "
                       "chainmail"));
  }
  chainmail::prepareApplication();
  qInstallMessageHandler(refuse_display);
  chainmail::Application application(argc, argv);
  qInstallMessageHandler(nullptr);
  QCoreApplication::setApplicationVersion(QStringLiteral(CHAINMAIL_VERSION));

  if (!parser.parse(QCoreApplication::arguments())) {
    return fail(parser.errorText().remove(QLatin1Char('.')) + QStringLiteral("; see workbench --help"));
  }
  if (parser.positionalArguments().size() > 1) {
    return fail(QStringLiteral("arguments: more than one file was given; use one file"));
  }
  if (const QString why = chainmail::whyNoWindow(); !why.isEmpty()) {
    return fail(why);
  }
  chainmail::StartGuard guard;
  chainmail::styleApplication();

  const auto sample = chainmail::sampleRecipe();
  chainmail::MainWindow window(chainmail::generate(sample), chainmail::recipeName(sample));
  QObject::connect(
      &window.panel(0).view(), &QOpenGLWidget::frameSwapped, &window, [&guard] { guard.succeed(); },
      Qt::SingleShotConnection);
  window.show();
  window.sessions().protect();
  chainmail::keepWorkAtTheEnd(window);
  const auto tell = [&window, &guard] {
    std::ranges::for_each(guard.notes(), [&window](const QString& note) { window.messages().note(note); });
  };
  tell();
  if (!parser.positionalArguments().isEmpty()) {
    // The messages end with the object that they belonged to; these are about the window.
    QObject::connect(&window.document(), &chainmail::Document::meshChanged, &window, tell, Qt::SingleShotConnection);
    const bool first = true;
    // Qt does not keep the bytes of a name that is not UTF-8.
    const QString name = parser.positionalArguments().constFirst();
    const auto is_name = [&](const char* one) { return QString::fromLocal8Bit(one) == name; };
    window.openFile(chainmail::pathOf(*std::find_if(argv + 1, argv + argc, is_name)), first);
  } else {
    window.welcome();
  }
  return QApplication::exec();
}

}  // namespace

int main(int argc, char** argv) {
  std::signal(SIGXFSZ, SIG_IGN);  // a write beyond the file size limit (ulimit -f) then fails like one on a full disk
  chainmail::remove_folders_on_signals();
  chainmail::prepareLastWords();
  try {
    return run(argc, argv);
  } catch (...) {  // before the window was open, or while it was closed
    std::fprintf(stderr, "workbench: %s\n", chainmail::failure_sentence("window").c_str());
    return 2;
  }
}
