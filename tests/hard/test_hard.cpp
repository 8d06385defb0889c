#include <QtTest>
#include <cstdio>
#include <map>

#include "hard/scene.h"
#include "mesh/error.h"

using namespace chainmail;
using namespace chainmail::hard;

namespace {

#if defined(NDEBUG) && !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
constexpr bool large = true;
#else
constexpr bool large = false;
#endif

struct Row {
  std::string name;
  std::string algorithm;
  Precision precision;
  Outcome outcome;
  std::string refusal;  // the sentence, where the case was refused
};

std::string number(double x) {
  char text[32];
  std::snprintf(text, sizeof text, x != 0 && (x < 1e-3 || x >= 1e4) ? "%.0e" : "%.2g", x);
  return text;
}

/// One cell of the table: the largest violation, or what else was not held.
std::string cell(const Row& row) {
  if (!row.refusal.empty()) {
    return "refused";
  }
  const Outcome& outcome = row.outcome;
  const double violation = outcome.violation.max;
  std::string text = !outcome.finite     ? "not finite"
                     : !outcome.anchors  ? "anchor lost"
                     : violation <= 1e-4 ? "0"
                                         : number(violation);
  text += violation > 1e-4 && violation <= outcome.rounding ? " by rounding" : "";
  text += outcome.stopped ? ", stopped" : "";
  return text + (outcome.drift ? ", drift " + number(*outcome.drift) : "");
}

void print_table(const std::vector<Row>& rows) {
  std::map<std::pair<std::string, std::string>, std::string> cells;
  std::vector<std::string> names, columns;
  for (const Row& row : rows) {
    auto& text = cells[{row.name, row.algorithm}];
    const std::string now = cell(row);
    text = text.empty() || text == now ? now : text + " / " + now;
    if (names.empty() || names.back() != row.name) {
      names.push_back(row.name);
    }
    if (std::find(columns.begin(), columns.end(), row.algorithm) == columns.end()) {
      columns.push_back(row.algorithm);
    }
  }
  std::printf("| case |");
  for (const auto& column : columns) {
    std::printf(" %s |", column.c_str());
  }
  std::printf("\n|---|");
  for (std::size_t i = 0; i < columns.size(); ++i) {
    std::printf("---|");
  }
  for (const auto& name : names) {
    std::printf("\n| %s |", name.c_str());
    for (const auto& column : columns) {
      const auto& text = cells[{name, column}];
      std::printf(" %s |", text.empty() ? "no grid" : text.c_str());
    }
  }
  std::printf("\n");
}

}  // namespace

/// Numerical stability on hard cases: each by each algorithm, in float and in double. What an algorithm
/// cannot hold is reported in the table; what every one must hold is asserted.
class HardTest : public QObject {
  Q_OBJECT

 private slots:
  void holds_data();
  void holds();
  void what_is_no_number_is_refused_data();
  void what_is_no_number_is_refused();
  void cleanupTestCase();

 private:
  std::vector<Row> rows_;
};

void HardTest::holds_data() {
  QTest::addColumn<int>("index");
  QTest::addColumn<int>("algorithm");
  static const std::vector<Case> all = cases(large);
  if (!large) {
    qInfo("cases of a million moves or elements run in the release build alone");
  }
  for (std::size_t i = 0; i < all.size(); ++i) {
    for (const AlgorithmInfo& one : test::algorithms_for(*all[i].mesh)) {
      QTest::newRow((all[i].name + ", " + std::string(one.label)).c_str()) << int(i) << int(one.algorithm);
    }
  }
}

void HardTest::holds() {
  QFETCH(int, index);
  QFETCH(int, algorithm);
  static const std::vector<Case> all = cases(large);
  const Case& one = all[static_cast<std::size_t>(index)];
  const auto of = static_cast<Algorithm>(algorithm);
  for (const Precision precision : test::precisions) {
    Row row{one.name, std::string(info(of).label), precision, {}, {}};
    try {
      row.outcome = one.run(of, precision);
    } catch (const Error& error) {
      row.refusal = error.what();
    }
    rows_.push_back(row);
    QVERIFY(row.outcome.finite);
    QVERIFY(row.outcome.anchors);
    // Contradicting pins have no answer: Exact alone looks for one, and says so.
    QCOMPARE(row.refusal.empty(), !(of == Algorithm::exact && one.name == "pins that contradict"));
    if (of == Algorithm::exact) {
      QVERIFY2(row.outcome.violation.max <= row.outcome.rounding, number(row.outcome.violation.max).c_str());
    }
    if (one.name == "disconnected parts" || (of == Algorithm::exact && one.name.ends_with("there and back"))) {
      // What no link joins does not move at all; a million moves drift by 2 ulp of the largest displacement.
      QVERIFY(*row.outcome.drift <= (one.name == "disconnected parts" ? 0 : 4 * 0x1p-23));
    }
  }
}

void HardTest::what_is_no_number_is_refused_data() {
  QTest::addColumn<double>("value");
  QTest::newRow("NaN") << std::nan("");
  QTest::newRow("infinity") << HUGE_VAL;
  QTest::newRow("-infinity") << -HUGE_VAL;
}

void HardTest::what_is_no_number_is_refused() {
  QFETCH(double, value);
  const auto mesh = test::make_mesh(MeshKind::grid, {4, 4, 1});
  for (const AlgorithmInfo& one : algorithms()) {
    for (const Precision precision : test::precisions) {
      Simulation simulation(mesh, one.algorithm, precision);
      test::drag_by(simulation, 5, Point(1, 1, 0));
      const auto before = test::positions_of(simulation);
      const std::vector<Command> bad{commands::Drag{Point(value, 0, 0)},
                                     commands::Drag{Point(0, value, 0)},
                                     commands::SetSoftness{{{value, 1.2, 0.1}, {}}},
                                     commands::SetSoftness{{{0.8, value, 0.1}, {}}},
                                     commands::SetSoftness{{{0.8, 1.2, value}, {}}},
                                     commands::SetSoftness{{{}, {{0, {0.8, 1.2, value}}}}},
                                     commands::SetSoftness{{{1.1, 1.2, 0.1}, {}}},
                                     commands::SetSoftness{{{0.8, 0.9, 0.1}, {}}},
                                     commands::SetSoftness{{{0.8, 1.2, -0.1}, {}}},
                                     commands::SetRelaxation{true, value}};
      for (const Command& command : bad) {
        QVERIFY_EXCEPTION_THROWN(simulation.apply(command), Error);
        QVERIFY(test::same_bits(before, test::positions_of(simulation)));
      }
    }
  }
}

void HardTest::cleanupTestCase() {
  if (!rows_.empty()) {
    std::printf("\nLargest violation in rest lengths (float / double where they differ; 0: none above 1e-4):\n\n");
    print_table(rows_);
    std::fflush(stdout);
  }
}

QTEST_APPLESS_MAIN(HardTest)
#include "test_hard.moc"
