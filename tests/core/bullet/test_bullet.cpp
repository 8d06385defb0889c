#include <QtTest>
#include <cmath>

#include "bullet/soft_body.h"
#include "core/pinned.h"
#include "core/scenarios.h"

using namespace chainmail;
using namespace chainmail::test;

/// Bullet's soft body as a method. Its answers are compared with what its way to correct links implies.
class BulletTest : public QObject {
  Q_OBJECT

 private slots:
  void a_taut_chain_has_the_lengths_that_cancel_data();
  void a_taut_chain_has_the_lengths_that_cancel();
  void two_taut_links_have_the_lengths_of_bullets_formula();
  void the_answer_is_repeated_bit_for_bit();
  void pins_and_handle_are_exactly_in_place_data();
  void pins_and_handle_are_exactly_in_place();
  void a_handle_of_many_turns_as_a_rigid_body();
  void each_move_is_that_of_a_new_solver();
  void cut_links_are_not_followed();
  void the_limit_of_iterations_is_told();
  void a_cancelled_move_moves_nothing();
  void a_target_out_of_range_moves_nothing();
};

namespace {

Algorithm bullet() {
  static const Algorithm added = add_algorithm(bullet_soft_body());
  return added;
}

/// A solver that runs as many frames as it needs.
Deformer patient(const MeshPointer& mesh, const std::vector<ElementId>& pins,
                 Precision precision = Precision::double_precision) {
  Deformer solver(mesh, bullet(), precision);
  ElasticOptions options;
  options.iterations = 100'000;
  solver.body().set_elastic(options);
  solver.body().pin(pins);
  return solver;
}

std::vector<ElementId> first_column(const Mesh& mesh) {
  std::vector<ElementId> column;
  for (ElementId e = 0; e < mesh.element_count(); ++e) {
    if (mesh.rest_position(e)[0] == mesh.box[0][0]) {
      column.push_back(e);
    }
  }
  return column;
}

std::vector<double> lengths_of(const Deformer& solver, const Mesh& mesh) {
  std::vector<double> lengths;
  for (const auto& [a, b] : mesh.links) {
    lengths.push_back((position_of(solver, mesh, b) - position_of(solver, mesh, a)).norm());
  }
  return lengths;
}

/// True if the numbers are those of a chain whose pairs of neighbours each add 1 to one of the two.
bool each_pair_adds_one(const std::vector<int>& numbers) {
  int from_pair_before = 0;
  for (std::size_t i = 0; i + 1 < numbers.size(); ++i) {
    const int from_next = numbers[i] - from_pair_before;
    if (from_next != 0 && from_next != 1) {
      return false;
    }
    from_pair_before = 1 - from_next;
  }
  return numbers.back() == from_pair_before;
}

std::string rows_of(int space, Precision precision) {
  return std::to_string(space) + "D, " + (precision == Precision::single_precision ? "float" : "double");
}

void add_spaces_and_precisions() {
  QTest::addColumn<int>("space");
  QTest::addColumn<int>("precision");
  for (int space = 1; space <= 3; ++space) {
    for (const Precision precision : precisions) {
      QTest::newRow(rows_of(space, precision).c_str()) << space << int(precision);
    }
  }
}

/// An object with elements on the axes of a space.
MeshPointer object_in(int space) {
  return space == 1   ? make_mesh(MeshKind::line, {9, 1, 1})
         : space == 2 ? make_mesh(MeshKind::cloth, {6, 5, 1})
                      : make_mesh(MeshKind::tetra, {5, 4, 3});
}

Point in_space(Point point, int space) {
  point.tail(3 - space).setZero();
  return point;
}

}  // namespace

void BulletTest::a_taut_chain_has_the_lengths_that_cancel_data() { add_spaces_and_precisions(); }

