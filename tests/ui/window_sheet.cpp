// Tests pictures as sheets in a real window: opening, warping, saving.

#include <QBuffer>
#include <QDropEvent>
#include <QFile>
#include <QImage>
#include <QLabel>
#include <QMimeData>
#include <QPushButton>
#include <QSpinBox>

#include "document/edits.h"
#include "io/file_actions.h"
#include "io/sessions.h"
#include "io/sheet_bar.h"
#include "io/sheets.h"
#include "window.h"
#include "window/message_bar.h"

namespace chainmail::window_sheet {

class WindowSheet : public QObject {
  Q_OBJECT

 private slots:
  void init() { failOnWarnings(); }

  void aPictureOpensAsASheetOfTheSizeChosen() {
    Workbench bench;
    const MeshPointer before = bench.document().mesh();
    auto& bar = sheets(bench).bar();
    sheets(bench).openPath(picture("a.png"));
    QVERIFY(!bar.isVisible());  // the header is read in the background
    bench.settle();
    QVERIFY(bar.isVisible());
    QCOMPARE(bench.document().mesh(), before);
    QVERIFY(bench.find<QLabel>("sheetAbout")->text().contains(QStringLiteral("a.png as a sheet: 120 × 80 pixels")));
    QCOMPARE(bench.find<QSpinBox>("sheetAcross")->value(), 32);
    bench.find<QSpinBox>("sheetAcross")->setValue(13);
    QCOMPARE(bench.find<QLabel>("sheetResult")->text(), QStringLiteral("13 × 9 elements, one every 10 pixels"));
    bench.find<QPushButton>("sheetAgree")->click();
    bench.settle();
    QVERIFY(!bar.isVisible());
    const Mesh& mesh = *bench.document().mesh();
    QCOMPARE(mesh.element_count(), 13U * 9U);
    QCOMPARE(mesh.rest_position(13 * 9 - 1), Point(120, 80, 0));
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
    openSheet(bench, path, 9);
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

  void droppedWithAWrongNameItIsAPictureStillAndTheKeyboardAnswers() {
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
    auto& bar = sheets(bench).bar();
    QVERIFY(bar.isVisible());
    QTest::keyClick(QApplication::focusWidget(), Qt::Key_Escape);
    QVERIFY(!bar.isVisible());
    QVERIFY(!bench.document().undoStack().canUndo());
    bench.open(path);
    QTest::keyClicks(QApplication::focusWidget(), QStringLiteral("7"));
    QTest::keyClick(QApplication::focusWidget(), Qt::Key_Return);
    bench.settle();
    QCOMPARE(bench.document().mesh()->element_count(), 7U * 5U);
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
    if (sheets(bench).bar().isVisible()) {
      bench.find<QPushButton>("sheetAgree")->click();  // its header was valid
      bench.settle();
    }
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
    QVERIFY(bench.find<QLabel>("sheetAbout")->text().contains(QStringLiteral("80 × 120 pixels")));
    openSheet(bench, turned.fileName(), 5);
    QCOMPARE(bench.document().mesh()->texture->size, (std::array<std::uint32_t, 3>{80, 120, 1}));
    // The lower left pixel is now at the upper left, in the last row of texels.
    const auto& texels = bench.document().mesh()->texture->texels;
    const QColor was = QImage(picture("c.jpg")).pixelColor(0, 79);
    QVERIFY(std::abs(int(texels[std::size_t{4} * 80 * 119 + 1]) - was.green()) < 12);  // JPEG is not exact
  }

  /// Without a drag, the saved picture is the original. After a drag, pinned parts stay and the rest moves.
  void theWarpedPictureIsSaved() {
    Workbench bench;
    QVERIFY(!bench.find<QAction>("saveWarpedA")->isEnabled());
    openSheet(bench, picture("a.png"), 13);
    QVERIFY(bench.find<QAction>("saveWarpedA")->isEnabled());
    const QImage image = QImage(picture("a.png")).convertToFormat(QImage::Format_RGBA8888);
    QCOMPARE(warped(bench, 1, "rest.png"), image);

    std::vector<ElementId> border;
    for (ElementId e = 0; e < 13 * 9; ++e) {
      if (e % 13 == 0 || e % 13 == 12 || e < 13 || e >= 13 * 8) {
        border.push_back(e);
      }
    }
    edits::setPinned(bench.document(), border, true);
    const QPoint from = bench.place(0, 13 * 4 + 6);
    bench.stroke(0, {from, from + QPoint(60, 30)});
    QVERIFY(bench.position(1, 13 * 4 + 6) != bench.document().mesh()->rest_position(13 * 4 + 6));
    const QImage dragged = warped(bench, 1, "dragged.png");
    QCOMPARE(dragged.size(), image.size());  // the object stays inside the border
    QVERIFY(dragged != image);
    for (const QPoint corner : {QPoint(0, 0), QPoint(119, 0), QPoint(0, 79), QPoint(119, 79)}) {
      QCOMPARE(dragged.pixelColor(corner), image.pixelColor(corner));
    }
    QVERIFY(warped(bench, 0, "dragged.jpg").size() == image.size());
  }

  void eachPanelsOwnPictureIsSaved() {
    Workbench bench;
    openSheet(bench, picture("a.png"), 13);
    bench.choose(1, "Exact ChainMail");
    edits::setPinned(bench.document(), {0, 12, 13 * 8, 13 * 9 - 1}, true);
    const QPoint from = bench.place(0, 13 * 4 + 6);
    bench.stroke(0, {from, from + QPoint(60, 30)});
    QVERIFY(bench.document().solvers().frame(0)->positions != bench.document().solvers().frame(1)->positions);
    bench.trigger("warpOwnFrame");
    const QImage first = warped(bench, 0, "first.png"), second = warped(bench, 1, "second.png");
    QVERIFY(first != second);
    bench.choose(0, "Exact ChainMail");
    bench.document().moves().goTo(0);
    bench.settle();
    bench.document().moves().goTo(bench.document().moves().history().length());
    bench.settle();
    QCOMPARE(warped(bench, 0, "again.png"), second);  // the same algorithm gives the same picture
  }

  void thePictureOfAPanelThatIsAddedCanBeSavedToo() {
    Workbench bench;
    const auto* save = bench.find<QAction>("saveWarpedC");
    QVERIFY(!save->isVisible());
    bench.trigger("addPanel");
    QTRY_VERIFY(save->isVisible());
    bench.trigger("removePanel");
    QTRY_VERIFY(!save->isVisible());
    bench.settle();
  }

  void aCutIsAHoleAndTheFrameIsChosen() {
    Workbench bench;
    openSheet(bench, picture("a.png"), 13);
    const Mesh& mesh = *bench.document().mesh();
    edits::cut(bench.document(), {*find_link(mesh, 0, 14)});  // the diagonal of the lowest square on the left
    bench.document().handle().grab(13 * 9 - 1);
    bench.document().handle().drag(Point(180, 80, 0));
    bench.document().handle().release();
    bench.settle();
    QCOMPARE(warped(bench, 0, "all.png").width(), 180);
    bench.trigger("warpOwnFrame");
    const QImage own = warped(bench, 0, "own.png");
    QCOMPARE(own.size(), QSize(120, 80));
    QCOMPARE(own.pixelColor(2, 77).alpha(), 0);
    QCOMPARE(own.pixelColor(2, 60).alpha(), 255);
  }

  void whereItCannotBeSavedNothingIsTouched() {
    Workbench bench;
    openSheet(bench, picture("a.png"), 13);
    for (const char* name : {"no/such/folder.png", "no.tiff"}) {
      sheets(bench).saveWarpedPath(0, folder_.filePath(QLatin1String(name)));
      bench.settle();
      QVERIFY(bench.window.messages().sentence().contains(QLatin1String(name)));
      QVERIFY(!QFile::exists(folder_.filePath(QLatin1String(name))));
    }
  }

  void aSessionKeepsThePicture() {
    Workbench bench;
    openSheet(bench, picture("a.png"), 13);
    const auto texture = bench.document().mesh()->texture;
    const QString path = folder_.filePath(QStringLiteral("sheet.chainmail"));
    bench.window.sessions().savePath(path);
    bench.settle();
    Workbench again;
    again.open(path);
    QVERIFY(again.document().mesh()->texture != nullptr);
    QVERIFY(again.document().mesh()->texture->texels == texture->texels);
    QVERIFY(again.find<QAction>("saveWarpedA")->isEnabled());
  }

 private:
  void write(const QString& name, const QByteArray& bytes) const {
    QFile file(folder_.filePath(name));
    QVERIFY(file.open(QIODevice::WriteOnly) && file.write(bytes) == bytes.size());
  }

  static Sheets& sheets(Workbench& bench) { return bench.window.findChild<FileActions*>()->sheets(); }

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

  static void openSheet(Workbench& bench, const QString& path, int across) {
    sheets(bench).open(path, across);
    bench.settle();
  }

  QImage warped(Workbench& bench, int panel, const char* name) const {
    const QString path = folder_.filePath(QLatin1String(name));
    sheets(bench).saveWarpedPath(panel, path);
    bench.settle();
    return QImage(path).convertToFormat(QImage::Format_RGBA8888);
  }

  QTemporaryDir folder_;
};

CHAINMAIL_WINDOW_TEST(WindowSheet)

}  // namespace chainmail::window_sheet

#include "window_sheet.moc"
