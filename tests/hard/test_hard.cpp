#include <QFile>
#include <QtTest>
#include <cstdio>
#include <map>
#include <set>

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
  Contender contender;
  Precision precision;
  Outcome outcome;
  std::string refusal;  // the error message, if the case was refused
};

std::string number(double x) {
  char text[32];
  std::snprintf(text, sizeof text, x != 0 && (x < 1e-3 || x >= 1e4) ? "%.0e" : "%.2g", x);
  return text;
}

/// Returns the largest violation, or another condition that failed.
std::string held(const Row& row) {
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
  return text + (outcome.stopped ? ", stopped" : "");
}

std::string held_and_drift(const Row& row) {
  return held(row) + (row.outcome.drift ? ", drift " + number(*row.outcome.drift) : "");
}

/// Texts of table cells, by the names of their case and algorithm.
using Cells = std::map<std::pair<std::string, std::string>, std::string>;

/// Puts float and double into one cell, and only once if they are equal.
template <class Text>
Cells cells_of(const std::vector<Row>& rows, Text text_of) {
  Cells cells;
  for (const Row& row : rows) {
    auto& text = cells[{row.name, row.algorithm}];
    const std::string now = text_of(row);
    text = text.empty() || text == now ? now : text + " / " + now;
  }
  return cells;
}

