#include <QtTest>

#include "core/scenarios.h"
#include "mesh/parts.h"
#include "program.h"

namespace chainmail::test_parts {

using namespace chainmail::test;

/// The number of parts of an object, updated while it is cut.
class PartsTest : public QObject {
  Q_OBJECT

 private slots:
  void a_mesh_knows_its_parts();
  void cutting_and_uncutting_in_any_order_counts_as_from_scratch();
  void what_is_cut_already_counts_once();
  void a_slit_is_quick();
  void a_loose_part_costs_its_own_size();
};

namespace {

constexpr std::uint32_t width = 300;

/// Return the link from an element of a 300 x 300 grid to the next one to the right, and to the next one above.
LinkId right_of(const Mesh& mesh, std::uint32_t x, std::uint32_t y) {
  return *find_link(mesh, x + width * y, x + 1 + width * y);
}
LinkId above(const Mesh& mesh, std::uint32_t x, std::uint32_t y) {
  return *find_link(mesh, x + width * y, x + width * (y + 1));
}

}  // namespace

void PartsTest::a_mesh_knows_its_parts() {
  for (const MeshFamily& family : families()) {
    QCOMPARE(family.mesh->part_count, family.name == "two parts" ? 2U : 1U);
  }
  MeshParts alone;
  alone.rest = {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}};
  alone.links = {{0, 2}};
  QCOMPARE(build_mesh(std::move(alone))->part_count, 2U);
}

void PartsTest::cutting_and_uncutting_in_any_order_counts_as_from_scratch() {
  const auto holds = [] {
    const MeshPointer mesh = draw_family().mesh;
    Cuts cuts(mesh);
    Parts parts(mesh);
    for (int turn = 0; turn < 6; ++turn) {
      const bool cut = turn < 2 || *rc::gen::inRange(0, 3) > 0;
      const auto links = cut ? draw_links(*mesh) : cuts.links();
      const auto some = std::span(links).first(links.size() - (cut ? 0 : links.size() / 3));
      cut ? parts.cut(cuts, some) : parts.uncut(cuts, some);
      RC_ASSERT(parts.count() == count_parts(*mesh, cuts));
      RC_ASSERT(std::ranges::all_of(some, [&](LinkId link) { return cuts.is_cut(link) == cut; }));
    }
    parts.uncut(cuts, cuts.links());
    RC_ASSERT(parts.count() == mesh->part_count);
  };
  QVERIFY(check_property("the count is that of a flood over all elements", holds));
}

void PartsTest::what_is_cut_already_counts_once() {
  const auto mesh = make_mesh(MeshKind::line, {5, 1, 1});
  Cuts cuts(mesh);
  Parts parts(mesh);
  parts.cut(cuts, std::vector<LinkId>{1, 1, 2});
  QCOMPARE(parts.count(), 3U);
  parts.cut(cuts, std::vector<LinkId>{2});
  QCOMPARE(parts.count(), 3U);
  parts.uncut(cuts, std::vector<LinkId>{0, 2});
  QCOMPARE(parts.count(), 2U);
}

void PartsTest::a_slit_is_quick() {
  const auto mesh = make_mesh(MeshKind::grid, {width, width, 1});
  Cuts cuts(mesh);
  Parts parts(mesh);
  std::vector<LinkId> slit;
  for (std::uint32_t x = 130; x < 150; ++x) {
    slit.push_back(above(*mesh, x, 100));
  }
  parts.cut(cuts, slit);
  QCOMPARE(parts.count(), 1U);
  // Searches from both sides meet at the ends of the slit after about three elements: 2 sides, 20 long, 3 deep, and
  // some more.
  QVERIFY2(parts.looked_at() < 200, qPrintable(QString::number(parts.looked_at())));
  parts.uncut(cuts, slit);
  QVERIFY(parts.looked_at() < 200);
}

void PartsTest::a_loose_part_costs_its_own_size() {
  const auto mesh = make_mesh(MeshKind::grid, {width, width, 1});
  Cuts cuts(mesh);
  Parts parts(mesh);
  std::vector<LinkId> around;  // a square of 10 x 10 in a corner
  for (std::uint32_t i = 0; i < 10; ++i) {
    around.push_back(above(*mesh, i, 9));
    around.push_back(right_of(*mesh, 9, i));
  }
  parts.cut(cuts, around);
  QCOMPARE(parts.count(), 2U);
  // Its 100 elements, and as many turns of searches in the rest, each of which reaches two or three at most.
  QVERIFY2(parts.looked_at() < 400, qPrintable(QString::number(parts.looked_at())));
  parts.uncut(cuts, around);
  QCOMPARE(parts.count(), 1U);
  QVERIFY(parts.looked_at() < 400);
}

CHAINMAIL_TEST(PartsTest)

}  // namespace chainmail::test_parts

#include "test_parts.moc"
