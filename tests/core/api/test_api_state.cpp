#include <QtTest>
#include <cstring>

#include "core/api/api_support.h"
#include "program.h"

namespace chainmail::test_api_state {

namespace {

/// A value of another type.
cm::StateValue other_type(const cm::StateValue& value) {
  return std::holds_alternative<std::string>(value) ? cm::StateValue(std::int64_t{1})
                                                    : cm::StateValue(std::string("none"));
}

}  // namespace

/// The public interface: a mesh as values, and what a body stores.
class ApiStateTest : public QObject {
  Q_OBJECT

 private slots:
  void a_mesh_is_loaded_as_it_was();
  void damaged_states_are_refused();
  void positions_are_shown_as_they_are_stored_data();
  void positions_are_shown_as_they_are_stored();
  void other_stored_numbers_are_refused();
  void links_get_their_own_softness_at_once();
  void the_table_of_softness_is_that_of_the_struct();
};

void ApiStateTest::a_mesh_is_loaded_as_it_was() {
  const cm::Mesh mesh = organ();
  const cm::Mesh again = cm::load_mesh(cm::save(mesh));
  QVERIFY(!(again == mesh) && again.identity() != mesh.identity());
  QVERIFY(std::ranges::equal(again.links(), mesh.links()) && std::ranges::equal(again.tetrahedra(), mesh.tetrahedra()));
  QVERIFY(again.rest_positions() == mesh.rest_positions() && again.lattice() == mesh.lattice());
}

/// A part that is missing or of another type is named.
void ApiStateTest::damaged_states_are_refused() {
  const cm::State state = cm::save(organ());
  QVERIFY(!state.empty());
  for (const auto& [name, value] : state) {
    cm::State damaged = state;
    damaged[name] = other_type(value);
    QVERIFY2(has(refusal_of([&] { cm::load_mesh(damaged); }), "'" + name + "' is missing or damaged"), name.c_str());
    damaged.erase(name);
    QVERIFY2(has(refusal_of([&] { cm::load_mesh(damaged); }), "'" + name + "' is missing or damaged"), name.c_str());
  }
}

void ApiStateTest::positions_are_shown_as_they_are_stored_data() {
  QTest::addColumn<cm::Mesh>("mesh");
  QTest::addColumn<bool>("is_single");
  for (const bool is_single : {false, true}) {
    const QByteArray in = is_single ? " in float" : " in double";
    QTest::newRow("line" + in) << cm::make_line(5) << is_single;
    QTest::newRow("plane" + in) << cm::make_grid(4, 3) << is_single;
    QTest::newRow("cloth in space" + in) << cm::make_cloth(4, 3, {.space_dimension = 3}) << is_single;
    QTest::newRow("volume" + in) << organ() << is_single;
  }
}

void ApiStateTest::positions_are_shown_as_they_are_stored() {
  QFETCH(cm::Mesh, mesh);
  QFETCH(bool, is_single);
  const auto precision = is_single ? cm::Precision::single_precision : cm::Precision::double_precision;
  cm::Deformer deformer(mesh, "natural-queue", precision);
  const cm::StoredPositions stored = deformer.body().stored_positions();
  deformer.move(0, {-3.25, 0, 0});  // they show this
  QVERIFY(deformer.body().keeps_stored_positions("generalized"));
  deformer.set_method("generalized");
  deformer.move(1, {-1.5, 0, 0});
  QCOMPARE(stored.precision, precision);
  const std::string axes = mesh.axes();
  QCOMPARE(std::size_t(stored.columns), axes.size());
  const std::vector<double> positions = deformer.body().positions();
  std::vector<double> copied(positions.size());
  deformer.body().copy_positions(copied);
  QVERIFY(same_numbers(copied, positions));
  for (cm::ElementId e = 0; e < mesh.element_count(); ++e) {
    const char* row = static_cast<const char*>(stored.first) + e * stored.stride;
    for (int k = 0; k < stored.columns; ++k) {
      float single = 0;
      double number = 0;
      std::memcpy(is_single ? static_cast<void*>(&single) : &number, row + std::size_t(k) * (is_single ? 4 : 8),
                  is_single ? 4 : 8);
      QCOMPARE(is_single ? double(single) : number, positions[3 * e + std::size_t(axes[std::size_t(k)] - 'x')]);
    }
  }
}

void ApiStateTest::other_stored_numbers_are_refused() {
  cm::Deformer deformer(organ(), "exact");
  QVERIFY(has(refusal_of([&] { deformer.body().stored_positions(); }), "displacements from rest"));
  QVERIFY(deformer.body().keeps_stored_positions("exact") && !deformer.body().keeps_stored_positions("natural-queue"));
  cm::Body turned(organ());
  QVERIFY(turned.keeps_stored_positions("fem"));
  turned.set_frame({{0, 0, 1}, 30});
  QVERIFY(has(refusal_of([&] { turned.stored_positions(); }), "along turned axes"));
  QVERIFY(!turned.keeps_stored_positions("fem"));  // it works along the axes of the world
  QVERIFY(has(refusal_of([&] { turned.keeps_stored_positions("magic"); }), "there is no such method"));
}

void ApiStateTest::links_get_their_own_softness_at_once() {
  cm::Body body(organ()), other(organ());
  for (cm::Body* one : {&body, &other}) {
    one->set_softness({1, 7}, {0.5, 1.5, 0.2, 1, 1, -1});
  }
  const std::vector<cm::LinkId> links{7, 2, 9};
  const std::vector<cm::LinkSoftness> softness{{0.1, 1.1, 0, 1, 1, 0}, {0.2, 1.2, 0, 1, 2, 0}, {0.1, 1.1, 0, 1, 1, 0}};
  body.set_link_softness(links, softness);
  for (std::size_t i = 0; i < links.size(); ++i) {
    other.set_softness({links[i]}, softness[i]);
  }
  QVERIFY(State(body) == State(other));
  QVERIFY(body.link_softness() == State(body).softness_of_links);
  const State before(body);
  const auto refused = [&](const std::vector<cm::LinkId>& ids, const std::vector<cm::LinkSoftness>& given) {
    return refusal_of([&] { body.set_link_softness(ids, given); });
  };
  QVERIFY(has(refused({1, 2}, {softness[0]}), "there are 1 for 2 links"));
  QVERIFY(has(refused({1, 1}, {softness[0], softness[1]}), "link 1: it is given twice"));
  QVERIFY(has(refused({1, 2}, {softness[0], {.stretch = 0.5}}), "link 2, "));
  QVERIFY(has(refused({1, 100000}, {softness[0], softness[1]}), "link 100000"));
  QVERIFY(State(body) == before);
}

void ApiStateTest::the_table_of_softness_is_that_of_the_struct() {
  cm::LinkSoftness marked;
  double next = 1;
  for (const cm::SoftnessNumber& one : cm::softness_numbers()) {
    marked.*one.value = next++;
    QVERIFY(!one.name.empty() && !one.help.empty() && one.lowest < one.highest);
  }
  QVERIFY((marked == cm::LinkSoftness{1, 2, 3, 4, 5, 6}));
  QVERIFY(cm::softness_numbers()[0].name == "compression" && cm::softness_numbers()[5].name == "exponent");
}

CHAINMAIL_TEST(ApiStateTest)

}  // namespace chainmail::test_api_state

#include "test_api_state.moc"
