#include <Eigen/Cholesky>
#include <QtTest>
#include <random>
#include <set>

#include "elastic/cholesky.h"
#include "elastic/elimination.h"
#include "elastic/simplices.h"
#include "support.h"

using namespace chainmail;
using namespace chainmail::test;

/// The factorization of stiffness against a dense one, and its order.
class CholeskyTest : public QObject {
  Q_OBJECT

 private slots:
  void solves_as_a_dense_one_does();
  void is_used_again_for_other_numbers();
  void what_is_not_positive_is_told();
  void every_element_with_a_cell_is_ordered_once();
};

namespace {

/// Positive definite, of a random pattern: some columns alone, some nearly full.
Eigen::MatrixXd some_matrix(int size, int entries, std::mt19937_64& random) {
  Eigen::MatrixXd half = Eigen::MatrixXd::Zero(size, size);
  for (int i = 0; i < entries; ++i) {
    half(static_cast<int>(random() % static_cast<unsigned>(size)),
         static_cast<int>(random() % static_cast<unsigned>(size))) = uniform(random, -1, 1);
  }
  return half * half.transpose() + Eigen::MatrixXd::Identity(size, size);
}

Cholesky::Sparse lower_of(const Eigen::MatrixXd& matrix) {
  return Eigen::MatrixXd(matrix.triangularView<Eigen::Lower>()).sparseView();
}

}  // namespace

void CholeskyTest::solves_as_a_dense_one_does() {
  std::mt19937_64 random(11);
  for (int trial = 0; trial < 200; ++trial) {
    const int size = 1 + static_cast<int>(random() % 60);
    const Eigen::MatrixXd matrix = some_matrix(size, static_cast<int>(random() % 120), random);
    const Eigen::MatrixXd right = Eigen::MatrixXd::Random(size, 3);
    Cholesky cholesky;
    cholesky.analyze(lower_of(matrix));
    QVERIFY(cholesky.factor(lower_of(matrix)));
    const Eigen::MatrixXd expected = matrix.llt().solve(right);
    // The matrices are well conditioned: both are right to some roundings.
    QVERIFY((cholesky.solve(right) - expected).norm() < 1e-11 * (1 + expected.norm()));
  }
}

void CholeskyTest::is_used_again_for_other_numbers() {
  std::mt19937_64 random(12);
  const Eigen::MatrixXd matrix = some_matrix(40, 90, random);
  Cholesky cholesky;
  cholesky.analyze(lower_of(matrix));
  for (const double scale : {1.0, 3.0, 0.5}) {
    QVERIFY(cholesky.factor(lower_of(scale * matrix)));
    const Eigen::VectorXd right = Eigen::VectorXd::LinSpaced(40, -1, 1);
    QVERIFY((scale * matrix * cholesky.solve(right) - right).norm() < 1e-11);
  }
}

void CholeskyTest::what_is_not_positive_is_told() {
  std::mt19937_64 random(13);
  Eigen::MatrixXd matrix = some_matrix(30, 60, random);
  matrix(17, 17) = -1;
  Cholesky cholesky;
  cholesky.analyze(lower_of(matrix));
  QVERIFY(!cholesky.factor(lower_of(matrix)));
}

void CholeskyTest::every_element_with_a_cell_is_ordered_once() {
  for (const MeshPointer& mesh : {make_mesh(MeshKind::tetra, {6, 5, 4}), make_mesh(MeshKind::cloth, {20, 9, 1}),
                                  make_mesh(MeshKind::line, {30, 1, 1})}) {
    Cuts cuts(mesh);
    for (const ElementId neighbour : mesh->neighbours_of(0)) {
      cuts.cut(*find_link(*mesh, 0, neighbour));  // an element without a cell
    }
    const auto order = elimination_order(build_simplices(*mesh, cuts), *mesh);
    const std::set<ElementId> once(order.begin(), order.end());
    QCOMPARE(once.size(), order.size());
    QVERIFY(!once.contains(0));
    QCOMPARE(order.size(), std::size_t(mesh->element_count() - 1));
  }
}

QTEST_APPLESS_MAIN(CholeskyTest)
#include "test_cholesky.moc"