void print_table(const std::vector<Row>& rows) {
  Cells cells = cells_of(rows, held_and_drift);
  std::vector<std::string> names, columns;
  for (const Row& row : rows) {
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

QStringList cells_in(const QString& line) {
  QStringList cells = line.split('|').mid(1);
  cells.removeLast();
  std::ranges::transform(cells, cells.begin(), [](const QString& cell) { return cell.trimmed(); });
  return cells;
}

/// Returns the text of the manual's page without line breaks. `table` receives the lines of its table.
QString page_text(QStringList& table) {
  QFile file(QStringLiteral(PAGE));
  if (!file.open(QIODevice::ReadOnly)) {
    return {};
  }
  const QString text = QString::fromUtf8(file.readAll());
  for (const QString& line : text.split('\n')) {
    if (line.startsWith('|')) {
      table << line;
    }
  }
  return text.simplified();
}

/// Returns all contenders, or those that accept a mesh.
std::vector<Contender> contenders_for(const Mesh* mesh) {
  std::vector<Contender> contenders;
  for (const AlgorithmInfo& one : algorithms()) {
    if (mesh == nullptr || fits(one.algorithm, *mesh)) {
      contenders.push_back({one.algorithm});
    }
  }
  contenders.push_back({Algorithm::exact, true});
  contenders.push_back({Algorithm::exact, true, EnergyKind::material});
  return contenders;
}

/// Returns the labels of the algorithms in a column head of the page's table: 'Spiral and Natural Queue' are two.
std::vector<std::string> algorithms_in(const QString& column) {
  std::vector<std::string> labels;
  for (const QString& name : column.split(" and ")) {
    for (const Contender& one : contenders_for(nullptr)) {
      const std::string of = label(one);
      if (name == of.c_str() || name + " ChainMail" == of.c_str()) {
        labels.push_back(of);
      }
    }
  }
  return labels;
}

/// Returns a drift in the format of the page.
QString on_page(double drift) { return QString::fromStdString(number(drift)).replace("e-0", "e-").replace("e+0", "e"); }

}  // namespace

/// Numerical stability of hard cases: each case with each algorithm, in float and in double. The table reports what an
/// algorithm does not achieve; the test checks what every algorithm must achieve.
class HardTest : public QObject {
  Q_OBJECT

 private slots:
  void holds_data();
  void holds();
  void the_manual_has_the_table();
  void the_manual_has_the_drifts();
  void what_is_no_number_is_refused_data();
  void what_is_no_number_is_refused();
  void cleanupTestCase();

 private:
  /// False if only some cases ran, for example if the command line names a function.
  bool has_all_rows() const {
    std::set<std::string> names;
    std::ranges::transform(rows_, std::inserter(names, names.end()), &Row::name);
    return names.size() == cases(large).size();
  }
  double largest_drift(const std::string& name, Precision precision, bool of_generalized) const {
    double largest = 0;
    for (const Row& row : rows_) {
      if (row.name == name && row.precision == precision && !row.contender.equilibrium &&
          (row.algorithm == info(Algorithm::generalized).label) == of_generalized) {
        largest = std::max(largest, *row.outcome.drift);
      }
    }
    return largest;
  }

  std::vector<Row> rows_;
};

void HardTest::holds_data() {
  QTest::addColumn<int>("index");
  QTest::addColumn<int>("algorithm");
  QTest::addColumn<bool>("equilibrium");
  QTest::addColumn<int>("energy");
  static const std::vector<Case> all = cases(large);
  if (!large) {
    qInfo("cases of a million moves or elements run only in the release build");
  }
  for (std::size_t i = 0; i < all.size(); ++i) {
    for (const Contender& one : contenders_for(all[i].mesh.get())) {
      QTest::newRow((all[i].name + ", " + label(one)).c_str())
          << int(i) << int(one.algorithm) << one.equilibrium << int(one.energy);
    }
  }
}

void HardTest::holds() {
  QFETCH(int, index);
  QFETCH(int, algorithm);
  QFETCH(bool, equilibrium);
  QFETCH(int, energy);
  static const std::vector<Case> all = cases(large);
  const Case& one = all[static_cast<std::size_t>(index)];
  const auto of = static_cast<Algorithm>(algorithm);
  for (const Precision precision : test::precisions) {
    const Contender contender{of, equilibrium, static_cast<EnergyKind>(energy)};
    Row row{one.name, label(contender), contender, precision, {}, {}};
    try {
      row.outcome = one.run(contender, precision);
    } catch (const Error& error) {
      row.refusal = error.what();
    }
    rows_.push_back(row);
    QVERIFY(row.outcome.finite);
    QVERIFY(row.outcome.anchors);
    // Contradicting pins have no answer. Only Exact searches for one, and it reports this.
    QCOMPARE(row.refusal.empty(), !(of == Algorithm::exact && one.name == "pins that contradict"));
    if (of == Algorithm::exact) {
      QVERIFY2(row.outcome.violation.max <= row.outcome.rounding, number(row.outcome.violation.max).c_str());
    }
    if (one.name == "disconnected parts" ||
        (of == Algorithm::exact && !equilibrium && one.name.ends_with("there and back"))) {
      // Elements that no link joins to the handle do not move at all. A million moves drift by at most 2 ulp of the
      // largest displacement.
      QVERIFY(*row.outcome.drift <= (one.name == "disconnected parts" ? 0 : 4 * 0x1p-23));
    }
  }
}

/// Checks that the manual has exactly these cases and cells: positions are the same to the bit on every machine.
void HardTest::the_manual_has_the_table() {
  if (!has_all_rows()) {
    QSKIP("needs the results of all cases");
  }
  QStringList table, wrong;
  page_text(table);
  QVERIFY2(table.size() > 2, "the manual has a table of hard cases");
  const QStringList head = cells_in(table.front());
  Cells cells = cells_of(rows_, held);
  std::set<std::string> in_table, algorithms_there;
  for (const QString& line : table.mid(2)) {
    const QStringList row = cells_in(line);
    QCOMPARE(row.size(), head.size());
    const std::string name = row.front().toStdString();
    in_table.insert(name);
    if (std::ranges::none_of(rows_, [&](const Row& one) { return one.name == name; })) {
      QVERIFY2(!large, qPrintable("the manual has a case that does not exist: " + row.front()));
      qInfo() << "compared only in release builds:" << row.front();
      continue;
    }
    for (qsizetype column = 1; column < row.size(); ++column) {
      for (const std::string& label : algorithms_in(head[column])) {
        algorithms_there.insert(label);
        const std::string text = cells.contains({name, label}) ? cells[{name, label}] : "no grid";
        if (text != row[column].toStdString()) {
          wrong << QString("%1, %2: '%3' is '%4' now")
                       .arg(row.front(), QString::fromStdString(label), row[column], QString::fromStdString(text));
        }
      }
    }
  }
  QVERIFY2(wrong.isEmpty(), qPrintable("the manual's table is out of date:\n" + wrong.join('\n')));
  for (const Row& row : rows_) {
    QVERIFY2(in_table.contains(row.name), ("the manual lacks the case " + row.name).c_str());
  }
  QCOMPARE(algorithms_there.size(), contenders_for(nullptr).size());
}

/// Checks the figures in the text below the table, which the printed table calls drift.
void HardTest::the_manual_has_the_drifts() {
  if (!has_all_rows()) {
    QSKIP("needs the results of all cases");
  }
  QStringList table;
  const QString text = page_text(table);
  const double turned = std::max(largest_drift("turned by 45°", Precision::single_precision, false),
                                 largest_drift("turned by 45°", Precision::double_precision, false));
  const double generalized = std::max(largest_drift("turned by 45°", Precision::single_precision, true),
                                      largest_drift("turned by 45°", Precision::double_precision, true));
  const QString apart =
      QString("up to %1 rest lengths apart (Generalized %2)").arg(on_page(turned), on_page(generalized));
  QVERIFY2(text.contains(apart), qPrintable("the manual lacks: " + apart));
  if (!large) {
    QSKIP("the drift of a million moves is compared only in release builds");
  }
  const std::string moves = "1,000,000 tiny moves there and back";
  QCOMPARE(largest_drift(moves, Precision::single_precision, false), 0.0);
  QCOMPARE(largest_drift(moves, Precision::double_precision, false), 0.0);
  const QString drifted = QString("no algorithm but Generalized (%1 of a rest length in float, %2 in double)")
                              .arg(on_page(largest_drift(moves, Precision::single_precision, true)),
                                   on_page(largest_drift(moves, Precision::double_precision, true)));
  QVERIFY2(text.contains(drifted), qPrintable("the manual lacks: " + drifted));
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
