// Tests pictures of the window and its parts, copied and saved, in a real window.

#include <QClipboard>
#include <QComboBox>
#include <QDoubleSpinBox>
#include <QFile>
#include <QPainter>
#include <QSvgRenderer>
#include <QTemporaryDir>

#include "common/colours.h"
#include "document/edits.h"
#include "io/picture_actions.h"
#include "io/pictures.h"
#include "window.h"
#include "window/bars.h"

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

  void onlyTheGhostOfAVectorPictureIsSeeThrough() {
    Workbench bench;
    bench.dragFar();
    edits::setPinned(bench.document(), {40}, true);
    bench.trigger("ghosts");
    bench.settleFigures();
    const QTemporaryDir folder;
    const QString path = folder.filePath(QStringLiteral("ghost.svg"));
    writeDrawing(path, drawingOf(bench.view(0), false));
    QFile file(path);
    QVERIFY(file.open(QIODevice::ReadOnly));
    const QByteArray text = file.readAll(), behind = text.mid(text.lastIndexOf("opacity=\"0.5\""));
    QVERIFY(behind.size() < text.size());
    QVERIFY2(behind.count("<g ") > 1, behind);  // solid groups follow
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

  void aTransparentDrawingHasNoGround() {
    Workbench bench;
    const QString path = folder_.filePath(QStringLiteral("drawing.svg"));
    for (const char* subject : {"pictureOfObjectA", "pictureOfPanelA"}) {
      bench.trigger(subject);
      for (const bool transparent : {false, true}) {
        bench.find<QAction>("pictureTransparent")->setChecked(transparent);
        pictures(bench).savePath(path);
        bench.settle();
        QImage below(60, 40, QImage::Format_RGB32);
        below.fill(Qt::magenta);
        QPainter painter(&below);
        QSvgRenderer(path).render(&painter, below.rect());
        QVERIFY2((below.pixelColor(1, 20) == QColor(Qt::magenta)) == transparent, subject);
      }
    }
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
    QVERIFY(lit(within(area.legend())) > 0.005);  // the panels share it
    QVERIFY(lit(head) > 0.005);
    QCOMPARE(lit(QRect(head.right() - head.width() / 3, head.top(), head.width() / 3, head.height())), 0.0);
    QCOMPARE(figure.pixelColor(head.topLeft() + QPoint(1, 1)), QColor(Qt::white));
    QVERIFY(plain(area.grab().toImage()).pixelColor(head.topLeft() + QPoint(1, 1)) != QColor(Qt::white));
  }

  void aPictureHasTheWidthThatIsChosen() {
    Workbench bench;
    bench.trigger("pictureOfPanels");
    const auto chooseSize = [&](double width, const QString& unit, int dpi, int answer = QDialog::Accepted) {
      QTimer::singleShot(0, &bench.window, [&] {
        auto* dialog = QApplication::activeModalWidget();
        QVERIFY(dialog != nullptr);
        dialog->findChild<QComboBox*>(QStringLiteral("pictureUnit"))->setCurrentText(unit);
        dialog->findChild<QDoubleSpinBox*>(QStringLiteral("pictureWidth"))->setValue(width);
        dialog->findChild<QSpinBox*>(QStringLiteral("pictureDpi"))->setValue(dpi);
        qobject_cast<QDialog*>(dialog)->done(answer);
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
    chooseSize(50, QStringLiteral("mm"), 150, QDialog::Rejected);
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

 private:
  QTemporaryDir folder_;
};

CHAINMAIL_WINDOW_TEST(WindowPictures)

}  // namespace chainmail::window_pictures

#include "window_pictures.moc"
