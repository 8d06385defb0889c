// Tests pictures of the window and its parts, copied and saved, in a real window.

#include <QCheckBox>
#include <QClipboard>
#include <QComboBox>
#include <QDoubleSpinBox>
#include <QLabel>
#include <QPainter>
#include <QSpinBox>
#include <QSvgRenderer>

#include "common/colours.h"
#include "document/edits.h"
#include "io/picture_actions.h"
#include "io/picture_size.h"
#include "io/pictures.h"
#include "window.h"
#include "window/message_bar.h"

namespace chainmail::window_pictures {

namespace {

QImage plain(const QImage& image) {
  QImage same = image.convertToFormat(QImage::Format_RGB32);
  same.setDevicePixelRatio(1);
  return same;
}

/// Returns the share of the pixels in which two pictures differ by more than rounding.
double difference(const QImage& one, const QImage& other) {
  constexpr int rounded = 40;
  int different = 0;
  for (int y = 0; y < one.height(); ++y) {
    for (int x = 0; x < one.width(); ++x) {
      const QRgb a = one.pixel(x, y), b = other.pixel(x, y);
      different += std::abs(qRed(a) - qRed(b)) > rounded || std::abs(qGreen(a) - qGreen(b)) > rounded ||
                   std::abs(qBlue(a) - qBlue(b)) > rounded;
    }
  }
  return double(different) / (double(one.width()) * one.height());
}

/// Returns the share of a picture that is not ground.
double drawn(const QImage& picture, QRgb ground) {
  QImage empty(picture.size(), QImage::Format_RGB32);
  empty.fill(ground);
  return difference(picture, empty);
}

PictureActions& pictures(Workbench& bench) { return *bench.window.findChild<PictureActions*>(); }

}  // namespace

class WindowPictures : public QObject {
  Q_OBJECT

 private slots:
  void init() {
    failOnWarnings();
    QSettings().clear();
  }

  void atItsOwnScaleAPictureIsTheScreen() {
    Workbench bench;
    bench.dragFar();
    bench.trigger("colourBy-violation");
    bench.trigger("ghosts");
    bench.settleFigures();
    QCOMPARE(plain(pictureOf(bench.view(0))), plain(bench.view(0).grabFramebuffer()));
    QCOMPARE(plain(pictureOf(bench.window)), plain(bench.window.grab().toImage()));
  }

  void largerOnesShowTheSameFiner() {
    Workbench bench;
    bench.dragFar();
    const QImage one = plain(pictureOf(bench.window)), two = plain(pictureOf(bench.window, 2));
    QCOMPARE(two.size(), 2 * one.size());
    // Thin lines fall differently between pixels. Objects at other positions would differ at least twice as much.
    const QImage again = two.scaled(one.size(), Qt::IgnoreAspectRatio, Qt::SmoothTransformation);
    QVERIFY2(difference(one, again) < 0.03, qPrintable(QString::number(difference(one, again))));
    // It is drawn again: in an enlarged picture, pixels would come in equal pairs.
    const QRect view(bench.view(0).mapTo(&bench.window, QPoint()) * 2, bench.view(0).size() * 2);
    const QImage enlarged = one.scaled(two.size(), Qt::IgnoreAspectRatio, Qt::FastTransformation);
    QVERIFY(difference(two.copy(view), enlarged.copy(view)) > 0.005);
  }

  void aTransparentOneIsTheObjectAlone() {
    Workbench bench(generate({MeshKind::tetra, {4, 3, 3}, 1, {}}));
    const QImage opaque = pictureOf(bench.view(0)), clear = pictureOf(bench.view(0), 1, true);
    QVERIFY(clear.hasAlphaChannel());
    QCOMPARE(qAlpha(clear.pixel(2, 2)), 0);
    QImage laidOver(opaque.size(), QImage::Format_RGB32);
    laidOver.fill(QColor(colours::background));
    QPainter(&laidOver).drawImage(QRect(QPoint(), laidOver.size()), clear);
    QVERIFY(drawn(plain(opaque), QColor(colours::background).rgb()) > 0.02);
    // Depth is blended with the ground, or shows the ground below: both are the same, up to rounding.
    QVERIFY2(difference(laidOver, plain(opaque)) < 0.002,
             qPrintable(QString::number(difference(laidOver, plain(opaque)))));
  }

