#include <QtTest>

#include "core/scenarios.h"
#include "program.h"

namespace chainmail::test_replay {

using namespace chainmail::test;

namespace {

/// Events of a drag besides moves of the handle.
enum class Event { move, move_back, other_hand, cut, uncut, pin, unpin, soften, reset, count };

/// One solver that continues, compared for each pass with a new solver that knows nothing of earlier passes.
class Drag {
 public:
  Drag(MeshPointer mesh, Algorithm algorithm, Precision precision)
      : mesh_(std::move(mesh)),
        algorithm_(algorithm),
        precision_(precision),
        solver_(std::make_unique<Deformer>(mesh_, algorithm, precision)) {}

  void happen(Event event, std::uint32_t which, const Point& by) {
    const auto link = one_link(*mesh_, which);
    const ElementId element = which % mesh_->element_count();
    switch (event) {
      case Event::cut:
        return solver_->body().cut(link);
      case Event::uncut:
        return solver_->body().uncut(link);
      case Event::pin:
        return element == hand_ ? solver_->body().reset() : solver_->body().pin(std::span(&element, 1));
      case Event::unpin:
        return solver_->body().unpin(std::span(&element, 1));
      case Event::soften:
        softness_.global.stretch = 1 + which % 8 / 4.0;
        return solver_->body().set_softness(softness_);
      case Event::reset:
        return solver_->body().reset();
      case Event::other_hand:
        hand_ = std::ranges::binary_search(solver_->body().pins(), element) ? hand_ : element;
        break;
      default:
        break;
    }
    move(event == Event::move_back ? mesh_->rest_position(hand_) : position_of(*solver_, *mesh_, hand_) + by);
  }

 private:
  void move(const Point& target) {
    const auto fresh = std::make_unique<Deformer>(mesh_, algorithm_, precision_);
    fresh->body().set_softness(softness_);
    fresh->body().cut(solver_->body().cuts().links());
    fresh->body().pin(solver_->body().pins());
    fresh->body().set_positions(positions_of(*solver_, *mesh_));
    Trace expected, trace;
    const PassCount of_fresh = fresh->move(hand_, target, &expected);
    const PassCount count = solver_->move(hand_, target, &trace);
    RC_ASSERT(trace == expected);
    RC_ASSERT(count.checked == of_fresh.checked);
    RC_ASSERT(count.moved == of_fresh.moved);
    const auto moved = solver_->moved(), moved_fresh = fresh->moved();
    RC_ASSERT(std::equal(moved.begin(), moved.end(), moved_fresh.begin(), moved_fresh.end()));
    RC_ASSERT(same_bits(positions_of(*solver_, *mesh_), positions_of(*fresh, *mesh_)));
  }

  MeshPointer mesh_;
  Algorithm algorithm_;
  Precision precision_;
  std::unique_ptr<Deformer> solver_;
  Softness softness_;
  ElementId hand_ = 0;
};

}  // namespace

/// Passes of a drag reuse what the last pass recorded. The result is the same, bit for bit.
class ReplayTest : public QObject {
  Q_OBJECT

 private slots:
  void a_drag_goes_as_without_memory();
  void an_algorithm_finds_nothing_of_another();
};

void ReplayTest::a_drag_goes_as_without_memory() {
  const auto holds = [] {
    const auto& mesh = draw_family().mesh;
    std::vector<AlgorithmInfo> all = algorithms_for(*mesh);
    // Exact stores displacements from rest, so another solver cannot receive them to the bit.
    std::erase_if(all, [](const AlgorithmInfo& one) { return one.algorithm == Algorithm::exact; });
    Drag drag(mesh, (*rc::gen::elementOf(all)).algorithm, *any_precision());
    const int events = *rc::gen::inRange(1, 40);
    for (int i = 0; i < events; ++i) {
      // Most events are moves: some so large that all elements follow, others so small that few do.
      const int drawn = *rc::gen::inRange(0, 3 * int(Event::count));
      const int reach = *rc::gen::element(1, 4, 400);
      drag.happen(drawn < int(Event::count) ? Event(drawn) : Event::move, *rc::gen::inRange<std::uint32_t>(0, 1000),
                  (*any_drag_step(reach)).by());
    }
  };
  QVERIFY(check_property("each pass is that of a solver that saw nothing before", holds));
}

void ReplayTest::an_algorithm_finds_nothing_of_another() {
  const auto mesh = make_mesh(MeshKind::grid, {9, 9, 1});
  const auto one = std::make_unique<Deformer>(mesh, Algorithm::natural_queue, Precision::double_precision);
  const auto other = std::make_unique<Deformer>(mesh, Algorithm::natural_queue, Precision::double_precision);
  const auto both = [&](int x) {
    one->move(0, Point(x, x, 0));
    other->move(0, Point(x, x, 0));
  };
  both(-20);
  both(20);
  // In between, one of the solvers changes to other algorithms, without a move.
  for (const AlgorithmInfo& info : algorithms_for(*mesh)) {
    one->set_algorithm(info.algorithm);
    if (info.algorithm != Algorithm::exact) {
      one->move(40, position_of(*one, *mesh, 40));
    }
    one->set_algorithm(Algorithm::natural_queue);
    both(info.algorithm == Algorithm::generalized ? -20 : 21);
    QVERIFY(same_bits(positions_of(*one, *mesh), positions_of(*other, *mesh)));
    QCOMPARE(one->moved().size(), other->moved().size());
  }
}

CHAINMAIL_TEST(ReplayTest)

}  // namespace chainmail::test_replay

#include "test_replay.moc"
