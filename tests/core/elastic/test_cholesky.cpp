#include <Eigen/Cholesky>
#include <Eigen/OrderingMethods>
#include <QtTest>
#include <cmath>
#include <numeric>
#include <random>
#include <set>

#include "core/support.h"
#include "elastic/cholesky.h"
#include "elastic/elimination.h"
#include "elastic/simplices.h"
#include "program.h"

namespace chainmail::test_cholesky {

using namespace chainmail::test;

/// Checks the factorization of stiffness matrices against a dense one, and the order of elimination.
class CholeskyTest : public QObject {
  Q_OBJECT

 private slots:
  void solves_as_a_dense_one_does();
  void is_used_again_for_other_numbers();
  void what_is_not_positive_is_told();
  void changed_columns_are_factored_again_to_the_bit();
  void factors_that_failed_are_made_anew();
  void every_element_with_a_cell_is_ordered_once();
  void the_last_elements_part_the_halves();
  void a_square_fills_in_as_little_as_dissection_promises();
  void a_solid_takes_fewer_operations_than_by_minimum_degree();
};

namespace {

/// Returns a positive definite matrix with a random pattern: some columns have one entry, some are nearly full.
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

/// Returns, for each element, the elements that share a cell with it: its neighbours in the pattern of the stiffness
/// matrix.
std::vector<std::set<ElementId>> sharing_a_cell(const Simplices& simplices, ElementId count) {
  std::vector<std::set<ElementId>> all(count);
  for (std::size_t s = 0; s < simplices.count(); ++s) {
    for (const ElementId a : simplices.corners_of(s)) {
      const auto corners = simplices.corners_of(s);
      all[a].insert(corners.begin(), corners.end());
    }
  }
  return all;
}

/// Returns the number of entries of each column of the factor, including the diagonal. Elements are eliminated one by
/// one, and the neighbours of an eliminated element become neighbours of each other. It is enough to pass them to the
/// first of them.
std::vector<std::size_t> factor_columns(const Simplices& simplices, ElementId count,
                                        const std::vector<ElementId>& order) {
  std::vector<std::size_t> position(count), lengths;
  for (std::size_t i = 0; i < order.size(); ++i) {
    position[order[i]] = i;
  }
  const auto sharing = sharing_a_cell(simplices, count);
  std::vector<std::vector<std::size_t>> below(order.size());
  for (std::size_t i = 0; i < order.size(); ++i) {
    auto& rows = below[i];
    for (const ElementId e : sharing[order[i]]) {
      rows.push_back(position[e]);
    }
    std::ranges::sort(rows);
    rows.erase(std::unique(rows.begin(), rows.end()), rows.end());
    rows.erase(rows.begin(), std::ranges::upper_bound(rows, i));
    lengths.push_back(rows.size() + 1);
    if (!rows.empty()) {
      auto& next = below[rows.front()];
      next.insert(next.end(), rows.begin() + 1, rows.end());
    }
    rows = {};
  }
  return lengths;
}

/// Multiplications and additions of the factorization: the sum of the squares of the column lengths.
double operations(const std::vector<std::size_t>& columns) {
  return std::transform_reduce(columns.begin(), columns.end(), 0.0, std::plus(),
                               [](std::size_t one) { return double(one) * double(one); });
}

std::vector<ElementId> by_minimum_degree(const Simplices& simplices, ElementId count) {
  std::vector<Eigen::Triplet<char>> entries;
  const auto sharing = sharing_a_cell(simplices, count);
  for (ElementId e = 0; e < count; ++e) {
    for (const ElementId other : sharing[e]) {
      entries.emplace_back(int(e), int(other), 1);
    }
  }
  Eigen::SparseMatrix<char> pattern(count, count);
  pattern.setFromTriplets(entries.begin(), entries.end());
  Eigen::PermutationMatrix<Eigen::Dynamic, Eigen::Dynamic, int> order;
  Eigen::AMDOrdering<int>()(pattern.selfadjointView<Eigen::Lower>(), order);
  return {order.indices().begin(), order.indices().end()};
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
    // The matrices are well conditioned, so both solutions are exact up to some roundings.
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

namespace {

/// Takes numbers from the diagonal and from entries of some columns of a matrix, which stays positive definite. Returns
/// the columns.
std::vector<int> weaken(Eigen::MatrixXd& matrix, const Eigen::MatrixXd& whole, std::mt19937_64& random) {
  std::vector<int> columns;
  matrix = whole;
  const int count = static_cast<int>(random() % 4);
  for (int i = 0; i < count; ++i) {
    const auto row = static_cast<Eigen::Index>(random() % static_cast<unsigned>(whole.rows()));
    const auto column = static_cast<Eigen::Index>(random() % static_cast<unsigned>(whole.rows()));
    const double entry = std::abs(matrix(row, column));
    matrix(row, row) += entry;
    matrix(column, column) += entry;
    matrix(row, column) = matrix(column, row) = row == column ? matrix(row, row) : 0;
    columns.push_back(static_cast<int>(row));
    columns.push_back(static_cast<int>(column));
  }
  return columns;
}

}  // namespace

/// One column after another changes and changes back. The pattern is that of the whole matrix.
void CholeskyTest::changed_columns_are_factored_again_to_the_bit() {
  std::mt19937_64 random(14);
  int updated = 0;
  for (int trial = 0; trial < 100; ++trial) {
    const int size = 1 + static_cast<int>(random() % 80);
    const Eigen::MatrixXd whole = some_matrix(size, static_cast<int>(random() % 120), random);
    const Eigen::MatrixXd right = Eigen::MatrixXd::Random(size, 2);
    const Cholesky::Sparse pattern = lower_of(whole);
    const auto filled = [&](const Eigen::MatrixXd& matrix) {
      Cholesky::Sparse result = pattern;
      for (int column = 0; column < size; ++column) {
        for (Cholesky::Sparse::InnerIterator entry(result, column); entry; ++entry) {
          entry.valueRef() = matrix(entry.row(), column);
        }
      }
      return result;
    };
    Cholesky kept;
    kept.analyze(pattern);
    kept.keep_updates();
    QVERIFY(kept.factor(pattern));
    std::vector<int> last;
    for (int step = 0; step < 5; ++step) {
      Eigen::MatrixXd matrix;
      std::vector<int> columns = weaken(matrix, whole, random);
      std::vector<int> changed = columns;
      changed.insert(changed.end(), last.begin(), last.end());
      if (step == 3) {
        kept.drop_updates();  // then all is factored
        kept.keep_updates();
      }
      QVERIFY(kept.refactor(filled(matrix), changed));
      last = columns;
      updated += columns.empty() ? 0 : 1;
      Cholesky anew;
      anew.analyze(pattern);
      QVERIFY(anew.factor(filled(matrix)));
      const Eigen::MatrixXd found = kept.solve(right), dense = matrix.llt().solve(right);
      QVERIFY(found == anew.solve(right));
      QVERIFY((found - dense).norm() < 1e-11 * (1 + dense.norm()));
    }
  }
  QVERIFY(updated > 200);
}

void CholeskyTest::factors_that_failed_are_made_anew() {
  std::mt19937_64 random(15);
  const Eigen::MatrixXd matrix = some_matrix(30, 60, random);
  Eigen::MatrixXd negative = matrix;
  negative(3, 3) = -1;
  Cholesky cholesky;
  cholesky.analyze(lower_of(matrix));
  cholesky.keep_updates();
  QVERIFY(cholesky.factor(lower_of(matrix)) && cholesky.has_factors());
  const Eigen::VectorXd right = Eigen::VectorXd::LinSpaced(30, -1, 1);
  const Eigen::VectorXd expected = cholesky.solve(right);
  QVERIFY(!cholesky.refactor(lower_of(negative), std::vector{3}) && !cholesky.has_factors());
  QVERIFY(cholesky.refactor(lower_of(matrix), std::vector<int>()));
  QVERIFY(cholesky.solve(right) == expected);
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

/// Without the separator, which comes last, no cell joins the two halves, so their columns do not fill each other.
void CholeskyTest::the_last_elements_part_the_halves() {
  constexpr std::uint32_t side = 16;
  const auto mesh = make_mesh(MeshKind::cloth, {side, side, 1});
  const Simplices simplices = build_simplices(*mesh, Cuts(mesh));
  auto rest = dissect(simplices, *mesh);
  QCOMPARE(rest.size(), std::size_t(side * side));
  rest.resize(rest.size() - side);  // one line across the square separates the halves
  const auto sharing = sharing_a_cell(simplices, mesh->element_count());
  std::set<ElementId> left(rest.begin(), rest.end()), half;
  std::vector<ElementId> waiting{rest.front()};
  while (!waiting.empty()) {
    const ElementId e = waiting.back();
    waiting.pop_back();
    if (left.erase(e) != 0) {
      half.insert(e);
      waiting.insert(waiting.end(), sharing[e].begin(), sharing[e].end());
    }
  }
  QVERIFY(half.size() >= rest.size() / 3 && left.size() >= rest.size() / 3);
}

/// Nested dissection of a square of n x n elements leaves at most 31/4 n² log2 n entries in the factor (George 1973).
void CholeskyTest::a_square_fills_in_as_little_as_dissection_promises() {
  for (const std::uint32_t side : {32U, 64U}) {
    const auto mesh = make_mesh(MeshKind::cloth, {side, side, 1});
    const Simplices simplices = build_simplices(*mesh, Cuts(mesh));
    const auto columns = factor_columns(simplices, mesh->element_count(), dissect(simplices, *mesh));
    const auto entries = std::accumulate(columns.begin(), columns.end(), std::size_t{0});
    QVERIFY(double(entries) < 7.75 * side * side * std::log2(side));
  }
}

/// At 2,744 elements dissection saves about a third. The gain grows with the number of elements.
void CholeskyTest::a_solid_takes_fewer_operations_than_by_minimum_degree() {
  const auto mesh = make_mesh(MeshKind::tetra, {14, 14, 14});
  const Simplices simplices = build_simplices(*mesh, Cuts(mesh));
  const auto count = mesh->element_count();
  const double chosen = operations(factor_columns(simplices, count, elimination_order(simplices, *mesh)));
  const double degrees = operations(factor_columns(simplices, count, by_minimum_degree(simplices, count)));
  QVERIFY(chosen < 0.8 * degrees);
}

CHAINMAIL_TEST(CholeskyTest)

}  // namespace chainmail::test_cholesky

#include "test_cholesky.moc"