/// In each frame, a link that is a little too long gets its rest length, and moves its two ends by the same way. At
/// rest, the two ways of an element cancel, so all links move their ends by the same way w. After a link, each of its
/// neighbours that comes later makes it longer by w. So each of the n - 1 pairs of neighbours adds w to one of the two,
/// and w is the excess of the chain over n - 1, whatever the order is.
void BulletTest::a_taut_chain_has_the_lengths_that_cancel() {
  QFETCH(const int, space);
  QFETCH(const int, precision);
  for (const std::uint32_t count : {3U, 4U, 8U}) {
    const MeshPointer mesh = make_mesh(MeshKind::line, {count, 1, 1}, space);
    Deformer solver = patient(mesh, {0}, Precision(precision));
    const double way = 0.004;
    move_by(solver, *mesh, count - 1, Point((count - 2) * way, 0, 0));
    QVERIFY2(solver.remark().empty(), solver.remark().c_str());
    std::vector<int> ways;
    for (const double length : lengths_of(solver, *mesh)) {
      ways.push_back(int(std::lround((length - 1) / way)));
      const double apart = std::abs(length - 1 - ways.back() * way);
      QVERIFY2(apart < 0.1 * way, qPrintable(QString::number(apart / way)));
    }
    QVERIFY(each_pair_adds_one(ways));
  }
}

/// One of the two links comes last. Bullet then sets its length l to 2 l / (1 + l²). The other link has the rest.
void BulletTest::two_taut_links_have_the_lengths_of_bullets_formula() {
  const MeshPointer mesh = make_mesh(MeshKind::line, {3, 1, 1});
  const auto corrected = [](double length) { return 2 * length / (1 + length * length); };
  for (const double whole : {2.2, 3.0, 5.0}) {
    Deformer solver = patient(mesh, {0});
    solver.move(2, Point(whole, 0, 0));
    double last = whole / 2;
    for (int i = 0; i < 1000; ++i) {
      last = corrected(whole - corrected(whole - last));
    }
    const std::vector<double> lengths = lengths_of(solver, *mesh);
    QVERIFY(std::abs(lengths[0] + lengths[1] - whole) < 1e-12);
    QVERIFY(std::min(std::abs(lengths[0] - last), std::abs(lengths[1] - last)) < 1e-4);
  }
}

void BulletTest::the_answer_is_repeated_bit_for_bit() {
  const MeshPointer mesh = make_mesh(MeshKind::cloth, {10, 8, 1});
  std::vector<std::vector<double>> answers;
  for (int turn = 0; turn < 3; ++turn) {
    Deformer solver = patient(mesh, first_column(*mesh));
    for (const Point& by : {Point(0.5, 1, 0), Point(-1, 1, 0)}) {
      move_by(solver, *mesh, 79, by);
    }
    answers.push_back(positions_of(solver, *mesh));
  }
  QVERIFY(same_bits(answers[0], answers[1]) && same_bits(answers[0], answers[2]));
}

void BulletTest::pins_and_handle_are_exactly_in_place_data() { add_spaces_and_precisions(); }

/// Also pins that are away from rest, and numbers that Bullet's single precision does not have.
void BulletTest::pins_and_handle_are_exactly_in_place() {
  QFETCH(const int, space);
  QFETCH(const int, precision);
  const MeshPointer mesh = object_in(space);
  Deformer solver = patient(mesh, {}, Precision(precision));
  const ElementId last = mesh->element_count() - 1, pin = last / 2;
  move_by(solver, *mesh, pin, in_space({0.1, 0.3, 1. / 7}, space));
  std::vector<ElementId> pins = first_column(*mesh);
  pins.push_back(pin);
  solver.body().pin(pins);
  const std::vector<double> before = positions_of(solver, *mesh);
  const Point target = mesh->rest_position(last) + in_space({1. / 3, -0.7, 0.1}, space);
  const PassCount count = solver.move(last, target);
  const std::vector<double> after = positions_of(solver, *mesh);
  const auto n = std::size_t(space);
  const auto stays = [&](ElementId e) {
    return std::equal(before.begin() + std::ptrdiff_t(e * n), before.begin() + std::ptrdiff_t((e + 1) * n),
                      after.begin() + std::ptrdiff_t(e * n));
  };
  std::vector<ElementId> moved;
  for (ElementId e = 0; e < last; ++e) {
    QVERIFY(stays(e) || !solver.body().is_pinned(e));
    if (!stays(e)) {
      moved.push_back(e);
    }
  }
  for (std::size_t k = 0; k < n; ++k) {
    const double exact = target[mesh->axes[k]];
    QCOMPARE(after[last * n + k], Precision(precision) == Precision::single_precision ? double(float(exact)) : exact);
  }
  QVERIFY(std::ranges::equal(solver.moved(), moved));
  QVERIFY(count.moved == moved.size() && !moved.empty());
}

