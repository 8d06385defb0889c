#include <QtTest>
#include <cmath>
#include <random>

#include "core/support.h"
#include "files/mesh/mesh_file.h"
#include "files/mesh/warp.h"
#include "mesh/error.h"
#include "mesh/sheet.h"
#include "program.h"

namespace chainmail::test_warp {

using namespace chainmail::test;

/// Tests pictures as sheets, and their warped pictures after the sheet is deformed.
class WarpTest : public QObject {
  Q_OBJECT

 private slots:
  void a_sheet_stands_on_its_pictures_border();
  void a_sheet_beyond_the_limit_is_refused();
  void at_rest_it_gives_the_picture_back_to_the_bit_data();
  void at_rest_it_gives_the_picture_back_to_the_bit();
  void a_shift_by_whole_pixels_gives_the_picture_back();
  void twice_as_wide_it_is_sampled_between_the_texels();
  void what_is_cut_is_transparent();
  void in_any_shape_no_pixel_is_missed();
  void its_own_frame_is_that_of_the_picture();
  void a_sheet_dragged_too_far_is_refused();
};

namespace {

Texture noise(std::uint32_t width, std::uint32_t height) {
  Texture picture;
  picture.size = {width, height, 1};
  std::mt19937_64 random(width);
  for (std::size_t i = 0; i < picture.byte_count(); ++i) {
    picture.texels.push_back(i % 4 == 3 ? 255 : static_cast<std::uint8_t>(random() >> 56));
  }
  return picture;
}

Texture plain(std::uint32_t width, std::uint32_t height) {
  Texture picture;
  picture.size = {width, height, 1};
  picture.texels.assign(picture.byte_count(), 255);
  return picture;
}

/// A sheet with its elements at the positions that `place` returns, in single precision as in a panel.
struct Sheet {
  explicit Sheet(const MeshPointer& of) : mesh(of), cuts(of) {
    for (ElementId e = 0; e < mesh->element_count(); ++e) {
      put(e, mesh->rest_position(e));
    }
  }
  void put(ElementId element, const Point& at) {
    positions.resize(2 * std::size_t{mesh->element_count()});
    positions[2 * std::size_t{element}] = float(at.x());
    positions[2 * std::size_t{element} + 1] = float(at.y());
  }
  template <class Place>
  void put_all(Place place) {
    for (ElementId e = 0; e < mesh->element_count(); ++e) {
      put(e, place(mesh->rest_position(e)));
    }
  }
  PositionView view() const { return {positions.data(), 2 * sizeof(float), Precision::single_precision}; }
  Texture picture() const { return warped(*mesh, cuts, view(), frame_about(*mesh, cuts, view())); }