  void whatIsChosenIsSavedAndCopied() {
    Workbench bench;
    const QString path = folder_.filePath(QStringLiteral("object.png"));
    bench.trigger("pictureOfObjectB");
    bench.trigger("pictureScale4");
    pictures(bench).savePath(path);
    bench.settle();
    QCOMPARE(QImage(path).size(), bench.view(1).size() * 4 * bench.window.devicePixelRatioF());
    bench.trigger("pictureScale1");
    bench.trigger("copyPicture");
    QCOMPARE(plain(QGuiApplication::clipboard()->image()), plain(bench.view(1).grabFramebuffer()));
    bench.trigger("addPanel");
    bench.trigger("pictureOfPanelC");
    bench.trigger("removePanel");
    bench.settle();
    QVERIFY(bench.find<QAction>("pictureOfWindow")->isChecked());  // panel C does not exist any more
    QVERIFY(!bench.find<QAction>("pictureOfObjectC")->isVisible());
  }

  void ofAPanelOutOfSightThereIsNone() {
    Workbench bench;
    bench.trigger("pictureOfPanelB");
    bench.trigger("showAloneA");
    bench.settle();
    for (const char* name : {"hidden.png", "hidden.svg"}) {
      const QString path = folder_.filePath(QLatin1String(name));
      pictures(bench).savePath(path);
      bench.settle();
      QVERIFY(!QFile::exists(path));
      QVERIFY(bench.window.messages().sentence().contains(QStringLiteral("panel B is hidden")));
      bench.window.messages().clear();
    }
  }

  void choicesAreRemembered() {
    {
      Workbench bench;
      bench.trigger("pictureOfPanels");
      bench.trigger("pictureScale2");
      bench.trigger("pictureTransparent");
    }
    Workbench bench;
    QVERIFY(bench.find<QAction>("pictureOfPanels")->isChecked());
    QVERIFY(bench.find<QAction>("pictureScale2")->isChecked());
    QVERIFY(bench.find<QAction>("pictureTransparent")->isChecked());
  }

  void aPlaceThatCannotBeWrittenGetsASentence() {
    Workbench bench;
    for (const char* name : {"no/such/folder/x.png", "no/such/folder/x.svg", "no/such/folder/x.pdf"}) {
      const QString nowhere = folder_.filePath(QLatin1String(name));
      pictures(bench).savePath(nowhere);
      bench.settle();
      QVERIFY(bench.window.messages().isVisible());
      QVERIFY(bench.window.messages().sentence().contains(nowhere));
      bench.window.messages().clear();
    }
  }

  void aDrawingHoldsLinesThatStandWhereTheScreenHasThem_data() {
    QTest::addColumn<int>("kind");
    QTest::newRow("plane") << int(MeshKind::grid);
    QTest::newRow("in space") << int(MeshKind::tetra);
  }
  void aDrawingHoldsLinesThatStandWhereTheScreenHasThem() {
    QFETCH(int, kind);
    Workbench bench(generate({MeshKind(kind), {5, 4, MeshKind(kind) == MeshKind::tetra ? 3U : 1U}, 1, {}}));
    applyGround(colours::Ground::light);
    edits::setPinned(bench.document(), {3}, true);
    bench.settle();
    edits::cut(bench.document(), {0});
    bench.settle();
    const QString path = folder_.filePath(QStringLiteral("object.svg"));
    bench.trigger("pictureOfObjectA");
    pictures(bench).savePath(path);
    bench.settle();
    QSvgRenderer svg(path);
    QVERIFY(svg.isValid());
    QCOMPARE(svg.viewBox().size(), bench.view(0).size());
    QImage again(bench.view(0).size(), QImage::Format_RGB32);
    again.fill(Qt::white);
    QPainter painter(&again);
    svg.render(&painter);
    painter.end();
    const QImage screen = plain(bench.view(0).grabFramebuffer());
    const double ofScreen = drawn(screen, QColor(colours::background).rgb());
    const double apart = difference(screen, again);
    applyGround(colours::Ground::dark);
    QVERIFY(ofScreen > 0.005);
    // Only the smoothing of edges differs. If lines were elsewhere, the difference would be as large as the drawn
    // share.
    QVERIFY2(apart < ofScreen / 2, qPrintable(QStringLiteral("%1 of %2").arg(apart).arg(ofScreen)));
  }