void BulletTest::a_handle_of_many_turns_as_a_rigid_body() {
  const MeshPointer mesh = make_mesh(MeshKind::tetra, {6, 3, 3});
  Deformer solver = patient(mesh, first_column(*mesh));
  std::vector<ElementId> grabbed;
  for (ElementId e = 5; e < mesh->element_count(); e += 6) {
    grabbed.push_back(e);
  }
  Handle handle(solver.body(), grabbed);
  const Pose target{handle.pose().pivot + Point(-0.5, 0.25, 0.5), Point(0.3, 0, 0.2)};
  const RigidMotion motion = handle.motion(target);
  solver.move(handle, target);
  for (std::size_t i = 0; i < grabbed.size(); ++i) {
    QVERIFY(position_of(solver, *mesh, grabbed[i]) == handle.target(i, motion));
    QVERIFY(std::ranges::count(solver.moved(), grabbed[i]) == 0);
  }
  QVERIFY(handle.pose() == target);
}

/// Whatever happened before, nothing out of date is used.
void BulletTest::each_move_is_that_of_a_new_solver() {
  const auto holds = [] {
    const MeshPointer mesh = draw_family().mesh;
    const Precision precision = *any_precision();
    Deformer solver(mesh, bullet(), precision);
    ElasticOptions few;
    few.iterations = 20;
    solver.body().set_elastic(few);
    for (const DragStep& drag_step : *any_drag_steps(4)) {
      Body& body = solver.body();
      const auto link = one_link(*mesh, *rc::gen::inRange<std::uint32_t>(0, 1000));
      const ElementId element = *rc::gen::inRange<ElementId>(0, mesh->element_count());
      switch (*rc::gen::inRange(0, 7)) {
        case 0:
          body.cut(link);
          break;
        case 1:
          body.uncut(link);
          break;
        case 2:
          body.pin(std::span(&element, 1));
          break;
        case 3:
          body.unpin(std::span(&element, 1));
          break;
        case 4:
          body.reset();
          break;
        case 5:
          body.set_positions(mesh->rest);
          break;
        default:
          break;
      }
      if (body.is_pinned(drag_step.of(*mesh))) {
        continue;
      }
      Deformer fresh(mesh, bullet(), precision);
      fresh.body().set_elastic(few);
      fresh.body().set_positions(positions_of(solver, *mesh));
      fresh.body().cut(body.cuts().links());
      fresh.body().pin(body.pins());
      move_by(fresh, *mesh, drag_step.of(*mesh), drag_step.by());
      move_by(solver, *mesh, drag_step.of(*mesh), drag_step.by());
      RC_ASSERT(same_bits(positions_of(solver, *mesh), positions_of(fresh, *mesh)));
      RC_ASSERT(solver.remark() == fresh.remark());
      RC_ASSERT(std::ranges::equal(solver.moved(), fresh.moved()));
    }
  };
  QVERIFY(check_property("each move is that of a new solver in the same state", holds));
}

