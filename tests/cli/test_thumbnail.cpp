#include <png.h>

#include <QPoint>
#include <algorithm>
#include <array>
#include <random>
#include <vector>

#include "cli/chainmail_program.h"
#include "folders.h"
#include "packed_voxels.h"
#include "program.h"

namespace chainmail::test_thumbnail {

using namespace chainmail::test;

namespace {

/// A picture, as libpng reads it: red, green, blue and alpha of each pixel. Empty if there is none.
struct Picture {
  explicit Picture(const QString& path) {
    png_image image{};
    image.version = PNG_IMAGE_VERSION;
    if (png_image_begin_read_from_file(&image, path.toUtf8()) == 0) {
      return;
    }
    image.format = PNG_FORMAT_RGBA;
    pixels.resize(std::size_t{image.width} * image.height);
    if (png_image_finish_read(&image, nullptr, pixels.data(), 0, nullptr) != 0) {
      width = int(image.width);
      height = int(image.height);
    }
  }

  std::array<png_byte, 4> at(QPoint point) const { return pixels.at(std::size_t(point.y() * width + point.x())); }
  int alpha(QPoint point) const { return at(point)[3]; }

  int width = 0, height = 0;
  std::vector<std::array<png_byte, 4>> pixels;
};

}  // namespace

/// Tests `chainmail thumbnail` with pictures that are known beforehand.
class ThumbnailCommandTest : public QObject {
  Q_OBJECT

 private slots:
  void a_square_fills_the_picture();
  void a_near_face_hides_a_far_one();
  void a_session_is_drawn_in_its_state();
  void slender_faces_take_little_time_data();
  void slender_faces_take_little_time();
  void neighbouring_faces_leave_no_gap();
  void work_without_end_is_ended();
  void files_of_other_programs();
  void a_mesh_with_a_long_name_is_refused();
  void refused_data();
  void refused();

 private:
  /// Draws a file that has this text.
  static Picture draw(const Program& program, const QString& name, const QByteArray& text, const char* more = "");
};

Picture ThumbnailCommandTest::draw(const Program& program, const QString& name, const QByteArray& text,
                                   const char* more) {
  program.write(name, text);
  const auto outcome = program.run("thumbnail " + name.toUtf8() + " -o picture.png " + more);
  return Picture(outcome.code == 0 ? program.path("picture.png") : QString());
}

void ThumbnailCommandTest::a_square_fills_the_picture() {
  const Program program;
  const QByteArray square = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3 4\n";
  const Picture picture = draw(program, "square.obj", square, "--size 100");
  QCOMPARE(picture.width, 100);
  QCOMPARE(picture.height, 100);
  QCOMPARE(picture.alpha({50, 40}), 255);
  for (const QPoint corner : {QPoint(1, 1), QPoint(98, 1), QPoint(1, 98), QPoint(98, 98)}) {
    QCOMPARE(picture.alpha(corner), 0);  // the margin is 6 % wide
  }
  for (const QPoint inside : {QPoint(9, 9), QPoint(90, 9), QPoint(9, 90), QPoint(90, 90)}) {
    QCOMPARE(picture.alpha(inside), 255);
  }
  QCOMPARE(draw(program, "square.obj", square).width, 256);
}

void ThumbnailCommandTest::a_near_face_hides_a_far_one() {
  const Program program;
  // A small tilted square before a large one, then behind it. The light makes their colours differ.
  const QByteArray large = "v -1 -1 0\nv 1 -1 0\nv 1 1 0\nv -1 1 0\nf 1 2 3 4\n";
  const QByteArray before = "v -.4 -.4 .2\nv .4 -.4 .2\nv .4 .4 .4\nv -.4 .4 .4\nf 5 6 7 8\n";
  const QByteArray behind = "v -.4 -.4 -.4\nv .4 -.4 -.4\nv .4 .4 -.2\nv -.4 .4 -.2\nf 5 6 7 8\n";
  const QPoint middle(128, 128), beside(53, 128);
  const Picture near = draw(program, "near.obj", large + before), far = draw(program, "far.obj", large + behind);
  QVERIFY(far.at(middle) == far.at(beside));
  QVERIFY(near.at(beside) == far.at(beside));
  QVERIFY(near.at(middle) != near.at(beside));
}

void ThumbnailCommandTest::a_session_is_drawn_in_its_state() {
  const Program program;
  const QByteArray session =
      R"({"format": "chainmail session", "version": 2, "name": "two",
"mesh": {"elements": 3, "space": 2, "rest": [0,0,0, 1,0,0, 0,1,0], "links": [0,1, 0,2], "triangles": [], "polygons": [],
"tetrahedra": []}, "cuts": [CUT], "pins": [],
"softness": {"compression": 0.8, "stretch": 1.2, "shear": 0.1, "lateral": 1, "stiffness": 1, "exponent": -1,
"energy": "corotated", "own": []}, "relaxation": {"on": false, "scheme": "mean", "step": 1},
"panels": [{"algorithm": "exact", "precision": "double", "from_rest": false, "runs": [1, 2], "held": [2, 0]}],
"ui": {}})";
  const auto links_are_drawn = [&](const QByteArray& cut) {
    const Picture picture = draw(program, "two.chainmail", QByteArray(session).replace("CUT", cut));
    // Element 1 was dragged to twice its distance: the object is twice as wide as high.
    return std::pair(picture.alpha({15, 128}) > 0, picture.alpha({200, 184}) > 0);
  };
  QCOMPARE(links_are_drawn(""), std::pair(true, true));
  QCOMPARE(links_are_drawn("0,1"), std::pair(true, false));  // a cut link is not drawn
}

