#include <QJsonArray>
#include <QJsonDocument>
#include <QJsonObject>
#include <QTemporaryDir>
#include <QtTest>
#include <nlohmann/json.hpp>
#include <random>
#include <sstream>

#include "core/report/made_results.h"
#include "core/support.h"
#include "files/results/results_json.h"
#include "files/support.h"
#include "program.h"
#include "report/page/report.h"

namespace chainmail::test_report_json {

using namespace chainmail::report;
using namespace chainmail::report::test;
using namespace chainmail::test;

/// Tests the JSON of reports.
class ReportJsonTest : public QObject {
  Q_OBJECT

 private slots:
  void has_what_scripts_read();
  void lacks_what_was_not_measured();
  void names_from_outside_do_no_harm();
  void ramps_and_calibrations_have_members_of_their_own();
  void everything_comes_back();
  void damage_is_told_in_one_sentence();
  void other_files_are_refused_data();
  void other_files_are_refused();
};

namespace {

std::string text_of(const Results& results) {
  std::ostringstream out;
  write_json(out, results);
  return out.str();
}

QJsonObject written(const Results& results) {
  return QJsonDocument::fromJson(QByteArray::fromStdString(text_of(results))).object();
}

/// Returns what the program reads from a file with this text.
Results read_text_of(const std::string& text) {
  static const QTemporaryDir folder;
  const auto path = std::filesystem::path(folder.path().toStdString()) / "report.json";
  put_file(path, text);
  return read_results(path);
}

Results comparison() {
  using namespace figures;
  Results results = results_of(ReportKind::compare, {"local"});
  results.runs = {{{{"a processor", 2, "a compiler", "Release"}, "a line", "today", "1"}}};
  results.settings = {{"precision", "float"}, {"relax_step", 0.5}};
  add_row(results, 0, {Algorithm::enhanced, 10},
          {{&ms_per_move, 0.5}, {&checked, 12}, {&violation_fraction, 0.125}, {&float_double_max, 1e-6}});
  add_row(results, 0, {Algorithm::chainmail_3d}, {}, "no grid");
  return results;
}

/// Random results, in the order in which files have them: options by their names, and figures in that of columns.
class RandomResults {
 public:
  explicit RandomResults(std::uint64_t seed) : random_(seed) {}

  Results draw() {
    constexpr std::array kinds{ReportKind::compare, ReportKind::physics, ReportKind::suite, ReportKind::judge};
    Results results{.kind = kinds[below(kinds.size())], .stopped = maybe()};
    for (std::size_t left = results.kind == ReportKind::suite ? below(3) : below(2); left > 0; --left) {
      results.runs.push_back({{{text(), unsigned(below(9)), text(), text()}, text(), text(), text()}, "", {}});
      if (results.kind == ReportKind::suite) {
        results.runs.back().shard = text();
        results.runs.back().experiments = {text(), text()};
      }
    }
    results.settings = {{"a number", number()}, {"a text", text()}};
    for (std::size_t left = below(4); left > 0; --left) {
      add_object(results);
    }
    return results;
  }

 private:
  std::size_t below(std::size_t count) { return random_() % count; }
  bool maybe() { return below(2) == 0; }
  double number() { return uniform(random_, -1, 1) * std::pow(10, double(below(40)) - 20); }
  std::string text() { return std::array<std::string, 4>{"", "plain", "\"é\",\n\\", "</script>\t𝄞"}[below(4)]; }
  std::optional<double> any_number() { return maybe() ? std::optional(number()) : std::nullopt; }

  Contestant contestant() {
    const auto all = every_algorithm();
    Contestant one{.algorithm = all[below(all.size())].algorithm,
                   .sweeps = int(below(100)),
                   .equilibrium = maybe(),
                   .open_regions = maybe(),
                   .limit = int(below(3))};
    if (maybe()) {
      one.calibrated = LinkSoftness{uniform(random_, 0, 1), uniform(random_, 1, 3), uniform(random_, 0, 2)};
    }
    return maybe() ? one : maybe() ? Contestant{} : Contestant{.solver = "of somebody"};
  }
  void add_rows(Results& results, std::optional<std::size_t> drag) {
    for (std::size_t left = below(4); left > 0; --left) {
      Row row{.object = results.objects.size() - 1, .drag = drag, .contestant = contestant(), .refusal = text()};
      for (const Figure* figure : every_figure()) {
        if (row.refusal.empty() && maybe()) {
          row.set(*figure, number());
          if (maybe()) {
            row.set(*figure, TimeSpread{number(), number(), number(), number(), number(), 1 + int(below(50))});
          }
        }
      }
      results.rows.push_back(std::move(row));
    }
  }
  void add_object(Results& results) {
    results.objects.push_back({text(), text(), text(), random_(), below(9), below(9), text(), {}, number(), {}});
    if (maybe()) {
      results.objects.back().notes = {text(), text()};
    }
    for (std::size_t drag = 0, count = below(3); drag < count; ++drag) {
      DragInfo info{text(), text(), random_(), int(below(99)), maybe(), number(), text(), {}};
      if (maybe()) {
        info.reference = Convergence{{{below(99), {}}, {random_(), any_number()}}, any_number(), maybe(), text()};
      }
      results.objects.back().drags.push_back(std::move(info));
      add_rows(results, drag);
    }
    add_rows(results, std::nullopt);
  }

