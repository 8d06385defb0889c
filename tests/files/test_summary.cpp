#include <QJsonDocument>
#include <QJsonObject>
#include <QtTest>
#include <sstream>

#include "files/results/summary.h"
#include "files/support.h"
#include "program.h"

namespace chainmail::test_summary {

using namespace chainmail::test;

/// Tests the summaries of a mesh and of a deformation, and their JSON.
class SummaryTest : public QObject {
  Q_OBJECT

 private slots:
  void of_a_mesh();
  void components_are_counted();
  void json_keeps_the_order_of_the_keys();
  void json_of_a_deformation();
  void text_and_notes_of_a_deformation();
};

void SummaryTest::of_a_mesh() {
  const auto summary = summarize(*made(MeshKind::tetra, {2, 2, 2}, 2));
  QCOMPARE(summary.elements, std::uint64_t{8});
  QCOMPARE(summary.links, std::uint64_t{19});  // 12 edges, 6 face diagonals, 1 through the middle
  QCOMPARE(summary.tetrahedra, std::uint64_t{6});
  QCOMPARE(summary.object_dimension, 3);
  QVERIFY(summary.bounds[1] == Point(2, 2, 2));
  QCOMPARE(summary.mean_link_length, (12 * 2 + 6 * std::sqrt(8.0) + std::sqrt(12.0)) / 19);
}

void SummaryTest::components_are_counted() {
  MeshParts parts;
  parts.rest.resize(6, Point::Zero());
  parts.links = {{0, 5}, {5, 1}, {2, 3}};
  QCOMPARE(summarize(*build_mesh(parts)).components, std::uint64_t{3});  // 0-5-1, 2-3 and 4
}

void SummaryTest::json_keeps_the_order_of_the_keys() {
  std::ostringstream out;
  write_json(out, summarize(*made(MeshKind::line, {2, 1, 1})));
  qsizetype last = -1;
  for (const char* key : {"elements", "links", "triangles", "tetrahedra", "object_dimension", "space_dimension",
                          "components", "bounds", "mean_link_length"}) {
    const qsizetype at = QByteArray::fromStdString(out.str()).indexOf('"' + QByteArray(key) + '"');
    QVERIFY2(at > last, key);
    last = at;
  }
}

void SummaryTest::json_of_a_deformation() {
  DeformSummary summary{Algorithm::spiral, 4, 3, {{{2}, Point(0.1, 0, 0), {}, 7, 5, 0.25}}, {}, 0.5, {2, 1}};
  summary.violation.max = 0.125;
  summary.passes[0].stopped_at = Point(0.05, 0, 0);
  summary.equilibrium.emplace().binds = true;
  std::ostringstream out;
  write_json(out, summary);
  const auto json = QJsonDocument::fromJson(QByteArray::fromStdString(out.str())).object();
  QCOMPARE(json["algorithm"].toString(), QString("spiral"));
  const auto pass = json["passes"][0];
  QCOMPARE(pass["element"].toInt(), 2);
  QCOMPARE(pass["target"][0].toDouble(), 0.1);
  QCOMPARE(pass["stopped_at"][0].toDouble(), 0.05);
  QVERIFY(json["equilibrium"]["regions_bind"].toBool());
  QCOMPARE(pass["checked"].toInt(), 7);
  QCOMPARE(pass["moved"].toInt(), 5);
  QCOMPARE(pass["milliseconds"].toDouble(), 0.25);
  QCOMPARE(json["violation"]["max"].toDouble(), 0.125);
  QCOMPARE(json["energy"].toDouble(), 0.5);
  QCOMPARE(json["displacement"]["max"].toDouble(), 2.0);
  QCOMPARE(json["displacement"]["rms"].toDouble(), 1.0);
}

void SummaryTest::text_and_notes_of_a_deformation() {
  DeformSummary summary{Algorithm::chainmail_3d, 30, 49, {}, {}, 0, {}};
  summary.passes.resize(2);
  summary.passes[0].handle = {28, 29};
  summary.passes[1].handle = {29};
  QVERIFY(notes_of(summary).empty());
  summary.passes[1].target = Point(50, 4.5, 0);
  summary.passes[1].stopped_at = Point(5.5, 4.5, 0);
  summary.equilibrium.emplace();
  std::ostringstream out;
  write_text(out, summary);
  const QString text = QString::fromStdString(out.str());
  QVERIFY(text.startsWith("3d on 30 elements, 49 links\npass 0: 2 elements to ") &&
          text.contains("stopped by pins at"));
  QVERIFY(text.contains("equilibrium: residual"));
  QCOMPARE(notes_of(summary),
           std::vector<std::string>{"1 of 2 passes stopped before the target; the last at (5.5, 4.5, 0) instead of "
                                    "(50, 4.5, 0)"});
}

CHAINMAIL_TEST(SummaryTest)

}  // namespace chainmail::test_summary

#include "test_summary.moc"