void ThumbnailCommandTest::slender_faces_take_little_time_data() {
  QTest::addColumn<QByteArray>("shape");  // %1 to %3: the vertices
  QTest::addColumn<int>("count");
  QTest::newRow("slivers") << QByteArray("v 0 %1 0\nv 1 %2 0\nv 0.999 %3 0\nf -1 -2 -3\n") << 30'000;
  QTest::newRow("large faces") << QByteArray("v 0 0 %1\nv 1 0 %2\nv 0.5 1 %3\nf -1 -2 -3\n") << 30'000;
  QTest::newRow("lines") << QByteArray("v 0 %1 0\nv 1 %2 %3\nl -1 -2\n") << 50'000;
}

/// Each face and line spans the picture. The processor time is limited from outside, too.
void ThumbnailCommandTest::slender_faces_take_little_time() {
  QFETCH(QByteArray, shape);
  QFETCH(int, count);
  const Program program;
  std::mt19937 random(3);
  QByteArray text;
  for (int i = 0; i < count; ++i) {
    QByteArray one = shape;
    for (const char* place : {"%1", "%2", "%3"}) {
      one.replace(place, QByteArray::number(double(random() % 100'000) / 1e5));
    }
    text += one;
  }
  program.write("many.obj", text);
  const auto outcome =
      program.run({"thumbnail", "many.obj", "-o", "picture.png", "--size", "1024"}, [] { limit_resources(3); });
  QVERIFY2(outcome.code == 0, outcome.error);
  const Picture picture(program.path("picture.png"));
  QVERIFY(picture.alpha({512, 512}) == 255);
}

void ThumbnailCommandTest::neighbouring_faces_leave_no_gap() {
  const Program program;
  QByteArray grid;
  for (int y = 0; y <= 7; ++y) {
    for (int x = 0; x <= 7; ++x) {
      grid += QByteArray("v %1 %2 0\n").replace("%1", QByteArray::number(x)).replace("%2", QByteArray::number(y));
    }
  }
  for (int y = 0; y < 7; ++y) {
    for (int x = 0; x < 7; ++x) {
      const int a = 8 * y + x + 1;
      for (const std::array<int, 3>& face : {std::array{a, a + 1, a + 9}, {a, a + 9, a + 8}}) {
        grid += "f " + QByteArray::number(face[0]) + ' ' + QByteArray::number(face[1]) + ' ' +
                QByteArray::number(face[2]) + '\n';
      }
    }
  }
  const Picture picture = draw(program, "grid.obj", grid);
  for (int y = 20; y < 236; ++y) {
    for (int x = 20; x < 236; ++x) {
      QCOMPARE(picture.alpha({x, y}), 255);
    }
  }
}

/// A megabyte with 2^30 voxels.
void ThumbnailCommandTest::work_without_end_is_ended() {
  const Program program;
  program.write("large.mha", packed_volume({1024, 1024, 1024}));
  const auto outcome = program.run({"thumbnail", "large.mha", "-o", "picture.png"}, [] { limit_resources(3); });
  QCOMPARE(outcome.code, 2);
  QCOMPARE(
      outcome.error,
      QByteArray("chainmail: large.mha: this takes more than 2 s of processor time; use a smaller file, or open it "
                 "in the workbench\n"));
  QCOMPARE(program.files(), QStringList{"large.mha"});
}

/// Each file of tests/files/world that opens has a picture that is not empty.
void ThumbnailCommandTest::files_of_other_programs() {
  const Program program;
  const QString folder = QString::fromStdString(source_file("tests/files/world").string());
  const QStringList rows = QString::fromStdString(file_text(source_file("tests/files/world/table.csv"))).split('\n');
  for (const QString& row : rows.mid(1)) {
    const QString name = row.section(';', 0, 0);
    const bool opens = !row.section(';', 1, 1).isEmpty();
    if (name.isEmpty()) {
      continue;  // the last line
    }
    const auto outcome = program.run({"thumbnail", folder + '/' + name, "-o", "picture.png"});
    QVERIFY2(opens ? outcome.code == 0 : outcome.code == 2 && is_one_sentence(outcome), qPrintable(name));
    const Picture picture(opens ? program.path("picture.png") : QString());
    const auto drawn =
        std::count_if(picture.pixels.begin(), picture.pixels.end(), [](auto pixel) { return pixel[3] > 0; });
    QVERIFY2(!opens || drawn > 20, qPrintable(name));
  }
}

/// Asking whether such a file exists fails.
void ThumbnailCommandTest::a_mesh_with_a_long_name_is_refused() {
  const Program program;
  for (const int length : {250, 5000}) {
    program.write("a.chainmail", R"({"format": "chainmail session", "version": 2, "name": "a", "mesh": {"file": ")" +
                                     QByteArray(length, 'x') + R"(.obj"}, "cuts": [], "pins": [], "ui": {}})");
    const auto outcome = program.run("thumbnail a.chainmail -o a.png");
    QCOMPARE(outcome.code, 2);
    QVERIFY2(is_one_sentence(outcome), outcome.error);
  }
}

void ThumbnailCommandTest::refused_data() {
  QTest::addColumn<QString>("where");
  QTest::newRow("thumbnail a.obj") << "-o: it is missing";
  QTest::newRow("thumbnail none.obj -o a.png") << "none.obj: ";
  QTest::newRow("thumbnail a.obj -o a.obj") << "a.obj: ";
  QTest::newRow("thumbnail a.obj -o b.png --size 4000")
      << "--size: '4000' is not a whole number in range; use 16 to 1024";
  QTest::newRow("thumbnail a.obj -o b.png --size 3") << "--size: ";
  QTest::newRow("thumbnail broken.chainmail -o b.png") << "broken.chainmail";
}

void ThumbnailCommandTest::refused() {
  QFETCH(QString, where);
  const Program program;
  program.write("a.obj", "v 0 0 0\nv 1 0 0\nl 1 2\n");
  program.write("broken.chainmail", "{\"format\": \"chainmail session\"");
  check_refused(program, QTest::currentDataTag(), where);
}

CHAINMAIL_TEST(ThumbnailCommandTest)

}  // namespace chainmail::test_thumbnail

#include "test_thumbnail.moc"
