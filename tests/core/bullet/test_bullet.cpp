#include <QtTest>
#include <cmath>
#include <numbers>

#include "bullet/soft_body.h"
#include "core/pinned.h"
#include "core/scenarios.h"

using namespace chainmail;
using namespace chainmail::test;

/// Bullet's soft body as a method. Its answers are compared with what its way to correct links implies.
class BulletTest : public QObject {
  Q_OBJECT

 private slots:
  void its_entry_differs_from_the_others();
  void a_taut_chain_has_the_lengths_that_cancel_data();
  void a_taut_chain_has_the_lengths_that_cancel();
  void two_taut_links_have_the_lengths_of_bullets_formula();
  void slack_links_keep_their_lengths_data();
  void slack_links_keep_their_lengths();
  void the_answer_is_repeated_bit_for_bit();
  void pins_and_handle_are_exactly_in_place_data();
  void pins_and_handle_are_exactly_in_place();
  void a_handle_of_many_turns_as_a_rigid_body();
  void each_move_is_that_of_a_new_solver();
  void reset_brings_back_the_first_answer();
  void cut_links_are_not_followed();
  void what_no_link_reaches_keeps_its_bits();
  void an_object_at_rest_stays_at_rest();
  void a_long_object_comes_to_rest();
  void the_unit_and_the_origin_do_not_matter();
  void a_turned_frame_does_not_matter();
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
Solver patient(const MeshPointer& mesh, const std::vector<ElementId>& pins,
               Precision precision = Precision::double_precision) {
  Solver solver(mesh, bullet(), precision);
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

std::vector<double> lengths_of(const Solver& solver, const Mesh& mesh) {
  std::vector<double> lengths;
  for (const auto& [a, b] : mesh.links) {
    lengths.push_back((position_of(solver, mesh, b) - position_of(solver, mesh, a)).norm());
  }
  return lengths;
}

/// Returns the largest difference between the length of a link and its rest length (mesh units).
double largest_excess(const Solver& solver, const Mesh& mesh) {
  const std::vector<double> lengths = lengths_of(solver, mesh);
  double largest = 0;
  for (LinkId link = 0; link < mesh.link_count(); ++link) {
    largest = std::max(largest, std::abs(lengths[link] - rest_length(mesh, link)));
  }
  return largest;
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

void BulletTest::its_entry_differs_from_the_others() {
  const AlgorithmInfo entry = bullet_soft_body();
  for (const AlgorithmInfo& one : every_algorithm()) {
    if (one.name != entry.name) {
      QVERIFY(one.algorithm != entry.algorithm);
      QVERIFY(one.label != entry.label && one.style.path != entry.style.path && one.style.colour != entry.style.colour);
    }
  }
  QVERIFY(info(bullet()).name == "bullet" && find_algorithm("bullet") == bullet());
  QVERIFY(QString::fromUtf8(entry.source.data(), qsizetype(entry.source.size()))
              .contains(QRegularExpression("^Coumans 2015; Bullet [0-9]+\\.[0-9]{2}$")));
  QVERIFY(entry.needs_pins && entry.is_added() && !entry.has_steps());
}

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
    Solver solver = patient(mesh, {0}, Precision(precision));
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
    Solver solver = patient(mesh, {0});
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

void BulletTest::slack_links_keep_their_lengths_data() {
  QTest::addColumn<int>("space");
  QTest::newRow("chain in 2D") << 2;
  QTest::newRow("grid in 3D") << 3;
}

/// The handle comes nearer to the pins, so that every link can have its rest length.
void BulletTest::slack_links_keep_their_lengths() {
  QFETCH(const int, space);
  const MeshPointer mesh =
      space == 2 ? make_mesh(MeshKind::line, {12, 1, 1}, 2) : make_mesh(MeshKind::grid, {8, 8, 1}, 3);
  Solver solver = patient(mesh, first_column(*mesh));
  move_by(solver, *mesh, mesh->element_count() - 1, in_space({-2, 1, 1.5}, space));
  QVERIFY2(solver.remark().empty(), solver.remark().c_str());
  QVERIFY(solver.moved().size() > mesh->element_count() / 2);
  QVERIFY2(largest_excess(solver, *mesh) < 2e-4, qPrintable(QString::number(largest_excess(solver, *mesh))));
}

void BulletTest::the_answer_is_repeated_bit_for_bit() {
  const MeshPointer mesh = make_mesh(MeshKind::cloth, {10, 8, 1});
  std::vector<std::vector<double>> answers;
  for (int turn = 0; turn < 3; ++turn) {
    Solver solver = patient(mesh, first_column(*mesh));
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
  Solver solver = patient(mesh, {}, Precision(precision));
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
  Solver solver = patient(mesh, first_column(*mesh));
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
    Solver solver(mesh, bullet(), precision);
    ElasticOptions few;
    few.iterations = 20;
    solver.body().set_elastic(few);
    for (const DragStep& drag_step : *any_drag_steps(4)) {
      Body& body = solver.body();
      const LinkId link = *rc::gen::inRange<LinkId>(0, mesh->link_count());
      const ElementId element = *rc::gen::inRange<ElementId>(0, mesh->element_count());
      switch (*rc::gen::inRange(0, 7)) {
        case 0:
          body.cut(std::span(&link, 1));
          break;
        case 1:
          body.uncut(std::span(&link, 1));
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
      Solver fresh(mesh, bullet(), precision);
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

void BulletTest::reset_brings_back_the_first_answer() {
  const MeshPointer mesh = make_mesh(MeshKind::cloth, {10, 8, 1});
  Solver solver = patient(mesh, first_column(*mesh));
  move_by(solver, *mesh, 79, {0.5, 1, 0});
  const std::vector<double> first = positions_of(solver, *mesh);
  move_by(solver, *mesh, 45, {-2, 1, 0});
  QVERIFY(!same_bits(positions_of(solver, *mesh), first));
  solver.body().reset();
  move_by(solver, *mesh, 79, {0.5, 1, 0});
  QVERIFY(same_bits(positions_of(solver, *mesh), first));
}

/// What lies behind the cut stays, and follows again when the links are restored.
void BulletTest::cut_links_are_not_followed() {
  const MeshPointer mesh = make_mesh(MeshKind::line, {9, 1, 1}, 2);
  Solver solver = patient(mesh, {0});
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

/// Their positions have more digits than Bullet has.
void BulletTest::what_no_link_reaches_keeps_its_bits() {
  const MeshPointer one = make_mesh(MeshKind::cloth, {4, 4, 1});
  const MeshPointer mesh = side_by_side(*one, *one, {0.1, 1. / 3, 0});
  Solver solver = patient(mesh, {0});
  const std::vector<double> before = positions_of(solver, *mesh);
  move_by(solver, *mesh, 15, {1, 1, 0});
  const std::vector<double> after = positions_of(solver, *mesh);
  const auto half = std::ptrdiff_t(before.size() / 2);
  QVERIFY(std::equal(before.begin() + half, before.end(), after.begin() + half));
  QVERIFY(!solver.moved().empty() && solver.moved().back() < 16);
}

/// Rest lengths are those of the rounded positions that Bullet has, in the frame of the body.
void BulletTest::an_object_at_rest_stays_at_rest() {
  const MeshPointer mesh = jittered_triangles(9, 8, 5);
  Solver solver = patient(mesh, {0});
  for (const double turn : {0.0, 0.5}) {
    Softness softness;
    softness.axes = RegionAxes(AxesKind::given, Point(0, 0, turn));
    solver.body().set_softness(softness);
    solver.move(71, position_of(solver, *mesh, 71));
    QVERIFY(solver.moved().empty());
  }
}

/// Far from the middle of a long object, rounding moves elements by more than others move at rest.
void BulletTest::a_long_object_comes_to_rest() {
  const MeshPointer mesh = make_mesh(MeshKind::line, {800, 1, 1});
  Solver solver = patient(mesh, {0});
  move_by(solver, *mesh, 799, {0.5, 0, 0});
  QVERIFY2(solver.remark().empty(), solver.remark().c_str());
}

/// Bullet counts in mean link lengths from the middle of the object.
void BulletTest::the_unit_and_the_origin_do_not_matter() {
  const MeshPointer mesh = make_mesh(MeshKind::cloth, {8, 6, 1});
  const double unit = 0x1p-20, far = 64;  // powers of 2, so that Bullet gets the same numbers
  const MeshPointer small =
      build_mesh(placed(*mesh, [&](const Point& at) { return Point(unit * at + Point(far, -far, 0)); }));
  Solver solver = patient(mesh, first_column(*mesh)), of_small = patient(small, first_column(*mesh));
  move_by(solver, *mesh, 47, {1, 0.5, 0});
  move_by(of_small, *small, 47, unit * Point(1, 0.5, 0));
  for (ElementId e = 0; e < mesh->element_count(); ++e) {
    const Point scaled = (position_of(of_small, *small, e) - Point(far, -far, 0)) / unit;
    QVERIFY((scaled - position_of(solver, *mesh, e)).norm() < 1e-6);
  }
}

/// A body may store its positions along the axes of another frame, also from one move to the next.
void BulletTest::a_turned_frame_does_not_matter() {
  const MeshPointer mesh = make_mesh(MeshKind::cloth, {8, 6, 1});
  Solver solver = patient(mesh, first_column(*mesh)), other = patient(mesh, first_column(*mesh));
  move_by(solver, *mesh, 47, {1, 0, 0});
  Softness turned;
  turned.axes = RegionAxes(AxesKind::given, Point(0, 0, 0.5));
  solver.body().set_softness(turned);
  const Point target = mesh->rest_position(47) + Point(1.5, 0.5, 0);
  solver.move(47, target);
  QVERIFY((position_of(solver, *mesh, 47) - target).norm() < 1e-14);
  move_by(other, *mesh, 47, {1, 0, 0});
  other.move(47, target);
  QVERIFY(largest_step(positions_of(solver, *mesh), positions_of(other, *mesh)) < 0.001);
}

/// Frames that follow in later moves lead on to the same place.
void BulletTest::the_limit_of_iterations_is_told() {
  const MeshPointer mesh = make_mesh(MeshKind::cloth, {6, 5, 1});
  Solver solver = patient(mesh, first_column(*mesh)), other = patient(mesh, first_column(*mesh));
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
  Solver solver = patient(mesh, first_column(*mesh));
  JobState job;
  job.cancelled = true;
  for (int turn = 0; turn < 2; ++turn) {
    const std::vector<double> before = positions_of(solver, *mesh);
    solver.set_progress(Progress(job));
    QVERIFY_THROWS_EXCEPTION(Cancelled, move_by(solver, *mesh, 79, {1, 1, 0}));
    QVERIFY(same_bits(positions_of(solver, *mesh), before));
    solver.set_progress({});
    move_by(solver, *mesh, 79, {0.5, 1, 0});
  }
  Solver other = patient(mesh, first_column(*mesh));
  move_by(other, *mesh, 79, {0.5, 1, 0});
  move_by(other, *mesh, 79, {0.5, 1, 0});
  QVERIFY(same_bits(positions_of(solver, *mesh), positions_of(other, *mesh)));
}

/// The squares of distances exceed Bullet's single precision.
void BulletTest::a_target_out_of_range_moves_nothing() {
  const MeshPointer mesh = make_mesh(MeshKind::cloth, {5, 4, 1});
  Solver solver = patient(mesh, first_column(*mesh));
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