  void drawingsEndWhereTheViewsEnd() {
    Workbench bench(generate({MeshKind::cloth, {6, 6, 1}, 1, {}}));
    bench.view(0).zoom(3);
    bench.trigger("pictureOfObjectA");
    const QString path = folder_.filePath(QStringLiteral("part.svg"));
    pictures(bench).savePath(path);
    bench.settle();
    QSvgRenderer svg(path);
    QVERIFY(svg.isValid());
    // A margin for half the width of a line and for the rounding of SVG numbers.
    const QRectF view = QRectF(bench.view(0).rect()).adjusted(-1, -1, 1, 1);
    QImage wider(bench.view(0).size() + QSize(200, 200), QImage::Format_RGB32);
    wider.fill(Qt::white);
    QPainter painter(&wider);
    svg.setViewBox(bench.view(0).rect().adjusted(-100, -100, 100, 100));
    svg.render(&painter);
    painter.fillRect(view.translated(100, 100), Qt::white);
    painter.end();
    QImage empty(wider.size(), QImage::Format_RGB32);
    empty.fill(Qt::white);
    QCOMPARE(wider, empty);
  }

  /// On white, in the colours of the light theme, and without the boxes and buttons of the heads.
  void aPictureOfThePanelsIsAFigure() {
    Workbench bench;
    bench.dragFar();
    bench.trigger("colourBy-violation");
    bench.settleFigures();
    bench.trigger("pictureOfPanels");
    const QString path = folder_.filePath(QStringLiteral("figure.png"));
    pictures(bench).savePath(path);
    bench.settle();
    const QImage figure = plain(QImage(path));
    auto& area = bench.window.area();
    QCOMPARE(figure.size(), area.size() * bench.window.devicePixelRatioF());
    auto& panel = bench.window.panel(0);
    const auto within = [&](const QWidget& part) { return QRect(part.mapTo(&area, QPoint()), part.size()); };
    const auto lit = [&](const QRect& part) { return drawn(figure.copy(part), QColor(Qt::white).rgb()); };
    const QRect head = within(panel.head());
    QVERIFY(lit(within(bench.view(0))) > 0.005);  // the object
    QVERIFY(lit(within(panel.legend())) > 0.005);
    QVERIFY(lit(head) > 0.005);
    QCOMPARE(lit(QRect(head.right() - head.width() / 3, head.top(), head.width() / 3, head.height())), 0.0);
    QCOMPARE(figure.pixelColor(head.topLeft() + QPoint(1, 1)), QColor(Qt::white));
    QVERIFY(plain(area.grab().toImage()).pixelColor(head.topLeft() + QPoint(1, 1)) != QColor(Qt::white));
  }

