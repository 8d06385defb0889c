#include <Eigen/Geometry>
#include <QtTest>
#include <optional>
#include <set>

#include "core/families.h"
#include "program.h"
#include "reference/chainmail.h"
#include "reference/variants.h"

namespace chainmail::test_oracle {

using namespace chainmail::test;

namespace {

constexpr int passes = 20;

/// Half of the links have the default softness, the others each a softness of their own.
Softness mixed_softness(const Mesh& mesh, std::mt19937_64& random) {
  Softness softness;
  for (LinkId link = 0; link < mesh.link_count(); ++link) {
    if (random() % 2 == 0) {
      softness.links.set(link, {uniform(random, 0, 1), uniform(random, 1, 2), uniform(random, 0, 0.5)});
    }
  }
  return softness;
}

reference::FactorsOfLink factors_of(const MeshPointer& mesh, const Softness& softness) {
  return [mesh, softness](ElementId a, ElementId b) {
    const LinkSoftness& link = softness.of(*find_link(*mesh, a, b));
    return reference::Factors{link.compression, link.stretch, link.shear};
  };
}

template <class Scalar>
constexpr Precision precision_of = sizeof(Scalar) == sizeof(float) ? Precision::single_precision
                                                                   : Precision::double_precision;

/// The project's solver and the lists of the thesis, side by side on one object.
template <class Scalar>
class SideBySide {
 public:
  SideBySide(const MeshPointer& mesh, Algorithm algorithm, std::uint64_t seed)
      : mesh_(mesh),
        random_(seed),
        softness_(mixed_softness(*mesh, random_)),
        algorithm_(algorithm),
        solver_(std::make_unique<Deformer>(mesh, algorithm, precision_of<Scalar>)),
        object_(mesh, factors_of(mesh, softness_)) {
    solver_->body().set_softness(softness_);
  }

  void cut_or_uncut_a_link() {
    const LinkId link = random_() % mesh_->link_count();
    const auto [a, b] = mesh_->links[link];
    if (solver_->body().cuts().is_cut(link)) {
      solver_->body().uncut(std::span(&link, 1));
      object_.uncut(a, b);
    } else {
      solver_->body().cut(std::span(&link, 1));
      object_.cut(a, b);
    }
  }

  /// Moves a random element, or many, by up to `reach` in both. All results must agree.
  void move(double reach) { random_() % 2 == 0 ? move_one(reach) : move_many(reach); }

 private:
  void move_one(double reach) {
    const ElementId element = random_() % mesh_->element_count();
    const auto target = random_target(element, reach);
    Point point = mesh_->origin;
    for (int k = 0; k < mesh_->space_dimension; ++k) {
      point[mesh_->axes[k]] = target[k];
    }
    Trace trace;
    const PassCount count = solver_->move(element, point, &trace);
    compare(count, trace, move_reference({{element, target}}));
  }

  /// Moves a handle of up to eight elements and rotates it. Half of the time this is the last handle again.
  void move_many(double reach) {
    if (!handle_ || random_() % 2 == 0) {
      std::set<ElementId> elements;
      for (int i = 0; i < 8; ++i) {
        elements.insert(random_() % mesh_->element_count());
      }
      handle_.emplace(solver_->body(), std::vector<ElementId>(elements.begin(), elements.end()));
    }
    Pose pose = handle_->pose();
    for (int k = 0; k < mesh_->space_dimension; ++k) {
      pose.pivot[mesh_->axes[k]] += uniform(random_, -reach, reach);
    }
    if (mesh_->space_dimension > 1 && random_() % 2 == 0) {
      pose.rotation += uniform(random_, -0.5, 0.5) * reach * axis_across(*mesh_);
    }
    Trace trace;
    const PassCount count = solver_->move(*handle_, pose, &trace);
    // The handle is where a rotation matrix of Eigen and the motion of its middle put it, up to rounding. The reference
    // takes its elements from there, so that all others can agree to the bit.
    const double rounding = 16 * half_ulp(precision_of<Scalar>) * (20 + handle_->grabbed().pivot.norm());
    const Eigen::AngleAxisd turn(pose.rotation.norm(), axis_across(*mesh_) * (pose.rotation.sum() < 0 ? -1 : 1));
    reference::Handle held;
    for (std::size_t i = 0; i < handle_->elements().size(); ++i) {
      const ElementId element = handle_->elements()[i];
      const Point at = position_of(*solver_, *mesh_, element);
      QVERIFY((pose.pivot + turn * handle_->arm(i) - at).norm() <= rounding);
      std::array<double, 3> target{};
      for (int k = 0; k < mesh_->space_dimension; ++k) {
        target[k] = solver_->body().positions()(element, k);
      }
      held.push_back({element, target});
    }
    compare(count, trace, move_reference(held));
  }

  std::array<double, 3> random_target(ElementId element, double reach) {
    std::array<double, 3> target{};
    for (int k = 0; k < mesh_->space_dimension; ++k) {
      target[k] = solver_->body().positions()(element, k) + uniform(random_, -reach, reach);
    }
    return target;
  }

