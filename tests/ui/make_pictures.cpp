// Makes the pictures of README.md for the target `pictures`.

#include "document/edits.h"
#include "io/file_actions.h"
#include "io/samples.h"
#include "window.h"

using namespace chainmail;

namespace {

constexpr QSize size{1600, 900};
constexpr ElementId width = 24;  // elements per row of the sample

/// The window with the sample 'cloth'.
struct Cloth : Workbench {
  Cloth() {
    window.resize(size);
    window.findChild<FileActions*>()->openSample(samplesFolder() + QStringLiteral("/cloth.obj"));
    settle();
    choose(0, "Generalized ChainMail");
    choose(1, "Natural Queue ChainMail");
  }

  /// Drags an element by `by`, in this number of passes.
  void drag(ElementId element, const Point& by, int passes) {
    const Point from = document().mesh()->rest_position(element);
    document().handle().grab(element);
    for (int i = 1; i <= passes; ++i) {
      document().handle().drag(from + by * i / passes);
      settle();
    }
    document().handle().release();
    settleFigures();
  }

  bool save(const QString& path) { return window.grab().save(path, nullptr, 0); }  // highest compression
};

/// Saves a picture of a drag that shows the violation of each link in colour.
bool saveViolation(const QString& path) {
  Cloth bench;
  edits::setPinned(bench.document(), {10 * width}, true);
  bench.trigger("colourBy-violation");
  bench.drag(8 * width + 19, Point(-2, 4, 0), 60);
  return bench.save(path);
}

/// Saves a picture of a pass that is not complete yet.
bool savePropagation(const QString& path) {
  constexpr int back = 150;
  Cloth bench;
  for (const char* hidden : {"showStiffnessDock", "showRelaxationDock", "showFrameRateDock"}) {
    bench.trigger(hidden);
  }
  bench.trigger("showPropagation");
  bench.drag(8 * width + 12, Point(4, 3, 0), 1);
  for (int i = 0; i < back; ++i) {
    bench.trigger("passBack");
  }
  bench.settleFigures();
  return bench.save(path);
}

}  // namespace

/// Takes the path of the resources folder.
int main(int argc, char** argv) {
  prepareApplication();
  const QTemporaryDir settings;
  QSettings::setPath(QSettings::IniFormat, QSettings::UserScope, settings.path());
  qputenv("XDG_DATA_HOME", settings.path().toUtf8());  // so that the user's files are not used
  QApplication application(argc, argv);
  styleApplication();
  const QString folder = QString::fromLocal8Bit(argv[1]);
  return saveViolation(folder + QStringLiteral("/screenshot.png")) &&
                 savePropagation(folder + QStringLiteral("/propagation.png"))
             ? 0
             : 1;
}
