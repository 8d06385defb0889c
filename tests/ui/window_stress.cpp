// Anything a hand may do in a real window, in a random order, as fast as it goes: for the address sanitizer first of
// all.

#include <QPushButton>
#include <QSpinBox>
#include <QWheelEvent>
#include <cmath>
#include <random>

#include "file_actions.h"
#include "window.h"

using namespace chainmail;

namespace {

/// A hand that knows every control and no restraint. The same seed does the same.
class AnyHand {
 public:
  AnyHand(Workbench& bench, const QString& folder, unsigned seed) : bench_(bench), folder_(folder), random_(seed) {
    bench_.window.resize(640, 400);  // less to paint: the hand gets more done
  }

  void act() {
    switch (below(14)) {
      case 0:
        return chooseTool();
      case 1:
        return changeSoftness();
      case 2:
        return bench_.document().setAlgorithm(int(below(2)), algorithms()[below(algorithms().size())].algorithm);
      case 3:
        return bench_.document().setRelaxation(
            {below(2) == 0, 0.7, below(2) == 0 ? RelaxationScheme::mean : RelaxationScheme::link});
      case 4:
        return swapMesh();
      case 5:
        return goBackAndForth();
      case 6:
        return trigger();
      case 7:
        return look();
      default:
        return stroke();
    }
  }

  std::size_t below(std::size_t n) { return random_() % n; }

 private:
  QPointF anywhere() { return {double(below(view_->width())), double(below(view_->height()))}; }

  void send(QEvent::Type type, QPointF place, Qt::KeyboardModifiers modifiers) {
    const bool move = type == QEvent::MouseMove;
    QMouseEvent event(type, place, view_->mapToGlobal(place), move ? Qt::NoButton : Qt::LeftButton,
                      type == QEvent::MouseButtonRelease ? Qt::NoButton : Qt::LeftButton, modifiers);
    QApplication::sendEvent(view_, &event);
  }

  /// From an element to anywhere; now and then given up, undone in its middle, or never released.
  void stroke() {
    view_ = &bench_.view(int(below(2)));
    const QPointF start = view_->placeOf(ElementId(below(bench_.document().mesh()->element_count())));
    const auto modifiers = below(4) == 0 ? Qt::ShiftModifier : Qt::NoModifier;
    send(QEvent::MouseButtonPress, start, modifiers);
    for (std::size_t i = below(6); i > 0; --i) {
      send(QEvent::MouseMove, anywhere(), modifiers);
      if (below(25) == 0) {
        QTest::keyClick(&bench_.window, Qt::Key_Escape);
      } else if (below(25) == 0) {
        goBackAndForth();
      }
    }
    if (below(12) != 0) {
      send(QEvent::MouseButtonRelease, anywhere(), modifiers);
    }
  }

  void chooseTool() {
    static constexpr std::array tools{"toolDrag", "toolCut", "toolPin", "toolSelect", "toolDrag"};
    bench_.trigger(tools[below(tools.size())]);
  }

  void changeSoftness() {
    const LinkSoftness softness{double(below(100)) / 100, 1 + double(below(100)) / 50, double(below(100)) / 100};
    if (below(2) == 0) {
      bench_.document().setSoftness(softness, QStringLiteral("stiffness"), int(below(3)));
    } else {
      const auto links = bench_.document().selection().links;
      bench_.document().setSoftnessOf(links, below(3) == 0 ? std::nullopt : std::optional(softness));
    }
  }

  /// Builds, opens, saves, or gives up what is being built.
  void swapMesh() {
    const QString path = folder_ + (below(2) == 0 ? QStringLiteral("/any.obj") : QStringLiteral("/any.dat"));
    switch (below(5)) {
      case 0:
        return bench_.window.openFile(path);  // it may not be there yet
      case 1:
        return bench_.window.findChild<FileActions*>()->savePath(path);
      case 2:
        return bench_.window.jobs().cancel();
      default:
        bench_.find<QComboBox>("meshKind")->setCurrentIndex(int(below(mesh_kinds().size())));
        for (const char* size : {"sizeW", "sizeH", "sizeD"}) {
          bench_.find<QSpinBox>(size)->setValue(2 + int(below(12)));
        }
        bench_.find<QPushButton>("buildMesh")->click();
    }
  }

  void goBackAndForth() {
    for (std::size_t i = below(4); i > 0; --i) {
      below(3) == 0 ? bench_.document().undoStack().redo() : bench_.document().undoStack().undo();
    }
  }

  void trigger() {
    static constexpr std::array actions{"resetObject", "resetStiffness", "unpinAll", "fitView", "linkCameras"};
    bench_.trigger(actions[below(actions.size())]);
  }

  void look() {
    View& view = bench_.view(int(below(2)));
    const QPointF at(view.rect().center());
    QWheelEvent wheel(at, view.mapToGlobal(at), {}, {0, below(2) == 0 ? 120 : -120}, Qt::NoButton, Qt::NoModifier,
                      Qt::NoScrollPhase, false);
    QApplication::sendEvent(&view, &wheel);
    bench_.window.colouring().setMode(ColourMode(below(6)));
    QTest::qWait(5);
  }

  Workbench& bench_;
  QString folder_;
  std::mt19937_64 random_;
  View* view_ = nullptr;
};

}  // namespace

class WindowStress : public QObject {
  Q_OBJECT

 private slots:
  void init() { failOnWarnings(); }

  void anythingInAnyOrder_data() {
    QTest::addColumn<unsigned>("seed");
    for (unsigned seed = 1; seed <= 2; ++seed) {
      QTest::addRow("%u", seed) << seed;
    }
  }
  void anythingInAnyOrder() {
    QFETCH(unsigned, seed);
    QTemporaryDir folder;
    Workbench bench;
    AnyHand hand(bench, folder.path(), seed);
    for (int i = 0; i < 120; ++i) {
      hand.act();
      if (i % 3 == 0) {
        QCoreApplication::processEvents();
      }
    }
    bench.document().setRelaxation({});
    bench.trigger("toolDrag");  // lets go
    bench.settle();
    for (int panel = 0; panel < bench.document().panels(); ++panel) {
      const Frame& frame = *bench.document().frame(panel);
      QCOMPARE(frame.mesh, bench.document().mesh());
      QCOMPARE(frame.positions.size(), frame.mesh->rest.size());
      QVERIFY(std::all_of(frame.positions.begin(), frame.positions.end(), [](float x) { return std::isfinite(x); }));
    }
  }

  void closedAtAnyMoment_data() { anythingInAnyOrder_data(); }
  void closedAtAnyMoment() {
    QFETCH(unsigned, seed);
    QTemporaryDir folder;
    Workbench bench;
    AnyHand hand(bench, folder.path(), seed + 100);
    for (std::size_t i = 10 + hand.below(40); i > 0; --i) {
      hand.act();
    }
  }
};

int main(int argc, char** argv) { return runWindowTest<WindowStress>(argc, argv); }
#include "window_stress.moc"