  std::vector<reference::Processed> move_reference(const reference::Handle& handle) {
    switch (algorithm_) {
      case Algorithm::generalized:
        return reference::move<reference::GeneralizedChainMail>(object_, handle);
      case Algorithm::spiral:
        return reference::move<reference::Spiral>(object_, handle);
      case Algorithm::natural_queue:
        return reference::move<reference::NaturalQueueChainMail>(object_, handle);
      case Algorithm::enhanced:
        return reference::move_enhanced(object_, handle);
      case Algorithm::chainmail_3d:
        return reference::move_3d_chainmail(object_, handle);
      default:
        return {};  // Exact has its own oracle, and methods of elasticity are checked by mechanics
    }
  }

  void compare(const PassCount& count, const Trace& trace, const std::vector<reference::Processed>& processed) {
    const auto moved = std::count_if(processed.begin(), processed.end(), [](const auto& one) { return one.moved; });
    QCOMPARE(count.checked, std::uint64_t(processed.size()));
    QCOMPARE(count.moved, std::uint64_t(moved));
    QVERIFY(std::equal(trace.begin(), trace.end(), processed.begin(), processed.end(),
                       [](const TraceRow& row, const reference::Processed& other) {
                         return row == TraceRow{other.element, other.sponsor, other.moved};
                       }));
    std::vector<double> expected;
    for (const auto& element : object_.elements) {
      expected.insert(expected.end(), element.current_position.begin(),
                      element.current_position.begin() + mesh_->space_dimension);
    }
    QVERIFY(same_bits(positions_of(*solver_, *mesh_), expected));
  }

  MeshPointer mesh_;
  std::mt19937_64 random_;
  Softness softness_;
  Algorithm algorithm_;
  std::unique_ptr<Deformer> solver_;
  reference::Object<Scalar> object_;
  std::optional<Handle> handle_;
};

template <class Scalar>
void run_side_by_side(const MeshPointer& mesh, Algorithm algorithm, std::uint64_t seed) {
  SideBySide<Scalar> both(mesh, algorithm, seed);
  for (int pass = 0; pass < passes; ++pass) {
    if (seed % 2 == 1) {
      both.cut_or_uncut_a_link();
    }
    // A small move with a local effect, a large one that affects the whole object, and none.
    both.move(pass % 5 == 4 ? 0 : pass % 2 == 0 ? 4 : 0.4);
    if (QTest::currentTestFailed()) {
      qWarning("seed %llu, pass %d", static_cast<unsigned long long>(seed), pass);
      return;
    }
  }
}

}  // namespace

/// Compares the solver with the algorithms as the thesis describes them: after every pass, the same bits, and the same
/// candidates in the same order.
class OracleTest : public QObject {
  Q_OBJECT

 private slots:
  void agrees_with_the_thesis_data();
  void agrees_with_the_thesis();
  void spiral_ends_where_natural_queue_does();
};

void OracleTest::agrees_with_the_thesis_data() {
  QTest::addColumn<MeshFamily>("family");
  QTest::addColumn<int>("algorithm");
  for (const MeshFamily& family : families()) {
    for (const AlgorithmInfo& one : algorithms_for(*family.mesh)) {
      if (one.algorithm == Algorithm::exact) {
        continue;
      }
      QTest::newRow((family.name + ", " + std::string(one.label)).c_str()) << family << static_cast<int>(one.algorithm);
    }
  }
}

void OracleTest::agrees_with_the_thesis() {
  QFETCH(MeshFamily, family);
  QFETCH(int, algorithm);
  for (std::uint64_t seed = 0; seed < 10 && !QTest::currentTestFailed(); ++seed) {
    run_side_by_side<double>(family.mesh, static_cast<Algorithm>(algorithm), seed);
    run_side_by_side<float>(family.mesh, static_cast<Algorithm>(algorithm), seed);
  }
}

void OracleTest::spiral_ends_where_natural_queue_does() {
  std::mt19937_64 random(5);
  for (const MeshFamily& family : families()) {
    for (const Precision precision : precisions) {
      const auto spiral = std::make_unique<Deformer>(family.mesh, Algorithm::spiral, precision);
      const auto queue = std::make_unique<Deformer>(family.mesh, Algorithm::natural_queue, precision);
      const Softness softness = mixed_softness(*family.mesh, random);
      spiral->body().set_softness(softness);
      queue->body().set_softness(softness);
      for (int pass = 0; pass < 2 * passes; ++pass) {
        const ElementId element = random() % family.mesh->element_count();
        const Point target = position_of(*queue, *family.mesh, element) +
                             Point(uniform(random, -3, 3), uniform(random, -3, 3), uniform(random, -3, 3));
        const PassCount one = spiral->move(element, target);
        const PassCount other = queue->move(element, target);
        QCOMPARE(one.checked, other.checked);
        QVERIFY2(same_bits(positions_of(*spiral, *family.mesh), positions_of(*queue, *family.mesh)),
                 family.name.c_str());
      }
    }
  }
}

CHAINMAIL_TEST(OracleTest)

}  // namespace chainmail::test_oracle

#include "test_oracle.moc"