  std::mt19937_64 random_;
};

/// Calls visit(pointer) for each member and each entry of a list, at every depth.
template <class Visit>
void for_each_member(const nlohmann::json& json, const nlohmann::json::json_pointer& at, Visit visit) {
  if (!json.is_structured()) {
    return;
  }
  for (const auto& [key, value] : json.items()) {
    const auto member = json.is_array() ? at / std::stoul(key) : at / key;
    visit(member);
    for_each_member(value, member, visit);
  }
}

}  // namespace

void ReportJsonTest::has_what_scripts_read() {
  const auto json = written(comparison());
  QCOMPARE(json["kind"].toString(), QString("chainmail report"));
  QCOMPARE(json["schema_version"].toInt(), 2);
  QCOMPARE(json["report"].toString(), QString("compare"));
  QCOMPARE(json["origin"]["processor"].toString(), QString("a processor"));
  QCOMPARE(json["origin"]["cores"].toInt(), 2);
  QCOMPARE(json["origin"]["command_line"].toString(), QString("a line"));
  QCOMPARE(json["options"]["precision"].toString(), QString("float"));
  QCOMPARE(json["figures"][0]["key"].toString(), QString("ms_per_move"));
  QCOMPARE(json["figures"][0]["unit"].toString(), QString("ms"));
  const auto object = json["objects"][0];
  QCOMPARE(object["name"].toString(), QString("bar"));
  QCOMPARE(object["links"].toInt(), 12);
  const auto drag = object["drags"][0];
  QCOMPARE(drag["moves"].toInt(), 4);
  const auto one = drag["contestants"][0];
  QCOMPARE(one["algorithm"].toString(), QString("enhanced"));
  QCOMPARE(one["sweeps"].toInt(), 10);
  QCOMPARE(one["ms_per_move"]["median"].toDouble(), 0.5);
  QCOMPARE(one["ms_per_move"]["upper_quartile"].toDouble(), 1.0);
  QCOMPARE(one["ms_per_move"]["repetitions"].toInt(), 5);
  QCOMPARE(one["checked_per_move"].toDouble(), 12.0);
  QCOMPARE(one["violation_fraction"].toDouble(), 0.125);
  QCOMPARE(one["float_double_max"].toDouble(), 1e-6);
}

void ReportJsonTest::lacks_what_was_not_measured() {
  const auto drag = written(comparison())["objects"][0]["drags"][0];
  QVERIFY(drag["no_reference"].isUndefined());
  QVERIFY(drag["contestants"][0]["energy_over_exact"].isUndefined());
  const auto refused = drag["contestants"][1].toObject();
  QCOMPARE(refused["refusal"].toString(), QString("no grid"));
  QCOMPARE(refused.keys(), (QStringList{"algorithm", "equilibrium", "label", "refusal", "sweeps"}));
}

void ReportJsonTest::names_from_outside_do_no_harm() {
  Results one = comparison();
  one.objects[0].name = "a\"b\n\xff";
  QCOMPARE(written(one)["objects"][0]["name"].toString(), QString("a\"b\n\ufffd"));
}

void ReportJsonTest::ramps_and_calibrations_have_members_of_their_own() {
  using namespace figures;
  Results ramp = results_of(ReportKind::ramp, {"scripted"});
  ramp.objects[0].series = "square grid";
  add_row(ramp, 0, {Algorithm::exact}, {{&p99_ms, 2}, {&real_time, 1}});
  const auto of_ramp = written(ramp);
  QCOMPARE(of_ramp["sizes"][0]["width"].toInt(), 3);
  QCOMPARE(of_ramp["sizes"][0]["p99_ms"].toDouble(), 2.0);
  QCOMPARE(of_ramp["sizes"][0]["real_time"], QJsonValue(true));
  QCOMPARE(of_ramp["algorithms"][0]["algorithm"].toString(), QString("exact"));
  QCOMPARE(of_ramp["algorithms"][0]["largest_width"].toInt(), 3);
  QVERIFY(of_ramp["algorithms"][0]["growth"].isNull());

  Results calibration = results_of(ReportKind::calibrate, {"fitted", "fitted", "held out"});
  const Contestant found{Algorithm::exact, 7, false, LinkSoftness{0.75, 1.25, 0.5}};
  for (const std::size_t drag : {0, 1, 2}) {
    add_row(calibration, drag, {Algorithm::exact}, {{&relative, 0.5}});
    add_row(calibration, drag, found, {{&relative, drag == 2 ? 9 : drag == 1 ? 0.25 : 0.125}});
  }
  const auto of_calibration = written(calibration);
  QCOMPARE(of_calibration["compression"].toDouble(), 0.75);
  QCOMPARE(of_calibration["sweeps"].toInt(), 7);
  QCOMPARE(of_calibration["residual"]["relative"].toDouble(), 0.1875);  // without the drags that are held out
  QCOMPARE(of_calibration["drags"].toArray().size(), 2);
  QCOMPARE(of_calibration["drags"][1]["residual"]["relative"].toDouble(), 0.25);
}

/// Reports are read again to be joined and shown. Nothing of them may get lost.
void ReportJsonTest::everything_comes_back() {
  std::size_t rows = 0;
  for (std::uint64_t seed = 0; seed < 100; ++seed) {
    const Results results = RandomResults(seed).draw();
    const std::string text = text_of(results);
    const Results again = read_text_of(text);
    QCOMPARE(QString::fromStdString(text_of(again)), QString::fromStdString(text));
    // The table itself, without the help of JSON.
    std::ostringstream table, table_again;
    write_csv(table, results);
    write_csv(table_again, again);
    QCOMPARE(QString::fromStdString(table_again.str()), QString::fromStdString(table.str()));
    QCOMPARE(again.rows.size(), results.rows.size());
    for (std::size_t i = 0; i < results.rows.size(); ++i, ++rows) {
      QVERIFY(again.rows[i].contestant == results.rows[i].contestant);
      QVERIFY(again.rows[i].figures == results.rows[i].figures);
    }
  }
  QVERIFY(rows > 100);
}

/// Whatever a member is replaced by, the file is read or refused by one sentence that names it.
void ReportJsonTest::damage_is_told_in_one_sentence() {
  Results results = comparison();
  results.kind = ReportKind::suite;
  results.objects[0].drags[0].reference = Convergence{{{9, {}}, {25, 0.5}}, 1.5, true, "it has converged"};
  results.rows[0].contestant.calibrated.emplace();
  const nlohmann::json whole = nlohmann::json::parse(text_of(results));
  int refused = 0, read = 0;
  const auto try_to_read = [&](const std::string& text) {
    const QString error = error_of([&] { read_text_of(text); });
    QVERIFY2(error.isEmpty() || (error.contains("report.json") && !error.contains('\n')), qPrintable(error));
    (error.isEmpty() ? read : refused) += 1;
  };
  for_each_member(whole, nlohmann::json::json_pointer(), [&](const nlohmann::json::json_pointer& at) {
    for (const nlohmann::json& other :
         {nlohmann::json(), nlohmann::json("x"), nlohmann::json(-1), nlohmann::json(1e300), nlohmann::json(true),
          nlohmann::json::array({1}), nlohmann::json::object()}) {
      nlohmann::json damaged = whole;
      damaged[at] = other;
      try_to_read(damaged.dump());
    }
  });
  QVERIFY2(refused > read, qPrintable(QString("%1 refused, %2 read").arg(refused).arg(read)));
  const std::string text = whole.dump();
  for (std::size_t length = 0; length < text.size(); length += 50) {
    const int before = refused;
    try_to_read(text.substr(0, length));
    QCOMPARE(refused, before + 1);
  }
}

void ReportJsonTest::other_files_are_refused_data() {
  QTest::addColumn<QString>("member");
  QTest::addColumn<QString>("value");
  QTest::addColumn<QString>("sentence");
  QTest::newRow("suite of version 1") << "kind"
                                      << "\"chainmail suite\""
                                      << "it is a report of version 1; run the comp";
  QTest::newRow("mesh") << "kind"
                        << "\"chainmail info\""
                        << "it is not a report; give the report.json of a comparison";
  QTest::newRow("later version") << "schema_version"
                                 << "3"
                                 << "its format has version 3, this program reads version 2";
  QTest::newRow("no such report") << "report"
                                  << "\"x\""
                                  << "there is no report 'x'";
  QTest::newRow("no objects") << "objects"
                              << "7"
                              << "'objects' ";
}

void ReportJsonTest::other_files_are_refused() {
  QFETCH(const QString, member);
  QFETCH(const QString, value);
  QFETCH(const QString, sentence);
  auto json = nlohmann::json::parse(text_of(comparison()));
  json[member.toStdString()] = nlohmann::json::parse(value.toStdString());
  const QString error = error_of([&] { read_text_of(json.dump()); });
  QVERIFY2(error.contains("report.json: " + sentence), qPrintable(error));
}

CHAINMAIL_TEST(ReportJsonTest)

}  // namespace chainmail::test_report_json

#include "test_report_json.moc"
