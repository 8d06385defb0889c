#include <QtTest>
#include <algorithm>
#include <functional>
#include <memory>

#include "core/support.h"
#include "mesh/error.h"
#include "program.h"
#include "solver/custom_method.h"

namespace chainmail::test_custom_method {

using namespace chainmail::test;

namespace {

/// Natural Queue ChainMail, written for MovingBody.
class OwnQueue : public CustomMethod {
 public:
  std::uint64_t answer(MovingBody& body, const MovedHandle& handle) override {
    std::vector<bool> is_queued(body.mesh().element_count(), false);
    std::vector<ElementId> queue(handle.elements.begin(), handle.elements.end());
    std::uint64_t checked = 0;
    for (std::size_t i = 0; i < queue.size(); ++i) {
      const auto found = body.neighbours(queue[i]);
      const std::vector<ElementId> neighbours(found.begin(), found.end());
      for (const ElementId element : neighbours) {
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
  virtual bool step(MovingBody& body, ElementId element, ElementId sponsor) { return body.clamp(element, sponsor); }
};

/// The same, with the box of the valid region.
class BoxQueue : public OwnQueue {
  bool step(MovingBody& body, ElementId element, ElementId sponsor) override {
    const Box box = body.valid_region(sponsor, element);
    const Point before = body.position(element), after = before.cwiseMax(box.low).cwiseMin(box.high);
    body.set_position(element, after);
    return before != after;
  }
};

/// Moves elements, then fails in a way that the test chooses.
class Failing : public CustomMethod {
 public:
  explicit Failing(std::function<void(MovingBody&)> fail) : fail_(std::move(fail)) {}
  std::uint64_t answer(MovingBody& body, const MovedHandle& /*handle*/) override {
    body.set_position(8, {7, 7, 0});
    body.set_position(7, {1, 2.5, 0});
    fail_(body);
    return 1;
  }

 private:
  std::function<void(MovingBody&)> fail_;
};

/// Adds a method under a new name.
Algorithm added(std::function<std::unique_ptr<Method>()> make) {
  static int count = 0;
  return register_method({.name = "mine-" + std::to_string(++count)}, std::move(make));
}

}  // namespace

/// Methods of a program: they move elements as the built-in ones do, and a failed one changes nothing.
class CustomMethodTest : public QObject {
  Q_OBJECT

 private slots:
  void an_own_queue_is_natural_queue();
  void a_failure_changes_nothing();
  void bad_descriptions_are_refused();
};

void CustomMethodTest::an_own_queue_is_natural_queue() {
  const Algorithm by_clamp = added([] { return std::make_unique<OwnQueue>(); });
  const Algorithm by_box = added([] { return std::make_unique<BoxQueue>(); });
  const MeshPointer mesh = make_mesh(MeshKind::cloth, {9, 7, 1});
  for (const Precision precision : precisions) {
    Deformer expected(mesh, Algorithm::natural_queue, precision);
    expected.pin(std::vector<ElementId>{62});
    for (const Algorithm algorithm : {by_clamp, by_box}) {
      Deformer own(mesh, algorithm, precision);
      own.pin(std::vector<ElementId>{62});
      for (const Point& target : {Point(-3, -2, 0), Point(-5, -1, 0), Point(4, 4, 0)}) {
        const PassCount count = own.move(0, target);
        QVERIFY(count.moved > 0 && own.moved().size() == count.moved);
        expected.move(0, target);
        QVERIFY(same_bits(positions_of(own, *mesh), positions_of(expected, *mesh)));
      }
      expected.reset();
    }
  }
}

void CustomMethodTest::a_failure_changes_nothing() {
  const MeshPointer mesh = make_mesh(MeshKind::grid, {3, 3, 1});
  const auto fails = [&](const std::function<void(MovingBody&)>& fail) {
    Deformer own(mesh, added([&] { return std::make_unique<Failing>(fail); }));
    own.pin(std::vector<ElementId>{2});
    const std::vector<double> before = positions_of(own, *mesh);
    try {
      own.move(0, {-1, 0, 0});
    } catch (const std::exception&) {
      return same_bits(positions_of(own, *mesh), before) && own.moved().empty();
    }
    return false;
  };
  QVERIFY(fails([](MovingBody&) { throw Error("here", "it fails", "stop"); }));
  QVERIFY(fails([](MovingBody&) { throw std::runtime_error("it fails"); }));
  QVERIFY(fails([](MovingBody& body) { body.position(9); }));
  QVERIFY(fails([](MovingBody& body) { body.set_position(0, {0, 0, 0}); }));  // part of the handle
  QVERIFY(fails([](MovingBody& body) { body.set_position(2, {0, 0, 0}); }));  // pinned
  QVERIFY(fails([](MovingBody& body) { body.set_position(4, {0, 0, 1}); }));  // outside the plane
  QVERIFY(fails([](MovingBody& body) { body.clamp(4, 8); }));                 // not linked
}

void CustomMethodTest::bad_descriptions_are_refused() {
  const auto make = [] { return std::make_unique<OwnQueue>(); };
  for (const char* name : {"", "Exact", "exact", "3d", "nothing", "a b"}) {
    QVERIFY_EXCEPTION_THROWN(register_method({.name = name}, make), Error);
  }
  QVERIFY_EXCEPTION_THROWN(register_method({.name = "no-factory"}, {}), Error);
  const Algorithm none = added([] { return nullptr; });
  Deformer deformer(make_mesh(MeshKind::grid, {3, 3, 1}), none);
  QVERIFY_EXCEPTION_THROWN(deformer.move(0, {-1, 0, 0}), Error);
}

CHAINMAIL_TEST(CustomMethodTest)

}  // namespace chainmail::test_custom_method

#include "test_custom_method.moc"