/// What lies behind the cut stays, and follows again when the links are restored.
void BulletTest::cut_links_are_not_followed() {
  const MeshPointer mesh = make_mesh(MeshKind::line, {9, 1, 1}, 2);
  Deformer solver = patient(mesh, {0});
  const LinkId link = *find_link(*mesh, 4, 5);
  const auto moved = [&] {
    move_by(solver, *mesh, 8, {0.5, 0.5, 0});
    return std::vector<ElementId>(solver.moved().begin(), solver.moved().end());
  };
  QVERIFY((moved() == std::vector<ElementId>{1, 2, 3, 4, 5, 6, 7}));
  solver.body().reset();
  solver.body().cut(std::span(&link, 1));
  const std::vector<ElementId> beyond = moved();
  QVERIFY((beyond == std::vector<ElementId>{5, 6, 7}));
  solver.body().uncut(std::span(&link, 1));
  QVERIFY((moved() == std::vector<ElementId>{1, 2, 3, 4, 5, 6, 7}));
}

/// Frames that follow in later moves lead on to the same place.
void BulletTest::the_limit_of_iterations_is_told() {
  const MeshPointer mesh = make_mesh(MeshKind::cloth, {6, 5, 1});
  Deformer solver = patient(mesh, first_column(*mesh)), other = patient(mesh, first_column(*mesh));
  ElasticOptions few;
  few.iterations = 3;
  solver.body().set_elastic(few);
  const Point target = mesh->rest_position(29) + Point(0.5, 0.5, 0);
  solver.move(29, target);
  QVERIFY2(
      QString::fromStdString(solver.remark())
          .contains(QRegularExpression("^it did not converge in 3 iterations: elements still move by up to 0\\.[0-9]+ "
                                       "of the mean edge length per iteration; this is the last iterate$")),
      solver.remark().c_str());
  QVERIFY(position_of(solver, *mesh, 29) == target);
  for (int again = 0; again < 3000 && !solver.remark().empty(); ++again) {
    solver.move(29, target);
  }
  QCOMPARE(solver.remark(), std::string());
  other.move(29, target);
  QCOMPARE(other.remark(), std::string());
  QVERIFY(largest_step(positions_of(solver, *mesh), positions_of(other, *mesh)) < 0.01);
}

void BulletTest::a_cancelled_move_moves_nothing() {
  const MeshPointer mesh = make_mesh(MeshKind::cloth, {10, 8, 1});
  Deformer solver = patient(mesh, first_column(*mesh));
  const Progress job = Progress::watched();
  job.cancel();
  for (int turn = 0; turn < 2; ++turn) {
    const std::vector<double> before = positions_of(solver, *mesh);
    solver.set_progress(job);
    QVERIFY_THROWS_EXCEPTION(Cancelled, move_by(solver, *mesh, 79, {1, 1, 0}));
    QVERIFY(same_bits(positions_of(solver, *mesh), before));
    solver.set_progress({});
    move_by(solver, *mesh, 79, {0.5, 1, 0});
  }
  Deformer other = patient(mesh, first_column(*mesh));
  move_by(other, *mesh, 79, {0.5, 1, 0});
  move_by(other, *mesh, 79, {0.5, 1, 0});
  QVERIFY(same_bits(positions_of(solver, *mesh), positions_of(other, *mesh)));
}

/// The squares of distances exceed Bullet's single precision.
void BulletTest::a_target_out_of_range_moves_nothing() {
  const MeshPointer mesh = make_mesh(MeshKind::cloth, {5, 4, 1});
  Deformer solver = patient(mesh, first_column(*mesh));
  move_by(solver, *mesh, 19, {0.5, 1, 0});
  const std::vector<double> before = positions_of(solver, *mesh);
  for (const double size : {1e20, 1e60, 1e300, std::numeric_limits<double>::quiet_NaN()}) {
    QVERIFY(!refusal([&] { solver.move(19, Point(size, 0, 0)); }).empty());
    QVERIFY(same_bits(positions_of(solver, *mesh), before));
  }
  QCOMPARE(
      refusal([&] { solver.move(19, Point(1e20, 0, 0)); }),
      std::string("Bullet: positions leave the range of its precision; use a target that is nearer to the object"));
  move_by(solver, *mesh, 19, {0.5, 0, 0});
  QVERIFY(!solver.moved().empty());
}

QTEST_APPLESS_MAIN(BulletTest)
#include "test_bullet.moc"
