// Tests pictures as sheets in a real window.

#include <QBuffer>
#include <QDropEvent>
#include <QFile>
#include <QImage>
#include <QMimeData>

#include "io/sessions.h"
#include "window.h"
#include "window/bars.h"

namespace chainmail::window_sheet {

class WindowSheet : public QObject {
  Q_OBJECT

 private slots:
  void init() { failOnWarnings(); }

  void aPictureOpensAsASheet() {
    Workbench bench;
    const MeshPointer before = bench.document().mesh();
    bench.open(picture("a.png"));
    const Mesh& mesh = *bench.document().mesh();
    QCOMPARE(mesh.element_count(), 32U * 22U);
    QCOMPARE(mesh.rest_position(mesh.element_count() - 1), Point(120, 80, 0));
    QCOMPARE(mesh.texture->size, (std::array<std::uint32_t, 3>{120, 80, 1}));
    // The first texel is at the bottom left: the last row of the picture.
    const QImage image(picture("a.png"));
    const QColor lowest = image.pixelColor(0, 79);
    QCOMPARE(int(mesh.texture->texels[0]), lowest.red());
    QCOMPARE(int(mesh.texture->texels[2]), lowest.blue());
    QCOMPARE(bench.document().undoStack().undoText(), QStringLiteral("open a.png"));
    bench.trigger("undo");
    bench.settle();
    QCOMPARE(bench.document().mesh(), before);
  }

  /// Pixels are at their exact positions on the screen, with an error of less than half a pixel.
  void everyPixelIsSeenInItsPlace() {
    QImage image(4, 3, QImage::Format_RGB888);
    for (int y = 0; y < 3; ++y) {
      for (int x = 0; x < 4; ++x) {
        image.setPixelColor(x, y, QColor(30 + 60 * x, 30 + 80 * y, (x + y) % 2 == 0 ? 60 : 200));
      }
    }
    const QString path = folder_.filePath(QStringLiteral("tiny.png"));
    QVERIFY(image.save(path));
    Workbench bench;
    bench.open(path);
    bench.document().highlight().set({});
    const QImage seen = bench.view(0).grabFramebuffer();
    for (int y = 0; y < 3; ++y) {
      for (int x = 0; x < 4; ++x) {
        const QPointF place = bench.view(0).viewPosition(Point(x + 0.5, 3 - (y + 0.5), 0));
        const QColor colour = seen.pixelColor(place.toPoint()), own = image.pixelColor(x, y);
        // An offset of half a pixel would give a difference of at least 30.
        const int apart = std::max({std::abs(colour.red() - own.red()), std::abs(colour.green() - own.green()),
                                    std::abs(colour.blue() - own.blue())});
        QVERIFY2(apart <= 8,
                 qPrintable(QStringLiteral("%1, %2: %3 and not %4").arg(x).arg(y).arg(colour.name(), own.name())));
      }
    }
  }

  void droppedWithAWrongNameItIsAPictureStill() {
    Workbench bench;
    const QString path = folder_.filePath(QStringLiteral("picture.dat"));
    QFile::remove(path);
    QVERIFY(QFile::copy(picture("b.png"), path));
    QMimeData data;
    data.setUrls({QUrl::fromLocalFile(path)});
    QDragEnterEvent enter(QPoint(50, 50), Qt::CopyAction, &data, Qt::LeftButton, Qt::NoModifier);
    QApplication::sendEvent(&bench.window, &enter);
    QDropEvent drop(QPointF(50, 50), Qt::CopyAction, &data, Qt::LeftButton, Qt::NoModifier);
    QApplication::sendEvent(&bench.window, &drop);
    bench.settle();
    QVERIFY(bench.document().mesh()->texture != nullptr);
  }

