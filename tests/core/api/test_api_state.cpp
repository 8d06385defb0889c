#include <QtTest>
#include <cstring>

#include "core/api/api_support.h"
#include "program.h"

namespace chainmail::test_api_state {

namespace {

/// A body in which nothing has its standard value.
cm::Body changed_body(cm::Precision precision = cm::Precision::double_precision) {
  cm::Body body(organ(), precision);
  body.set_softness({0.7, 1.3, 0.2, 0.5, 2, -0.5});
  body.set_softness({3, 5}, {0.6, 1.4, 0.3, 0.4, 3, 1});
  body.set_energy(cm::EnergyKind::axial);
  body.set_elasticity({2, 0.4, {3, 4, 5}, 70, cm::StrainLaw::gent, 1.5, 0.25, 0.02});
  body.set_frame({{1, 2, 3}, 25});
  body.cut({4, 11});
  body.pin(body.mesh().side("right"));
  return body;
}

cm::Deformer moved_deformer(const std::string& method) {
  cm::Deformer deformer(changed_body(), method);
  if (cm::method_info(method).family == cm::MethodFamily::elastic) {
    deformer.body().uncut(deformer.body().cuts());
  }
  deformer.set_tracing(true);
  deformer.move(0, {-0.3, 0.2, 0.1});
  deformer.relax(1, {.scheme = cm::RelaxationScheme::link});
  return deformer;
}

/// A value of another type.
cm::StateValue other_type(const cm::StateValue& value) {
  return std::holds_alternative<std::string>(value) ? cm::StateValue(true) : cm::StateValue(std::string("none"));
}

/// Checks that a state is refused, with the name of the part, if a part is missing or of another type.
template <class Load>
void check_parts(const cm::State& state, Load load) {
  load(state);
  QVERIFY(!state.empty());
  for (const auto& [name, value] : state) {
    cm::State damaged = state;
    damaged[name] = other_type(value);
    QVERIFY2(has(refusal_of([&] { load(damaged); }), "'" + name + "' is missing or damaged"), name.c_str());
    damaged.erase(name);
    QVERIFY2(has(refusal_of([&] { load(damaged); }), "'" + name + "' is missing or damaged"), name.c_str());
  }
}

}  // namespace

/// The public interface: objects as values, for checkpoints and other processes.
class ApiStateTest : public QObject {
  Q_OBJECT

