#include <QTemporaryDir>
#include <QtTest>
#include <limits>
#include <set>

#include "files/session/softness_presets.h"
#include "files/support.h"
#include "files/text/limits.h"
#include "program.h"

namespace chainmail::test_presets {

using namespace chainmail::test;

/// Tests presets of softness as JSON.
class PresetsTest : public QObject {
  Q_OBJECT

 private slots:
  void those_built_in_are_softness();
  void what_is_written_reads_back();
  void names();
  void their_number_is_limited();
  void other_files_are_refused_data();
  void other_files_are_refused();
  void files();
};

namespace {

std::vector<SoftnessPreset> read(const std::string& text) {
  return read_presets(text, std::filesystem::path("p.json"));
}

std::string with(const std::string& preset) { return R"({"version": 1, "presets": [)" + preset + "]}"; }

const std::string felt = R"({"name": "felt", "compression": 0.7, "stretch": 1.1, "shear": 0.2})";

}  // namespace

void PresetsTest::those_built_in_are_softness() {
  std::set<std::string_view> known;
  for (const BuiltInPreset& preset : built_in_presets()) {
    QCOMPARE(error_of([&] { check(preset.softness); }), QString());
    QVERIFY(!preset.reason.empty());
    QCOMPARE(fault_of_name(preset.name), std::string());
    known.insert(preset.name);
    for (const BuiltInPreset& other : built_in_presets()) {
      QVERIFY(preset.name == other.name ||
              preset.softness != other.softness);  // the interface shows one of them as chosen
    }
  }
  QCOMPARE(known.size(), built_in_presets().size());
  QVERIFY(built_in_presets().front().softness == LinkSoftness());
}

void PresetsTest::what_is_written_reads_back() {
  const std::vector<SoftnessPreset> presets{{"felt", {0.1 + 0.2, 1 + std::numeric_limits<double>::epsilon(), 1e-300}},
                                            {"a \"b\" \\ <Grüße>", {0, 1e100, 0}},
                                            {"x", {1, 1, 1. / 3, 2. / 3, 1e-9, 0.1}}};
  std::ostringstream out;
  write_presets(out, presets);
  QVERIFY(read(out.str()) == presets);
  out.str({});
  write_presets(out, {});
  QVERIFY(read(out.str()).empty());
}

void PresetsTest::names() {
  for (const char* name : {"a", "wet clay 2", "Grüße", "50 %"}) {
    QCOMPARE(fault_of_name(name), std::string());
  }
  const std::string longest(limits::preset_name_bytes, 'x');
  QVERIFY(fault_of_name(longest).empty());
  for (const std::string& name : {std::string(), std::string(" "), std::string(" a"), std::string("a "), longest + "x",
                                  std::string("a\nb"), std::string("\xff")}) {
    QVERIFY(!fault_of_name(name).empty());
  }
}

void PresetsTest::their_number_is_limited() {
  std::vector<SoftnessPreset> presets(limits::presets);
  for (std::size_t i = 0; i < presets.size(); ++i) {
    presets[i].name = std::to_string(i);
  }
  std::ostringstream most;
  write_presets(most, presets);
  QCOMPARE(read(most.str()).size(), limits::presets);
  presets.push_back({"one more", {}});
  std::ostringstream more;
  write_presets(more, presets);
  QCOMPARE(error_of([&] { read(more.str()); }), QString("p.json: it contains 1001 presets; use at most 1000"));
  // Other values are counted before memory is taken for them.
  std::string values = R"({"version": 1, "presets": [0)";
  for (std::size_t i = 0; i < limits::json_values; ++i) {
    values += ",0";
  }
  QCOMPARE(error_of([&] { read(values + "]}"); }),
           QString("p.json: it contains too many values; use a file with presets of softness"));
  // An object with a key takes the memory of ten.
  std::string objects = R"({"version": 1, "presets": [{"":0})";
  for (std::size_t i = 0; i < limits::json_values / 10; ++i) {
    objects += R"(,{"":0})";
  }
  QCOMPARE(error_of([&] { read(objects + "]}"); }),
           QString("p.json: it contains too many values; use a file with presets of softness"));
}

void PresetsTest::other_files_are_refused_data() {
  QTest::addColumn<QString>("text");
  QTest::addColumn<QString>("said");
  const auto row = [](const std::string& text, const char* said) {
    QTest::newRow(said) << QString::fromStdString(text) << QString(said);
  };
  row("{", "p.json:1: it ends too early; use a file with presets of softness");
  row("[]", "p.json: it contains no presets; ");
  row("{}", "p.json: 'version' is missing; ");
  row(R"({"version": 2, "presets": []})", "p.json: its version is 2, but this program knows only version 1; ");
  row(R"({"version": 1})", "p.json: 'presets' is missing; ");
  row(R"({"version": 1, "presets": {}})", "p.json: 'presets' is not an array; ");
  row(R"({"version": 1, "presets": [], "x": 1})", "p.json: 'x' is not a known key; ");
  row(with("3"), "p.json: preset 0: it is not an object; ");
  row(with(felt + R"(, {"name": 5})"), "p.json: preset 1: 'name' is not a text; ");
  row(with(R"({"name": " "})"), "p.json: preset 0: ' ' is not a valid name; ");
  row(with(R"({"name": "a"})"), "p.json: preset 0: 'compression' is missing; ");
  row(with(R"({"name": "a", "name": "b"})"), "p.json: 'name' appears twice; ");
  row(with(R"({"name": "a", "colour": 1})"), "p.json: preset 0: 'colour' is not a known key; ");
  row(with(R"({"name": "a", "compression": "1", "stretch": 1, "shear": 0})"),
      "p.json: preset 0: '\"1\"' is not a number; ");
  row(with(R"({"name": "a", "compression": 1, "stretch": 0.9, "shear": 0})"), "p.json: preset 0: stretch: ");
  row(with(R"({"name": "a", "compression": 1, "stretch": 1, "shear": 0, "exponent": 5})"),
      "p.json: preset 0: exponent: ");
  row(with(felt + "," + felt), "p.json: preset 1: 'felt' appears twice; ");
  row(std::string(99, '['), "p.json: it is nested too deeply; ");
}

void PresetsTest::other_files_are_refused() {
  QFETCH(QString, text);
  QFETCH(QString, said);
  const QString error = error_of([&] { read(text.toStdString()); });
  QVERIFY2(error.startsWith(said), qPrintable(error));
}

void PresetsTest::files() {
  const QTemporaryDir folder;
  const std::filesystem::path path = folder.filePath("p.json").toStdString();
  QVERIFY(error_of([&] { read_presets(path); }).contains("there is no such file; "));
  put_file(path, with(felt));
  QVERIFY(read_presets(path) == (std::vector<SoftnessPreset>{{"felt", {0.7, 1.1, 0.2}}}));
}

CHAINMAIL_TEST(PresetsTest)

}  // namespace chainmail::test_presets

#include "test_presets.moc"