  void damagedAndHugePicturesGetASentence_data() {
    QTest::addColumn<QByteArray>("bytes");
    QTest::addColumn<QString>("name");
    QTest::addColumn<QString>("said");
    const auto all = [this](const char* name) {
      QFile file(picture(name));
      return file.open(QIODevice::ReadOnly) ? file.readAll() : QByteArray();
    };
    QByteArray huge = all("a.png");
    // Its header says 65,536 × 65,536 pixels, and has a valid checksum.
    huge.replace(16, 17, QByteArray::fromHex("00010000000100000802000000") + QByteArray::fromHex("e3e6a7b4"));
    QTest::newRow("nothing in it") << QByteArray() << QStringLiteral("none.png")
                                   << QStringLiteral("it is not a PNG or JPEG picture");
    QTest::newRow("text") << QByteArray("v 0 0 0\n") << QStringLiteral("text.jpg")
                          << QStringLiteral("it is not a PNG or JPEG picture");
    const QStringList other{QStringLiteral("svg"), QStringLiteral("bmp"), QStringLiteral("ppm")};
    for (const QString& format : other) {
      QTest::newRow(qPrintable(format + QStringLiteral(" with the name of a PNG")))
          << pictureAs(format) << format + QStringLiteral(".png") << QStringLiteral("it is not a PNG or JPEG picture");
    }
    const QByteArray jpeg = all("c.jpg");
    const qsizetype scan = jpeg.indexOf("\xff\xda");
    QTest::newRow("a JPEG that takes a minute")
        << jpeg.first(scan) + jpeg.sliced(scan, 14).repeated(130'000) + jpeg.last(2) << QStringLiteral("slow.jpg")
        << QStringLiteral("it stores its pixels in 130,000 scans");
    QTest::newRow("half a JPEG") << all("c.jpg").chopped(900) << QStringLiteral("half.jpg")
                                 << QStringLiteral("it is damaged");
    QTest::newRow("half a PNG") << all("a.png").chopped(900) << QStringLiteral("half.png")
                                << QStringLiteral("it is damaged");
    QByteArray deep = all("a.png");
    deep.replace(16, 17, QByteArray::fromHex("00002710000027101006000000") + QByteArray::fromHex("eadebe64"));
    QTest::newRow("10,000 × 10,000 pixels of 64 bits")
        << deep << QStringLiteral("deep.png") << QStringLiteral("of 16 bits per colour, more than 50 million");
    QTest::newRow("huge") << huge << QStringLiteral("huge.png") << QStringLiteral("more than 100 million");
  }
  void damagedAndHugePicturesGetASentence() {
    QFETCH(QByteArray, bytes);
    QFETCH(QString, name);
    QFETCH(QString, said);
    Workbench bench;
    const MeshPointer before = bench.document().mesh();
    write(name, bytes);
    bench.open(folder_.filePath(name));
    QVERIFY2(bench.window.messages().sentence().contains(said), qPrintable(bench.window.messages().sentence()));
    QVERIFY(bench.window.messages().sentence().contains(name));
    QCOMPARE(bench.document().mesh(), before);
  }

  void thePictureOfASessionIsPngOrJpegToo() {
    for (const QString& format : {QStringLiteral("svg"), QStringLiteral("bmp")}) {
      Workbench bench;
      const MeshPointer before = bench.document().mesh();
      const QString name = QStringLiteral("in_session_%1.png").arg(format);
      write(name, pictureAs(format));
      write(QStringLiteral("named.chainmail"),
            "{\"format\": \"chainmail session\", \"version\": 2, \"name\": \"sheet\", \"mesh\": {\"file\": \"" +
                name.toUtf8() + "\"}}");
      bench.open(folder_.filePath(QStringLiteral("named.chainmail")));
      const QString sentence = bench.window.messages().sentence();
      QVERIFY2(sentence.contains(name + QStringLiteral(": it is not a PNG or JPEG picture")), qPrintable(sentence));
      QCOMPARE(bench.document().mesh(), before);
    }
  }

  void aPictureIsTurnedAsItsCameraSays() {
    QFile file(picture("c.jpg"));
    QVERIFY(file.open(QIODevice::ReadOnly));
    QByteArray bytes = file.readAll();
    // After the start marker: an Exif block with one entry, orientation 6 (a quarter turn to the right).
    bytes.insert(2, QByteArray::fromHex("ffe1002245786966000049492a000800000001001201030001000000060000000000"
                                        "0000"));
    QFile turned(folder_.filePath(QStringLiteral("turned.jpg")));
    QVERIFY(turned.open(QIODevice::WriteOnly) && turned.write(bytes) == bytes.size());
    turned.close();
    Workbench bench;
    bench.open(turned.fileName());
    QCOMPARE(bench.document().mesh()->texture->size, (std::array<std::uint32_t, 3>{80, 120, 1}));
    // The lower left pixel is now at the upper left, in the last row of texels.
    const auto& texels = bench.document().mesh()->texture->texels;
    const QColor was = QImage(picture("c.jpg")).pixelColor(0, 79);
    QVERIFY(std::abs(int(texels[std::size_t{4} * 80 * 119 + 1]) - was.green()) < 12);  // JPEG is not exact
  }

 private:
  void write(const QString& name, const QByteArray& bytes) const {
    QFile file(folder_.filePath(name));
    QVERIFY(file.open(QIODevice::WriteOnly) && file.write(bytes) == bytes.size());
  }

  /// Returns the bytes of a picture in a format that is not opened. As SVG, it names another picture, which its reader
  /// would open.
  QByteArray pictureAs(const QString& format) const {
    if (format == QLatin1String("svg")) {
      return "<svg xmlns=\"http://www.w3.org/2000/svg\" xmlns:xlink=\"http://www.w3.org/1999/xlink\" width=\"100\" "
             "height=\"100\"><image xlink:href=\"" +
             picture("a.png").toUtf8() + "\" width=\"50\" height=\"50\"/></svg>";
    }
    QByteArray bytes;
    QBuffer buffer(&bytes);
    QImage(picture("a.png")).save(&buffer, qPrintable(format));
    return bytes;
  }

  /// Returns the path of a colourful picture of 120 × 80 pixels. Makes it once.
  QString picture(const char* name) const {
    const QString path = folder_.filePath(QLatin1String(name));
    if (!QFile::exists(path)) {
      QImage image(120, 80, QImage::Format_RGB888);
      for (int y = 0; y < 80; ++y) {
        for (int x = 0; x < 120; ++x) {
          image.setPixelColor(x, y, QColor(2 * x, 3 * y, (x * y) % 256));
        }
      }
      if (!image.save(path)) {
        qFatal("cannot write %s", name);
      }
    }
    return path;
  }

  QTemporaryDir folder_;
};

CHAINMAIL_WINDOW_TEST(WindowSheet)

}  // namespace chainmail::window_sheet

#include "window_sheet.moc"
