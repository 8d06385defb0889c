// Tests the gallery of samples in a real window.

#include <QPushButton>
#include <QToolButton>

#include "io/samples.h"
#include "window.h"
#include "window/bars.h"

namespace chainmail::window_gallery {

class WindowGallery : public QObject {
  Q_OBJECT

  /// Opens the popover and returns the button of a sample.
  static QToolButton* open(Workbench& bench, const char* file) {
    bench.find<QPushButton>("openSamples")->click();
    return bench.find<QToolButton>(qPrintable(QStringLiteral("sample %1").arg(QLatin1String(file))));
  }

 private slots:
  void init() { failOnWarnings(); }

  void aClickOpensASampleAsOneStep_data() {
    QTest::addColumn<int>("which");
    for (std::size_t i = 0; i < samples().size(); ++i) {
      QTest::newRow(samples()[i].file) << int(i);
    }
  }
  void aClickOpensASampleAsOneStep() {
    QFETCH(int, which);
    const Sample& sample = samples()[std::size_t(which)];
    Workbench bench;
    const MeshPointer before = bench.document().mesh();
    auto* button = open(bench, sample.file);
    QVERIFY(button != nullptr && button->isVisible());
    button->click();
    QVERIFY(!button->isVisible());  // the popover has closed
    bench.settle();
    QVERIFY2(!bench.window.messages().isVisible(), qPrintable(bench.window.messages().sentence()));
    QCOMPARE(bench.document().mesh()->element_count(), sample.elements);  // the number in its tool tip
    QVERIFY(bench.document().files().session().isEmpty());                // a sample must not be overwritten
    QCOMPARE(bench.document().undoStack().undoText(), QStringLiteral("open ") + QString::fromUtf8(sample.file));
    bench.trigger("undo");
    bench.settle();
    QCOMPARE(bench.document().mesh(), before);
  }
};

CHAINMAIL_WINDOW_TEST(WindowGallery)

}  // namespace chainmail::window_gallery

#include "window_gallery.moc"