  MeshPointer mesh;
  Cuts cuts;
  std::vector<float> positions;
};

std::uint8_t opacity(const Texture& picture, std::uint32_t x, std::uint32_t y) {
  return picture.texels[4 * (std::size_t{y} * picture.size[0] + x) + 3];
}

}  // namespace

void WarpTest::a_sheet_stands_on_its_pictures_border() {
  const auto mesh = make_sheet(noise(300, 200), 16);
  QCOMPARE(mesh->element_count(), 16U * 11U);  // one row and one column every 20 pixels
  QCOMPARE(mesh->rest_position(15), Point(300, 0, 0));
  QCOMPARE(mesh->rest_position(16 * 11 - 1), Point(300, 200, 0));
  QCOMPARE(mesh->rest_position(1), Point(20, 0, 0));
  QCOMPARE(mesh->space_dimension, 2);
  QCOMPARE(mesh->object_dimension, 2);
  QCOMPARE(mesh->texture->box[1], Point(300, 200, 0));
  QVERIFY(is_sheet(*mesh));
  QVERIFY(!is_sheet(*make_mesh(MeshKind::cloth, {4, 4, 1})));
  QCOMPARE(sheet_size({1000, 1}, 2), (std::array<std::uint32_t, 2>{2, 2}));  // the smallest sheet
}

void WarpTest::a_sheet_beyond_the_limit_is_refused() {
  QVERIFY_THROWS_EXCEPTION(Error, make_sheet(noise(4, 4), 1));
  QVERIFY_THROWS_EXCEPTION(Error, make_sheet(noise(4, 4), 1'000'000));
}

void WarpTest::at_rest_it_gives_the_picture_back_to_the_bit_data() {
  QTest::addColumn<int>("width");
  QTest::addColumn<int>("height");
  QTest::addColumn<int>("across");
  QTest::newRow("whole steps") << 60 << 40 << 7;
  QTest::newRow("steps that are no whole pixels") << 61 << 47 << 8;
  QTest::newRow("finer than its pixels") << 9 << 7 << 30;
  QTest::newRow("wide, where floats are coarsest") << 16'001 << 5 << 33;
  QTest::newRow("a pixel") << 1 << 1 << 2;
}

void WarpTest::at_rest_it_gives_the_picture_back_to_the_bit() {
  QFETCH(int, width);
  QFETCH(int, height);
  QFETCH(int, across);
  const Sheet sheet(make_sheet(noise(std::uint32_t(width), std::uint32_t(height)), std::uint32_t(across)));
  const Texture picture = sheet.picture();
  QCOMPARE(picture.size, sheet.mesh->texture->size);
  QVERIFY(picture.texels == sheet.mesh->texture->texels);
}

void WarpTest::a_shift_by_whole_pixels_gives_the_picture_back() {
  Sheet sheet(make_sheet(noise(61, 47), 8));
  sheet.put_all([](const Point& p) { return Point(p + Point(-1000, 17, 0)); });
  const Texture picture = sheet.picture();
  QCOMPARE(picture.box[0], Point(-1000, 17, 0));
  QVERIFY(picture.texels == sheet.mesh->texture->texels);
}

void WarpTest::twice_as_wide_it_is_sampled_between_the_texels() {
  Sheet sheet(make_sheet(noise(40, 24), 6));
  sheet.put_all([](const Point& p) { return Point(2 * p.x(), p.y(), 0); });
  const Texture picture = sheet.picture();
  QCOMPARE(picture.size, (std::array<std::uint32_t, 3>{80, 24, 1}));
  // The centre of pixel x is at (x + 0.5) / 2 in the picture: a quarter of a texel from one texel's centre, and three
  // quarters from the next.
  for (std::uint32_t y = 0; y < 24; ++y) {
    for (std::uint32_t x = 0; x < 80; ++x) {
      const auto texel = [&](int column) {
        const auto at = std::size_t(std::clamp(column, 0, 39));
        return double(sheet.mesh->texture->texels[4 * (y * std::size_t{40} + at)]);
      };
      const int nearest = int(x / 2), other = nearest + (x % 2 == 0 ? -1 : 1);
      const double expected = 0.75 * texel(nearest) + 0.25 * texel(other);
      const double is = picture.texels[4 * (y * std::size_t{80} + x)];
      QVERIFY(std::abs(is - expected) <= 0.51);  // rounded to a whole step of brightness
    }
  }
}

void WarpTest::what_is_cut_is_transparent() {
  Sheet sheet(make_sheet(plain(40, 40), 5));  // each square has ten pixels along each side
  const LinkId diagonal = *find_link(*sheet.mesh, 6, 12);
  sheet.cuts.cut(diagonal);
  const Texture picture = sheet.picture();
  for (std::uint32_t y = 0; y < 40; ++y) {
    for (std::uint32_t x = 0; x < 40; ++x) {
      const bool gone = x >= 10 && x < 20 && y >= 10 && y < 20;  // both triangles of the square
      QCOMPARE(opacity(picture, x, y), std::uint8_t(gone ? 0 : 255));
    }
  }
}

/// The border stays, so every pixel lies in the sheet, even if the inside moves or folds. A transparent pixel would be
/// a gap between two triangles.
void WarpTest::in_any_shape_no_pixel_is_missed() {
  std::mt19937_64 random(11);
  for (int turn = 0; turn < 20; ++turn) {
    Sheet sheet(make_sheet(plain(64, 64), 9));
    sheet.put_all([&](const Point& p) {
      const bool border = p.x() == 0 || p.y() == 0 || p.x() == 64 || p.y() == 64;
      const double by = turn == 0 ? 0.5 : 3;  // with half pixels, edges run through centres of pixels
      return border ? p
                    : Point(p.x() + std::round(uniform(random, -by, by) * 2) / 2,
                            p.y() + std::round(uniform(random, -by, by) * 2) / 2, 0);
    });
    const Texture picture = sheet.picture();
    QCOMPARE(picture.size, (std::array<std::uint32_t, 3>{64, 64, 1}));
    QVERIFY(std::ranges::all_of(picture.texels, [](std::uint8_t byte) { return byte == 255; }));
  }
}

void WarpTest::its_own_frame_is_that_of_the_picture() {
  Sheet sheet(make_sheet(noise(40, 24), 6));
  sheet.put_all([](const Point& p) { return Point(p.x() + 30, p.y(), 0); });
  const Texture picture = warped(*sheet.mesh, sheet.cuts, sheet.view(), own_frame(*sheet.mesh));
  QCOMPARE(picture.size, (std::array<std::uint32_t, 3>{40, 24, 1}));
  QCOMPARE(opacity(picture, 29, 5), std::uint8_t(0));
  QCOMPARE(opacity(picture, 30, 5), std::uint8_t(255));
}

void WarpTest::a_sheet_dragged_too_far_is_refused() {
  Sheet sheet(make_sheet(noise(40, 24), 6));
  sheet.put(0, Point(-1e9, -1e9, 0));
  QVERIFY_THROWS_EXCEPTION(Error, sheet.picture());
  sheet.put(0, Point(-1e30, 0, 0));
  QVERIFY_THROWS_EXCEPTION(Error, sheet.picture());
  Sheet gone(make_sheet(noise(4, 4), 2));
  gone.cuts.cut(*find_link(*gone.mesh, 0, 3));
  QVERIFY_THROWS_EXCEPTION(Error, gone.picture());
}

CHAINMAIL_TEST(WarpTest)

}  // namespace chainmail::test_warp

#include "test_warp.moc"
