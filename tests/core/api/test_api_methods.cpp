#include <QtTest>
#include <algorithm>

#include "core/api/api_support.h"
#include "program.h"

namespace chainmail::test_api_methods {

namespace {

/// Natural Queue ChainMail, written for the public interface.
class OwnQueue : public cm::Method {
 public:
  std::uint64_t move(cm::MovingBody& body, const cm::HandleMove& move) override {
    std::vector<bool> is_queued(body.mesh().element_count(), false);
    std::vector<cm::ElementId> queue(move.elements.begin(), move.elements.end());
    std::uint64_t checked = 0;
    for (std::size_t i = 0; i < queue.size(); ++i) {
      const auto found = body.neighbours(queue[i]);
      const std::vector<cm::ElementId> neighbours(found.begin(), found.end());
      for (const cm::ElementId element : neighbours) {
        if (!body.is_fixed(element) && !is_queued[element]) {
          is_queued[element] = true;
          ++checked;
          if (step(body, element, queue[i])) {
            queue.push_back(element);
          }
        }
      }
    }
    return checked;
  }

 protected:
  virtual bool step(cm::MovingBody& body, cm::ElementId element, cm::ElementId sponsor) {
    return body.clamp(element, sponsor);
  }
};

/// The same, with the box of the valid region.
class BoxQueue : public OwnQueue {
  bool step(cm::MovingBody& body, cm::ElementId element, cm::ElementId sponsor) override {
    const cm::Box box = body.valid_region(sponsor, element);
    const cm::Vector3 before = body.position(element);
    const cm::Vector3 after{std::clamp(before.x, box.low.x, box.high.x), std::clamp(before.y, box.low.y, box.high.y),
                            std::clamp(before.z, box.low.z, box.high.z)};
    body.set_position(element, after);
    return before != after;
  }
};

/// Moves elements, then fails in a way that the test chooses.
class Failing : public cm::Method {
 public:
  explicit Failing(std::function<void(cm::MovingBody&)> fail) : fail_(std::move(fail)) {}
  std::uint64_t move(cm::MovingBody& body, const cm::HandleMove&) override {
    body.set_position(8, {7, 7, 0});
    body.set_position(7, {1, 2.5, 0});
    body.set_position(7, {1, 3, 0});
    fail_(body);
    return 2;
  }

 private:
  std::function<void(cm::MovingBody&)> fail_;
};

bool is_known(const std::string& name) {
  const auto all = cm::methods();
  return std::ranges::any_of(all, [&](const cm::MethodInfo& one) { return one.name == name; });
}

void register_own_methods() {
  if (!is_known("own-queue")) {
    cm::register_method(
        {.name = "own-queue", .label = "Own queue", .source = "a test", .summary = "like Natural Queue"},
        [] { return std::make_unique<OwnQueue>(); });
    cm::register_method({.name = "own-boxes"}, [] { return std::make_unique<BoxQueue>(); });
  }
}

}  // namespace

/// The public interface: methods of a user's own.
class ApiMethodsTest : public QObject {
  Q_OBJECT