  void aPictureHasTheWidthThatIsChosen() {
    Workbench bench;
    bench.trigger("pictureOfPanels");
    const auto chooseSize = [&](double width, const QString& unit, int dpi) {
      QTimer::singleShot(0, &bench.window, [&] {
        auto* dialog = QApplication::activeModalWidget();
        QVERIFY(dialog != nullptr);
        dialog->findChild<QComboBox*>(QStringLiteral("pictureUnit"))->setCurrentText(unit);
        dialog->findChild<QDoubleSpinBox*>(QStringLiteral("pictureWidth"))->setValue(width);
        dialog->findChild<QSpinBox*>(QStringLiteral("pictureDpi"))->setValue(dpi);
        qobject_cast<QDialog*>(dialog)->accept();
      });
      bench.trigger("pictureOwnSize");
    };
    chooseSize(1000, QStringLiteral("pixels"), 96);
    const QString png = folder_.filePath(QStringLiteral("sized.png"));
    pictures(bench).savePath(png);
    bench.settle();
    QCOMPARE(QImage(png).width(), 1000);
    chooseSize(80, QStringLiteral("mm"), 300);
    pictures(bench).savePath(png);
    bench.settle();
    QCOMPARE(QImage(png).width(), 945);  // 80 mm / 25.4 mm * 300
    QCOMPARE(QImage(png).dotsPerMeterX(), 11811);
    QVERIFY(bench.find<QAction>("pictureOwnSize")->text().contains(QStringLiteral("80 mm at 300 dpi")));
    const QString svg = folder_.filePath(QStringLiteral("sized.svg"));
    pictures(bench).savePath(svg);
    bench.settle();
    QFile file(svg);
    QVERIFY(file.open(QIODevice::ReadOnly));
    QVERIFY(file.readAll().contains("width=\"80mm\""));
    const Workbench again;
    QVERIFY(again.window.findChild<QAction*>(QStringLiteral("pictureOwnSize"))->isChecked());
  }

  void theDialogOfTheSizeSaysHowManyPixels() {
    PictureSizeDialog dialog(nullptr, QStringLiteral("Size"), {160, true, 300}, {1000, 500});
    const auto text = [&] { return dialog.findChild<QLabel*>(QStringLiteral("picturePixels"))->text(); };
    QCOMPARE(text(), QStringLiteral("1,890 × 945 pixels, 160.0 mm wide in print"));
    auto* unit = dialog.findChild<QComboBox*>(QStringLiteral("pictureUnit"));
    unit->setCurrentIndex(0);  // the same size in the other unit
    QCOMPARE(dialog.chosen().width, 1890.0);
    unit->setCurrentIndex(1);
    QCOMPARE(dialog.chosen().width, 160.0);
    dialog.findChild<QCheckBox*>(QStringLiteral("pictureAsOnScreen"))->setChecked(true);
    QVERIFY(dialog.chosen().asOnScreen());
    QCOMPARE(text().section(QLatin1Char(','), 0, 1), QStringLiteral("1,000 × 500 pixels"));
    QCOMPARE(PictureSize({2000, true, 1200}).pixels(), PictureSize::mostPixels);  // not 94,488
    QCOMPARE(PictureSize({2000, true, 1200}).dotsPerMetre(), 6000.0);             // so it is 2 m wide in print
  }

  void drawingsOfPanelsSayWhatTheyShow() {
    Workbench bench;
    bench.trigger("colourBy-violation");
    bench.trigger("showFigures");
    edits::setPinned(bench.document(), {40}, true);
    bench.dragFar();
    bench.settleFigures();
    bench.trigger("pictureOfPanels");
    const QString svg = folder_.filePath(QStringLiteral("panels.svg")), pdf = folder_.filePath(QStringLiteral("p.pdf"));
    pictures(bench).savePath(svg);
    bench.settle();
    pictures(bench).savePath(pdf);
    bench.settle();
    QFile file(svg);
    QVERIFY(file.open(QIODevice::ReadOnly));
    const QString text = QString::fromUtf8(file.readAll());
    for (const char* word :
         {"Generalized ChainMail", "Natural Queue ChainMail", "links violated, worst", "links checked"}) {
      QVERIFY2(text.contains(QLatin1String(word)), word);
    }
    QVERIFY(!text.contains(QStringLiteral("<image")));  // lines, not pixels
    QFile document(pdf);
    QVERIFY(document.open(QIODevice::ReadOnly));
    QVERIFY(document.read(5) == "%PDF-");
  }

 private:
  QTemporaryDir folder_;
};

CHAINMAIL_WINDOW_TEST(WindowPictures)

}  // namespace chainmail::window_pictures

#include "window_pictures.moc"
