// Tests the gallery of samples in a real window.

#include <QApplication>
#include <QLabel>
#include <QPushButton>
#include <QScreen>
#include <QToolButton>

#include "docks/gallery.h"
#include "io/samples.h"
#include "window.h"
#include "window/message_bar.h"

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

  void thumbnailsFollowTheTheme() {
    Workbench bench;
    const auto* button = open(bench, "sphere.obj");
    const auto picture = [button] { return button->icon().pixmap(button->iconSize(), 2).toImage(); };
    const QImage dark = picture();
    applyGround(colours::Ground::light);
    QTRY_VERIFY(picture() != dark);
    applyGround(colours::Ground::dark);
    QTRY_COMPARE(picture(), dark);
  }

  void eachHasAThumbnailATitleAndATooltip() {
    Workbench bench;
    open(bench, "sphere.obj");
    const auto buttons = bench.window.findChild<Gallery*>()->findChildren<QToolButton*>();
    QCOMPARE(std::size_t(buttons.size()), samples().size());
    for (const QToolButton* button : buttons) {
      QVERIFY(!button->toolTip().isEmpty() && !button->accessibleName().isEmpty());
      const QImage picture = button->icon().pixmap(button->iconSize(), 2).toImage();
      bool drawn = false;
      for (int y = 0; y < picture.height() && !drawn; ++y) {
        for (int x = 0; x < picture.width() && !drawn; ++x) {
          drawn = picture.pixelColor(x, y).alpha() > 64;
        }
      }
      QVERIFY2(drawn, qPrintable(button->text()));
      QVERIFY2(button->fontMetrics().horizontalAdvance(button->text()) <= button->width() - 4,
               qPrintable(button->text()));
    }
  }

  void theKeyboardOpensASampleAndEscapeClosesTheGallery() {
    Workbench bench;
    const auto* first = open(bench, samples().front().file);
    QTRY_VERIFY(first->hasFocus());
    QTest::keyClick(bench.window.findChild<Gallery*>(), Qt::Key_Escape);
    QVERIFY(!first->isVisible());
    open(bench, samples().front().file);
    QTest::keyClick(QApplication::focusWidget(), Qt::Key_Space);
    bench.settle();
    QCOMPARE(bench.document().mesh()->element_count(), samples().front().elements);
  }

  void theGalleryFitsOnTheScreen() {
    Workbench bench;
    open(bench, samples().front().file);
    const auto* gallery = bench.window.findChild<Gallery*>();
    QVERIFY(gallery->screen()->availableGeometry().contains(gallery->frameGeometry()));
  }

  void withoutSamplesItSaysSo() {
    QPushButton button;
    button.show();
    Gallery gallery{QString()};
    gallery.openBelow(button);
    QTRY_VERIFY(gallery.findChild<QLabel*>(QStringLiteral("noSamples")) != nullptr);
    QVERIFY(gallery.findChildren<QToolButton*>().isEmpty());
  }
};

CHAINMAIL_WINDOW_TEST(WindowGallery)

}  // namespace chainmail::window_gallery

#include "window_gallery.moc"
