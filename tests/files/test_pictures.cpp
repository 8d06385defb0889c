#include <QtTest>

#include "files/formats/bare_picture.h"
#include "files/support.h"
#include "program.h"

namespace chainmail::test_pictures {

using namespace chainmail::test;

namespace {

const std::string jpeg_begin = "\xff\xd8";
const std::string png_begin("\x89PNG\r\n\x1a\n", 8);

/// Returns a chunk of a PNG. Its checksum is arbitrary: the decoder checks it.
std::string chunk(const std::string& type, const std::string& data) {
  return std::string(3, '\0') + char(data.size()) + type + data + "sum ";
}
/// Returns a segment of a JPEG.
std::string segment(char marker, const std::string& data) {
  return std::string{'\xff', marker, '\0', char(data.size() + 2)} + data;
}

std::string png() {
  return png_begin + chunk("IHDR", "size") + chunk("tEXt", "Title\0text") + chunk("iCCP", "profile") +
         chunk("PLTE", "colours") + chunk("tRNS", "clear") + chunk("acTL", "animation") + chunk("IDAT", "pixels") +
         chunk("zTXt", "text") + chunk("IDAT", "") + chunk("eXIf", "notes") + chunk("IEND", "") + "and more";
}
std::string bare_png() {
  return png_begin + chunk("IHDR", "size") + chunk("PLTE", "colours") + chunk("tRNS", "clear") +
         chunk("IDAT", "pixels") + chunk("IDAT", "") + chunk("IEND", "");
}

const std::string exif("Exif\0\0orientation", 17);
/// The data of a scan, with a stuffed zero, a restart and a fill byte.
const std::string scan_data("pixels\xff\0\xff\xd0more\xff", 15);

std::string jpeg() {
  return jpeg_begin + segment('\xe0', "JFIF") + segment('\xe1', "http://x") + segment('\xe1', "") + exif +
         segment('\xe1', exif) + segment('\xe1', exif) + segment('\xe2', "ICC_PROFILE") + segment('\xfe', "comment") +
         segment('\xed', "Photoshop") + "filler" + segment('\xee', "Adobe") + segment('\xdb', "table") +
         segment('\xc2', "size") + segment('\xda', "scan") + scan_data + segment('\xfe', "comment") +
         segment('\xda', "scan") + "last\xff\xd9" + "\xff\xd8 another picture";
}
std::string bare_jpeg() {
  const std::string data = scan_data.substr(0, scan_data.size() - 1);
  return jpeg_begin + segment('\xe0', "JFIF") + segment('\xe1', exif) + segment('\xee', "Adobe") +
         segment('\xdb', "table") + segment('\xc2', "size") + segment('\xda', "scan") + data + segment('\xda', "scan") +
         "last\xff\xd9";
}

}  // namespace

/// Tests what a decoder of pictures gets to see.
class PicturesTest : public QObject {
  Q_OBJECT

 private slots:
  void only_what_pixels_need_is_left();
  void the_signature_decides_data();
  void the_signature_decides();
  void what_ends_early_is_damaged();

 private:
  BarePicture bare(const std::string& bytes) const {
    const std::string path = folder_.filePath("picture").toStdString();
    put_file(path, bytes);
    return read_bare_picture(RegularFile(path));
  }

  QTemporaryDir folder_;
};

void PicturesTest::only_what_pixels_need_is_left() {
  const BarePicture first = bare(png()), second = bare(jpeg());
  QCOMPARE(int(first.format), int(PictureFormat::png));
  QCOMPARE(first.bytes, bare_png());
  QCOMPARE(int(second.format), int(PictureFormat::jpeg));
  QCOMPARE(second.bytes, bare_jpeg());
  QCOMPARE(second.scans, std::size_t{2});
  QCOMPARE(bare(bare_png()).bytes, bare_png());
  QCOMPARE(bare(bare_jpeg()).bytes, bare_jpeg());
}

void PicturesTest::the_signature_decides_data() {
  QTest::addColumn<std::string>("bytes");
  QTest::newRow("nothing") << std::string();
  QTest::newRow("SVG") << std::string("<svg xmlns=\"http://www.w3.org/2000/svg\"/>");
  QTest::newRow("GIF") << std::string("GIF89a");
  QTest::newRow("BMP") << std::string("BM6");
  QTest::newRow("a PNG after a blank") << std::string(" ").append(png());
  QTest::newRow("a PNG with other line ends") << std::string("\x89PNG\n\x1a\n").append(png().substr(8));
  QTest::newRow("the beginning of a signature") << png_begin.substr(0, 7);
}

void PicturesTest::the_signature_decides() {
  QFETCH(std::string, bytes);
  QVERIFY(!picture_format(bytes));
  QVERIFY(error_of([&] { bare(bytes); }).endsWith("it is not a PNG or JPEG picture; save it as one of these"));
}

void PicturesTest::what_ends_early_is_damaged() {
  for (const std::string& whole : {bare_png(), bare_jpeg()}) {
    for (std::size_t size = picture_signature_size; size < whole.size(); ++size) {
      QVERIFY2(error_of([&] { bare(whole.substr(0, size)); }).contains(": it is damaged; "),
               qPrintable(QString::number(size)));
    }
  }
}

CHAINMAIL_TEST(PicturesTest)

}  // namespace chainmail::test_pictures

#include "test_pictures.moc"