 private slots:
  void objects_are_loaded_as_they_were();
  void deformers_continue_bit_for_bit_data();
  void deformers_continue_bit_for_bit();
  void relaxation_goes_on_where_it_has_spread_to();
  void damaged_states_are_refused();
  void whole_numbers_are_real_numbers();
  void positions_are_shown_as_they_are_stored_data();
  void positions_are_shown_as_they_are_stored();
  void other_stored_numbers_are_refused();
  void links_get_their_own_softness_at_once();
  void the_table_of_softness_is_that_of_the_struct();
};

void ApiStateTest::objects_are_loaded_as_they_were() {
  const cm::Mesh mesh = organ();
  const cm::Mesh again = cm::load_mesh(cm::save(mesh));
  QVERIFY(!(again == mesh) && again.identity() != mesh.identity());
  QVERIFY(std::ranges::equal(again.links(), mesh.links()) && std::ranges::equal(again.tetrahedra(), mesh.tetrahedra()));
  QVERIFY(again.rest_positions() == mesh.rest_positions() && again.lattice() == mesh.lattice());
  for (const auto precision : {cm::Precision::double_precision, cm::Precision::single_precision}) {
    cm::Deformer deformer(changed_body(precision), "natural-queue");
    deformer.move(0, {-0.3, 0.2, 0.1});
    const cm::Body& body = deformer.body();
    const cm::Body loaded = cm::load_body(body.mesh(), cm::save(body));
    QVERIFY(State(loaded) == State(body));
    QCOMPARE(loaded.precision(), precision);
    QVERIFY(cm::load_snapshot(body.mesh(), cm::save(body.snapshot())) == body.snapshot());
    cm::Handle handle = deformer.grab({0, 1});
    deformer.move(handle, handle.after({{0.1, 0.2, 0}, {{0, 0, 1}, 20}}));
    const cm::Handle held = cm::load_handle(body.mesh(), cm::save(handle));
    QVERIFY(std::ranges::equal(held.elements(), handle.elements()));
    QVERIFY(held.pose() == handle.pose() && held.grabbed() == handle.grabbed() && held.mesh() == body.mesh());
  }
}

void ApiStateTest::deformers_continue_bit_for_bit_data() {
  QTest::addColumn<QString>("method");
  for (const char* name : {"natural-queue", "generalized", "exact", "fem", "neo-hookean", "xpbd", "neo-hookean-xpbd"}) {
    QTest::newRow(name) << name;
  }
}

void ApiStateTest::deformers_continue_bit_for_bit() {
  QFETCH(QString, method);
  cm::Deformer deformer = moved_deformer(method.toStdString());
  const cm::State state = cm::save(deformer);
  cm::Deformer again(deformer.body(), method.toStdString());
  cm::load(again, state);
  QVERIFY(std::ranges::equal(again.moved(), deformer.moved()));
  QCOMPARE(again.trace().size(), deformer.trace().size());
  for (const double step : {0.4, -0.2}) {
    deformer.move(0, {-0.3, step, 0.1});
    again.move(0, {-0.3, step, 0.1});
    QVERIFY(same_numbers(again.body().positions(), deformer.body().positions()));
    QCOMPARE(again.relax(3), deformer.relax(3));
    QVERIFY(same_numbers(again.body().positions(), deformer.body().positions()));
  }
  cm::Deformer other(deformer.body(), method == "exact" ? "generalized" : "exact");
  QVERIFY(has(refusal_of([&] { cm::load(other, state); }), "of the method '" + method.toStdString() + "'"));
}

/// The elements that wait for the next sweep are neither those that the last pass moved nor their neighbours.
void ApiStateTest::relaxation_goes_on_where_it_has_spread_to() {
  cm::Deformer deformer(cm::make_grid(20, 20), "natural-queue");
  deformer.move(210, {10.7, 10.6, 0});     // from 10, 10
  QVERIFY(deformer.moved().size() < 100);  // of 400
  QCOMPARE(deformer.relax(5), 5);
  cm::Deformer again(deformer.body(), "natural-queue");
  cm::load(again, cm::save(deformer));
  const std::vector<double> before = deformer.body().positions();
  QCOMPARE(again.relax(3), deformer.relax(3));
  QVERIFY(same_numbers(again.body().positions(), deformer.body().positions()));
  QVERIFY(!same_numbers(before, deformer.body().positions()));
}

void ApiStateTest::damaged_states_are_refused() {
  cm::Deformer deformer = moved_deformer("natural-queue");
  const cm::Mesh mesh = deformer.body().mesh();
  check_parts(cm::save(mesh), [](const cm::State& state) { cm::load_mesh(state); });
  check_parts(cm::save(deformer.body()), [&](const cm::State& state) { cm::load_body(mesh, state); });
  check_parts(cm::save(deformer.body().snapshot()), [&](const cm::State& state) { cm::load_snapshot(mesh, state); });
  check_parts(cm::save(deformer.grab({0, 1})), [&](const cm::State& state) { cm::load_handle(mesh, state); });
  cm::Deformer again(deformer.body(), "natural-queue");
  check_parts(cm::save(deformer), [&](const cm::State& state) { cm::load(again, state); });
}

void ApiStateTest::whole_numbers_are_real_numbers() {
  const cm::Mesh mesh = cm::make_grid(3, 3);
  cm::State state = cm::save(mesh);
  state["spacing"] = std::int64_t{1};
  state["rest"] =
      std::vector<std::uint32_t>{0, 0, 0, 1, 0, 0, 2, 0, 0, 0, 1, 0, 1, 1, 0, 2, 1, 0, 0, 2, 0, 1, 2, 0, 2, 2, 0};
  QVERIFY(cm::load_mesh(state).rest_positions() == mesh.rest_positions());
  state["neighbours"] = std::vector<double>{0, 1};
  QVERIFY(has(refusal_of([&] { cm::load_mesh(state); }), "'neighbours' is missing or damaged"));
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
