#include <QtTest>
#include <random>

#include "core/support.h"
#include "mesh/error.h"
#include "mesh/sheet.h"
#include "program.h"

namespace chainmail::test_sheet {

using namespace chainmail::test;

/// Tests pictures as sheets.
class SheetTest : public QObject {
  Q_OBJECT

 private slots:
  void a_sheet_stands_on_its_pictures_border();
  void a_sheet_beyond_the_limit_is_refused();
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

}  // namespace

void SheetTest::a_sheet_stands_on_its_pictures_border() {
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

void SheetTest::a_sheet_beyond_the_limit_is_refused() {
  QVERIFY_THROWS_EXCEPTION(Error, make_sheet(noise(4, 4), 1));
  QVERIFY_THROWS_EXCEPTION(Error, make_sheet(noise(4, 4), 1'000'000));
}

CHAINMAIL_TEST(SheetTest)

}  // namespace chainmail::test_sheet

#include "test_sheet.moc"