 private slots:
  void an_own_method_is_listed_and_moves();
  void an_own_method_is_compared();
  void an_own_method_that_throws_moves_nothing();
  void an_own_method_cannot_move_what_is_fixed();
  void bad_registrations_are_refused();
};

void ApiMethodsTest::an_own_method_is_listed_and_moves() {
  register_own_methods();
  const cm::MethodInfo own = cm::method_info("own-queue");
  QCOMPARE(own.label, std::string("Own queue"));
  QCOMPARE(own.source, std::string("a test"));
  QVERIFY(own.is_registered && own.family == cm::MethodFamily::chainmail);
  QCOMPARE(cm::method_info("own-boxes").label, std::string("own-boxes"));
  for (const cm::Precision precision : {cm::Precision::single_precision, cm::Precision::double_precision}) {
    for (const cm::Mesh& mesh : {cm::make_line(9), cm::make_cloth(7, 7), organ()}) {
      cm::Body body(mesh, precision);
      body.pin({mesh.element_count() - 1});
      body.cut({2});
      cm::Deformer expected(body, "natural-queue"), queue(body, "own-queue"), boxes(body, "own-boxes");
      for (const double by : {-0.3, -3.0, -1.0}) {
        const auto result = expected.move(1, mesh.rest_position(1) + cm::Vector3{by, 0, 0});
        for (cm::Deformer* own_one : {&queue, &boxes}) {
          QCOMPARE(own_one->move(1, mesh.rest_position(1) + cm::Vector3{by, 0, 0}).moved, result.moved);
          QVERIFY(same_numbers(own_one->body().positions(), expected.body().positions()));
          QVERIFY(std::ranges::equal(own_one->moved(), expected.moved()));
        }
      }
      QCOMPARE(queue.relax(2), expected.relax(2));
      QVERIFY(same_numbers(queue.body().positions(), expected.body().positions()));
    }
  }
  cm::Deformer many(cm::make_grid(6, 6), "own-queue"), expected(cm::make_grid(6, 6), "natural-queue");
  cm::Handle handle = many.grab({0, 1}), same = expected.grab({0, 1});
  many.move(handle, handle.after({{-2, 0, 0}, {{0, 0, 1}, 45}}));
  expected.move(same, same.after({{-2, 0, 0}, {{0, 0, 1}, 45}}));
  QVERIFY(same_numbers(many.body().positions(), expected.body().positions()));
}

void ApiMethodsTest::an_own_method_is_compared() {
  register_own_methods();
  cm::Body body(cm::make_cloth(8, 8));
  body.set_softness({0, 1, 2, 3, 4, 5, 6, 7, 8, 9}, {.compression = 1, .stretch = 1, .shear = 0});
  const cm::Drag drag{.name = "pull", .elements = {63}, .path = {{{4, 2, 0}, {}}}};
  const cm::Comparison comparison =
      cm::compare(body, {drag}, {.methods = {"own-queue", "natural-queue"}, .sweeps = {0, 3}, .repetitions = 1});
  const auto& rows = comparison.rows();
  QCOMPARE(rows.size(), std::size_t(4));
  QCOMPARE(rows[0].label, std::string("Own queue"));
  QCOMPARE(rows[0].refusal, std::string());
  QCOMPARE(rows[0].to_exact->rms, rows[2].to_exact->rms);
  QCOMPARE(rows[1].to_exact->rms, rows[3].to_exact->rms);
  QVERIFY(has(comparison.html(), "Own queue") && has(comparison.json(), "own-queue") &&
          has(comparison.csv(), ",own-queue,0,"));
  // Without a list of methods, all of the family take part.
  const auto all = cm::compare(body, {drag}, {.repetitions = 1}).rows();
  QVERIFY(std::ranges::count(all, "own-queue", &cm::ComparisonRow::method) == 1);
  body.pin(body.mesh().side("left"));
  const auto found = cm::calibrate(body, {.method = "own-queue", .drags = 1, .held_out = 1, .evaluations = 5});
  const auto expected = cm::calibrate(body, {.method = "natural-queue", .drags = 1, .held_out = 1, .evaluations = 5});
  QCOMPARE(found.softness, expected.softness);
}

void ApiMethodsTest::an_own_method_that_throws_moves_nothing() {
  static std::function<void(cm::MovingBody&)> fail;
  if (!is_known("failing")) {
    cm::register_method({.name = "failing"},
                        [] { return std::make_unique<Failing>([](cm::MovingBody& body) { fail(body); }); });
  }
  for (const cm::Precision precision : {cm::Precision::single_precision, cm::Precision::double_precision}) {
    cm::Deformer deformer(cm::make_grid(3, 3), "failing", precision);
    fail = [](cm::MovingBody&) {};
    QCOMPARE(deformer.move(0, {-1.1, 0, 0}).moved, std::uint64_t(2));
    QVERIFY(std::ranges::equal(deformer.moved(), std::vector<cm::ElementId>{8, 7}));
    QVERIFY((deformer.body().position(7) == cm::Vector3{1, 3, 0}));
    deformer.body().set_positions(deformer.body().mesh().rest_positions());
    const State before(deformer.body());
    fail = [](cm::MovingBody&) { throw cm::Error("mine", "it fails", "do not use it"); };
    QCOMPARE(refusal_of([&] { deformer.move(0, {-3, 0, 0}); }), std::string("mine: it fails; do not use it"));
    QVERIFY(State(deformer.body()) == before && deformer.moved().empty());
    fail = [](cm::MovingBody&) { throw std::logic_error("another kind"); };
    QVERIFY_EXCEPTION_THROWN(deformer.move(0, {-3, 0, 0}), std::logic_error);
    QVERIFY(State(deformer.body()) == before);
    fail = [](cm::MovingBody&) { throw cm::Cancelled(); };
    QVERIFY_EXCEPTION_THROWN(deformer.move(0, {-3, 0, 0}), cm::Cancelled);
    QVERIFY(State(deformer.body()) == before);
  }
  fail = [](cm::MovingBody&) { throw cm::Error("mine", "it fails", "do not use it"); };
  const auto rows = cm::compare(cm::Body(cm::make_grid(3, 3)), {{"d", {0}, {{{-1, 0, 0}, {}}}}},
                                {.methods = {"failing"}, .repetitions = 1})
                        .rows();
  QCOMPARE(rows.at(0).refusal, std::string("mine: it fails; do not use it"));
}

void ApiMethodsTest::an_own_method_cannot_move_what_is_fixed() {
  static std::function<void(cm::MovingBody&)> act;
  if (!is_known("acting")) {
    cm::register_method({.name = "acting"},
                        [] { return std::make_unique<Failing>([](cm::MovingBody& body) { act(body); }); });
  }
  cm::Deformer deformer(cm::make_grid(3, 3), "acting", cm::Precision::single_precision);
  deformer.body().pin({4});
  deformer.body().cut(7, 8);
  const State before(deformer.body());
  const auto refused = [&](std::function<void(cm::MovingBody&)> what, const std::string& reason) {
    act = std::move(what);
    const std::string refusal = refusal_of([&] { deformer.move(0, {-1, 0, 0}); });
    QVERIFY2(has(refusal, reason), refusal.c_str());
    QVERIFY(State(deformer.body()) == before);
  };
  refused([](cm::MovingBody& body) { body.set_position(0, {}); }, "it is part of the handle");
  refused([](cm::MovingBody& body) { body.set_position(4, {}); }, "it is pinned");
  refused([](cm::MovingBody& body) { body.set_position(9, {}); }, "element 9");
  refused([](cm::MovingBody& body) { body.set_position(1, {no_number, 0, 0}); }, "not a finite number");
  refused([](cm::MovingBody& body) { body.set_position(1, {1e38, 0, 0}); }, "out of the range");
  refused([](cm::MovingBody& body) { body.set_position(1, {0, 0, 1}); }, "does not extend along z");
  refused([](cm::MovingBody& body) { body.clamp(4, 1); }, "it is pinned");
  refused([](cm::MovingBody& body) { body.clamp(0, 1); }, "it is part of the handle");
  refused([](cm::MovingBody& body) { body.clamp(8, 0); }, "they are not linked");
  refused([](cm::MovingBody& body) { body.clamp(8, 7); }, "the link is cut");
  refused([](cm::MovingBody& body) { (void)body.valid_region(9, 1); }, "element 9");
  refused([](cm::MovingBody& body) { body.neighbours(9); }, "element 9");
  refused([](cm::MovingBody& body) { (void)body.is_fixed(9); }, "element 9");
  refused([](cm::MovingBody& body) { (void)body.position(9); }, "element 9");
  act = [](cm::MovingBody& body) {
    QVERIFY(body.is_fixed(0) && body.is_fixed(4) && !body.is_fixed(1));
    QVERIFY(std::ranges::equal(body.neighbours(8), std::vector<cm::ElementId>{5}));
    QCOMPARE(body.mesh().element_count(), 9u);
  };
  deformer.move(0, {-1, 0, 0});
}

void ApiMethodsTest::bad_registrations_are_refused() {
  const std::size_t before = cm::methods().size();
  const auto make = [] { return std::make_unique<OwnQueue>(); };
  for (const char* name : {"", "Upper", "with space", "exact", "original", "3d", "nothing", "a,b"}) {
    QVERIFY2(!refusal_of([&] { cm::register_method({.name = name}, make); }).empty(), name);
  }
  QVERIFY(has(refusal_of([] { cm::register_method({.name = "empty"}, {}); }), "there is no factory"));
  QCOMPARE(cm::methods().size(), before);
  cm::register_method({.name = "null", .label = "two\nlines"}, [] { return std::unique_ptr<cm::Method>(); });
  QVERIFY(!has(cm::method_info("null").label, "\n"));
  QVERIFY(has(refusal_of([&] { cm::register_method({.name = "null"}, make); }), "there is a method with this name"));
  cm::Deformer deformer(cm::make_grid(2, 2), "null");
  QVERIFY(has(refusal_of([&] { deformer.move(0, {-1, 0, 0}); }), "its factory made none"));
}

CHAINMAIL_TEST(ApiMethodsTest)

}  // namespace chainmail::test_api_methods

#include "test_api_methods.moc"
