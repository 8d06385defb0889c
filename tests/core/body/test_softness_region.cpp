#include <QtTest>
#include <cmath>
#include <limits>

#include "core/scenarios.h"
#include "mesh/error.h"
#include "mesh/parameters.h"
#include "program.h"

namespace chainmail::test_softness_region {

using namespace chainmail::test;

/// The valid region: values computed by hand, the rule of signs, and mirrored links.
class SoftnessRegionTest : public QObject {
  Q_OBJECT

 private slots:
  void out_of_range_is_refused_by_name();
  void the_table_of_parameters_agrees();
  void by_hand_in_1d();
  void by_hand_in_2d();
  void by_hand_in_3d();
  void a_link_that_runs_left_or_down();
  void bounds_are_rounded_once();
  void the_other_end_sees_the_mirror_image();
  void the_rest_shape_is_always_valid();
  void softness_of_a_link_goes_before_the_global_one();
  void another_energy_keeps_a_lateral_stiffness_that_was_set();
};

namespace {

// For sums of products of short decimals: two roundings of numbers below 8.
constexpr double rounding = 4 * 8 * std::numeric_limits<double>::epsilon();

template <int Dimension>
void compare_region(const double (&rest_vector)[Dimension], const LinkSoftness& softness,
                    const double (&low)[Dimension], const double (&high)[Dimension]) {
  const auto region = valid_region<double, Dimension>(rest_vector, softness);
  for (int k = 0; k < Dimension; ++k) {
    QVERIFY(std::abs(region.low[k] - low[k]) <= rounding);
    QVERIFY(std::abs(region.high[k] - high[k]) <= rounding);
  }
}

template <class Scalar>
bool mirrored(const double (&there)[3], const LinkSoftness& softness) {
  const double back[3] = {-there[0], -there[1], -there[2]};
  const auto one = valid_region<Scalar, 3>(there, softness);
  const auto other = valid_region<Scalar, 3>(back, softness);
  for (int k = 0; k < 3; ++k) {
    if (one.low[k] != -other.high[k] || one.high[k] != -other.low[k]) {
      return false;
    }
  }
  return true;
}

template <class Scalar>
bool rest_is_valid(const double (&rest_vector)[3], const LinkSoftness& softness) {
  const auto region = valid_region<Scalar, 3>(rest_vector, softness);
  for (int k = 0; k < 3; ++k) {
    const auto rest = static_cast<Scalar>(rest_vector[k]);
    if (!(region.low[k] <= rest && rest <= region.high[k])) {
      return false;
    }
  }
  return true;
}

/// Calls `holds(rest vector, softness)` for links that RapidCheck draws: coordinates in hundredths, of any sign.
template <class Holds>
bool check_any_link(const char* sentence, Holds holds) {
  return check_property(sentence, [&holds] {
    const auto hundredths = *rc::gen::container<std::array<int, 3>>(rc::gen::inRange(-300, 301));
    const double rest_vector[3] = {hundredths[0] / 100.0, hundredths[1] / 100.0, hundredths[2] / 100.0};
    RC_ASSERT(holds(rest_vector, *any_link_softness()));
  });
}

QString complaint_about(const LinkSoftness& softness) {
  try {
    check(softness);
  } catch (const Error& error) {
    return QString::fromStdString(error.what());
  }
  return {};
}

}  // namespace

void SoftnessRegionTest::out_of_range_is_refused_by_name() {
  const double nan = std::numeric_limits<double>::quiet_NaN(), endless = std::numeric_limits<double>::infinity();
  for (const LinkSoftness& good : {LinkSoftness{}, {0, 1, 0}, {1, 1, 0}, {1, 1e6, 1e6}}) {
    QCOMPARE(complaint_about(good), QString());
  }
  for (const double bad : {-0.1, 1.1, nan}) {
    QVERIFY(complaint_about({bad, 1.2, 0.1}).startsWith("compression"));
  }
  for (const double bad : {0.9, endless, nan}) {
    QVERIFY(complaint_about({0.8, bad, 0.1}).startsWith("stretch"));
  }
  for (const double bad : {-0.1, endless, nan}) {
    QVERIFY(complaint_about({0.8, 1.2, bad}).startsWith("shear"));
  }
}

void SoftnessRegionTest::the_table_of_parameters_agrees() {
  using namespace parameters;
  QVERIFY(LinkSoftness() == (LinkSoftness{compression.default_value, stretch.default_value, shear.default_value}));
  QCOMPARE(complaint_about({compression.lowest, stretch.lowest, shear.lowest}), QString());
  QCOMPARE(complaint_about({compression.highest, stretch.highest, shear.highest}), QString());
}

void SoftnessRegionTest::by_hand_in_1d() {
  // There is no other axis, so shear has no effect.
  compare_region<1>({2}, {0.8, 1.2, 0.5}, {1.6}, {2.4});
  compare_region<1>({2}, {0, 1, 0}, {0}, {2});
}

void SoftnessRegionTest::by_hand_in_2d() {
  compare_region<2>({1, 0}, {0.8, 1.2, 0.1}, {0.8, -0.1}, {1.2, 0.1});
  // x: 0.5·3 − 0.25·2 and 2·3 + 0.25·2; y: 0.5·2 − 0.25·3 and 2·2 + 0.25·3.
  compare_region<2>({3, 2}, {0.5, 2, 0.25}, {1, 0.25}, {6.5, 4.75});
}

void SoftnessRegionTest::by_hand_in_3d() {
  // S is 2+3, 1+3 and 1+2.
  compare_region<3>({1, 2, 3}, {0.8, 1.2, 0.1}, {0.8 - 0.5, 1.6 - 0.4, 2.4 - 0.3}, {1.2 + 0.5, 2.4 + 0.4, 3.6 + 0.3});
}

void SoftnessRegionTest::a_link_that_runs_left_or_down() {
  compare_region<1>({-1}, {0.8, 1.2, 0.1}, {-1.2}, {-0.8});
  compare_region<2>({0, -1}, {0.8, 1.2, 0.1}, {-0.1, -1.2}, {0.1, -0.8});
  // S is a sum of lengths, whatever the direction.
  compare_region<3>({-1, 2, -3}, {0.5, 2, 0.1}, {-2 - 0.5, 1 - 0.4, -6 - 0.3}, {-0.5 + 0.5, 4 + 0.4, -1.5 + 0.3});
}

void SoftnessRegionTest::bounds_are_rounded_once() {
  // 1.2·0.7 in double, then rounded, is not 1.2f·0.7f.
  const double rest_vector[1] = {0.7};
  const auto region = valid_region<float, 1>(rest_vector, {0.8, 1.2, 0});
  QVERIFY(region.high[0] == static_cast<float>(1.2 * 0.7));
  QVERIFY(region.low[0] == static_cast<float>(0.8 * 0.7));
  // The rest vector is not rounded first either: elements far from the origin keep their digits.
  MeshParts parts;
  parts.rest = {{1e8, 0, 0}, {1e8 + 1, 0, 0}};
  parts.links = {{0, 1}};
  const auto far = valid_region<float, 1>(*build_mesh(std::move(parts)), 0, 1, {0.5, 1.5, 0});
  QVERIFY(far.low[0] == 0.5F && far.high[0] == 1.5F);
}

void SoftnessRegionTest::the_other_end_sees_the_mirror_image() {
  QVERIFY(check_any_link("one link has one pair of bounds per axis, to the bit",
                         [](const auto& rest, const auto& softness) {
                           return mirrored<double>(rest, softness) && mirrored<float>(rest, softness);
                         }));
}

void SoftnessRegionTest::the_rest_shape_is_always_valid() {
  // This is exact, because rounding never reverses an order.
  QVERIFY(check_any_link("the rest vector lies in its own region", [](const auto& rest, const auto& softness) {
    return rest_is_valid<double>(rest, softness) && rest_is_valid<float>(rest, softness);
  }));
}

void SoftnessRegionTest::softness_of_a_link_goes_before_the_global_one() {
  Softness softness{{0.5, 1.5, 0}, {{2, {1, 1, 0}}}};
  QVERIFY(softness.of(1) == softness.global);
  QVERIFY(softness.of(2) == (LinkSoftness{1, 1, 0}));
  // The stiff link 2–3 moves as a whole; the others stretch.
  const auto mesh = make_mesh(MeshKind::line, {5, 1, 1});
  const auto solver = std::make_unique<Deformer>(mesh, Algorithm::natural_queue, Precision::double_precision);
  solver->body().set_softness(softness);
  solver->move(0, Point(-4, 0, 0));
  QCOMPARE(positions_of(*solver, *mesh), (std::vector<double>{-4, -2.5, -1, 0, 1.5}));
}

void SoftnessRegionTest::another_energy_keeps_a_lateral_stiffness_that_was_set() {
  Softness softness = standard_softness();
  set_energy(softness, EnergyKind::axial);
  QCOMPARE(softness.global.lateral, info(EnergyKind::axial).lateral);  // nobody has set it
  softness.global.lateral = 0.625;
  for (const EnergyKindInfo& one : energy_kinds()) {
    set_energy(softness, one.kind);
    QCOMPARE(softness.global.lateral, 0.625);
  }
}

CHAINMAIL_TEST(SoftnessRegionTest)

}  // namespace chainmail::test_softness_region

#include "test_softness_region.moc"
