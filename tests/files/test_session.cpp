#include <QtTest>
#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>

#include "core/families.h"
#include "files/session_support.h"
#include "files/text/base64.h"
#include "files/text/limits.h"
#include "folders.h"
#include "mesh/cells.h"
#include "program.h"

namespace chainmail::test_session {

using namespace chainmail::test;

namespace fs = std::filesystem;

/// A saved session reads back bit by bit, and sessions of version 1 must always open.
class SessionTest : public QObject {
  Q_OBJECT

 private slots:
  void what_is_written_reads_back_data();
  void what_is_written_reads_back();
  void each_setting_comes_back_alone();
  void a_frame_comes_back();
  void polygons_and_loose_elements_do_too();
  void a_picture_comes_back_with_its_sheet();
  void bytes_are_written_in_base_64();
  void every_float_comes_back_to_the_bit();
  void what_was_written_once_opens();
  void moves_of_version_1_are_isotropic();
  void the_file_is_json_as_it_is_documented();
  void a_split_object_comes_back_with_its_moves();
  void moves_without_end_are_left_out();
  void a_long_name_is_written_shortened();
  void numbers_that_are_none_are_not_written();
  void saving_is_whole_or_not_at_all();
  void long_work_comes_to_its_end_and_is_cancelled();

 private:
  static void compare(const Session& again, const Session& session);
  static bool same_bits(const std::vector<double>& a, const std::vector<double>& b) {
    return std::ranges::equal(a, b, {}, std::bit_cast<std::uint64_t, double>, std::bit_cast<std::uint64_t, double>);
  }
};

/// Puts a number into the positions of the first panel.
static void spoil(Session& session, double number) {
  auto& block = session.panels[0].positions.blocks[0];
  auto held = *block;
  held[0] = number;
  block = std::make_shared<const std::vector<double>>(held);
}

void SessionTest::what_is_written_reads_back_data() {
  QTest::addColumn<int>("which");
  int i = 0;
  for (const MeshFamily& family : families()) {
    if (family.mesh->element_count() >= 9 && family.mesh->link_count() > 4) {
      QTest::newRow(family.name.c_str()) << i;
    }
    ++i;
  }
}

void SessionTest::compare(const Session& again, const Session& session) {
  const Mesh &mesh = *again.mesh, &before = *session.mesh;
  QVERIFY(same_bits(mesh.rest, before.rest));
  QVERIFY(mesh.links == before.links && mesh.neighbours == before.neighbours);
  QVERIFY(mesh.first_entry == before.first_entry && mesh.entry_link == before.entry_link);
  QVERIFY(mesh.triangles == before.triangles && mesh.own_triangles == before.own_triangles);
  QVERIFY(mesh.polygons == before.polygons && mesh.tetrahedra == before.tetrahedra);
  QVERIFY(mesh.axes == before.axes && mesh.origin == before.origin && mesh.is_grid == before.is_grid);
  QCOMPARE(mesh.object_dimension, before.object_dimension);
  QCOMPARE(mesh.lattice.has_value(), before.lattice.has_value());
  QVERIFY(again.cuts == session.cuts && again.pins == session.pins && *again.softness == *session.softness);
  QVERIFY(again.relaxation == session.relaxation);
  QVERIFY(again.elastic == session.elastic);
  QCOMPARE(again.panels.size(), session.panels.size());
  for (std::size_t i = 0; i < again.panels.size(); ++i) {
    const auto &panel = again.panels[i], &one = session.panels[i];
    QVERIFY(panel.algorithm == one.algorithm && panel.precision == one.precision);
    const auto positions = runs_of(panel.positions, mesh), expected = runs_of(one.positions, mesh);
    QVERIFY(positions == expected && same_bits(positions.held, expected.held));
  }
  QCOMPARE(again.moves.size(), session.moves.size());
  QCOMPARE(again.moves_done, session.moves_done);
  QCOMPARE(again.name, session.name);
  QCOMPARE(again.ui, session.ui);
}

void SessionTest::what_is_written_reads_back() {
  QFETCH(int, which);
  const Session session = session_on(families()[static_cast<std::size_t>(which)].mesh);
  const std::string text = session_text(session);
  const Session again = parse_session(text, "a.chainmail");
  compare(again, session);
  QCOMPARE(session_text(again), text);
}

/// Returns settings that differ from the standard ones in one number each.
template <class Struct>
static std::vector<Struct> changed_in_one() {
  std::vector<Struct> all;
  for (const Member<Struct>& member : members_of<Struct>) {
    for (std::size_t i = 0; i < member.count; ++i) {
      Struct& one = all.emplace_back();
      const double before = member.get(one, i);
      member.set(one, i, member.number ? (before + member.number->lowest) / 2 : 1 - before);
    }
  }
  return all;
}

void SessionTest::each_setting_comes_back_alone() {
  Session session;
  session.mesh = made(MeshKind::line, {2, 1, 1});
  session.panels.resize(1);
  const auto again = [&] { return parse_session(session_text(session), "a.chainmail"); };
  for (const ElasticOptions& elastic : changed_in_one<ElasticOptions>()) {
    session.elastic = elastic;
    QVERIFY(elastic != ElasticOptions() && again().elastic == elastic);
  }
  for (const auto& relaxation : changed_in_one<commands::SetRelaxation>()) {
    session.relaxation = relaxation;
    QVERIFY(relaxation != commands::SetRelaxation() && again().relaxation == relaxation);
  }
  for (const LinkSoftness& global : changed_in_one<LinkSoftness>()) {
    session.softness = std::make_shared<const Softness>(Softness{global, {}});
    QVERIFY(global != LinkSoftness() && again().softness->global == global);
  }
}

void SessionTest::a_frame_comes_back() {
  Session session = session_on(generate({MeshKind::tetra, {3, 3, 3}, 1, {}}));
  QVERIFY(!QString::fromStdString(session_text(session)).contains(QStringLiteral("frame")));
  const RegionAxes frame(AxesKind::object, {0.1, 1.0 / 3, -0.7});
  Softness softness = *session.softness;
  softness.axes = frame;
  session.softness = std::make_shared<const Softness>(softness);
  session.panels[0].positions.axes = RegionAxes(AxesKind::given, frame.rotation());
  session.moves.insert(session.moves.begin(), commands::SetSoftness{session.softness});
  const std::string text = session_text(session);
  const Session again = parse_session(text, "a.chainmail");
  compare(again, session);
  QVERIFY(*std::get<commands::SetSoftness>(again.moves[0]).softness == softness);
  QVERIFY(again.panels[1].positions.axes == RegionAxes());
  QCOMPARE(session_text(again), text);
}

void SessionTest::polygons_and_loose_elements_do_too() {
  Session session;
  session.panels.resize(1);
  session.mesh = obj("v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 0 2 5\nv 9 9 9\nf 1 2 3 4\nf 4 3 5\nf 1 2 3 5 4\n");
  compare(parse_session(session_text(session), "a.chainmail"), session);
  session.mesh = obj("v 0.5 0 0\n");
  compare(parse_session(session_text(session), "a.chainmail"), session);
}

void SessionTest::a_picture_comes_back_with_its_sheet() {
  std::mt19937_64 random(9);
  for (const auto& size : {std::array<std::uint32_t, 3>{21, 13, 1}, {3, 4, 5}}) {
    Texture texture{size, size[2] == 1 ? 4 : 1, {}, {Point(-0.1, 0, 1.0 / 3), Point(21, 13, 1.0 / 3)}};
    for (std::size_t i = 0; i < texture.byte_count(); ++i) {
      texture.texels.push_back(static_cast<std::uint8_t>(random()));
    }
    Session session = session_on(made(MeshKind::cloth, {4, 4, 1}));
    auto mesh = std::make_shared<Mesh>(*session.mesh);
    mesh->texture = std::make_shared<const Texture>(texture);
    session.mesh = mesh;
    const Session again = parse_session(session_text(session), "a.chainmail");
    compare(again, session);
    QCOMPARE(again.mesh->texture->size, texture.size);
    QCOMPARE(again.mesh->texture->channels, texture.channels);
    QVERIFY(again.mesh->texture->texels == texture.texels && again.mesh->texture->box == texture.box);
  }
}

void SessionTest::bytes_are_written_in_base_64() {
  const auto bytes = [](const char* text) { return std::vector<std::uint8_t>(text, text + std::strlen(text)); };
  // The examples of RFC 4648.
  for (const auto& [plain, text] : std::vector<std::pair<const char*, const char*>>{
           {"", ""}, {"f", "Zg=="}, {"fo", "Zm8="}, {"foo", "Zm9v"}, {"foobar", "Zm9vYmFy"}}) {
    std::ostringstream out;
    TextBlocks blocks(out);
    Base64Writer writer(blocks);
    for (const std::uint8_t byte : bytes(plain)) {
      writer.add(byte);
    }
    writer.finish();
    blocks.flush();
    QCOMPARE(out.str(), std::string(text));
    QVERIFY(from_base64(text) == bytes(plain));
  }
  for (const char* wrong : {"Zg=", "Zg", "Z===", "====", "Zm9=Zm9v", "Zm9\n", "Zm 9", "Zh==", "Zm9v\xff\xff\xff\xff"}) {
    QVERIFY2(!from_base64(wrong), wrong);
  }
}

void SessionTest::every_float_comes_back_to_the_bit() {
  Session session;
  session.mesh = made(MeshKind::line, {50'000, 1, 1});
  const auto single = Precision::single_precision;
  session.panels = {{Algorithm::natural_queue, single,
                     snapshot_of({false, {0, 50'000}, odd_floats(50'000, 1)}, *session.mesh, single)}};
  compare(parse_session(session_text(session), "a.chainmail"), session);
}

/// This file must never be written again, because it is an example of version 1.
void SessionTest::what_was_written_once_opens() {
  const Session session = read_session(source_file("tests/files/sessions/version1.chainmail"));
  QCOMPARE(session.name, std::string("cloth 3 × 3"));
  QCOMPARE(session.mesh->element_count(), 9U);
  QCOMPARE(session.mesh->link_count(), 16U);
  QCOMPARE(session.mesh->own_triangles, std::size_t{8});
  QVERIFY(session.mesh->lattice && session.mesh->space_dimension == 2);
  QCOMPARE(session.cuts, (std::vector<LinkId>{*find_link(*session.mesh, 0, 1), *find_link(*session.mesh, 4, 5)}));
  QCOMPARE(session.pins, (std::vector<ElementId>{0, 8}));
  const LinkId own = *find_link(*session.mesh, 3, 4);
  QVERIFY((*session.softness == Softness{{0.5, 1.25, 0.1}, {{own, {1, 1, 0}}}, EnergyKind::isotropic}));
  QVERIFY((session.relaxation == commands::SetRelaxation{false, 0.5, RelaxationScheme::link}));
  QCOMPARE(session.panels.size(), std::size_t{2});
  QVERIFY(session.panels[0].algorithm == Algorithm::exact && session.panels[1].algorithm == Algorithm::natural_queue);
  const auto one = runs_of(session.panels[0].positions, *session.mesh);
  QVERIFY(one.from_rest);
  QCOMPARE(one.held, (std::vector<double>{0, 0, 0, 0, 0.1F, -0.0, 1.0F / 3, -2, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0}));
  QVERIFY(std::signbit(one.held[5]));
  auto expected = session.mesh->rest;
  expected[16] = 2.5;
  expected[17] = 2.25;
  const auto other = runs_of(session.panels[1].positions, *session.mesh);
  QVERIFY(!other.from_rest && other.held == expected);
  QCOMPARE(session.ui, std::string(R"({"colour":"plain"})"));
}

/// Version 1 knew only isotropic energy, which its moves need in order to be replayed as they were.
void SessionTest::moves_of_version_1_are_isotropic() {
  std::string text = file_text(source_file("tests/files/sessions/version1.chainmail"));
  const std::string moves = R"("moves": {"version": 1, "commands": [{"do": "grab", "element": 4},
      {"do": "softness", "compression": 0.5, "stretch": 2, "shear": 0, "links": [[3, 4, 1, 1, 0]]}]},
      "moves_done": 1, )";
  text.insert(text.rfind("\"ui\""), moves);
  const Session session = parse_session(text, "a.chainmail");
  QCOMPARE(session.moves.size(), std::size_t{3});
  QCOMPARE(session.moves_done, std::size_t{2});
  QVERIFY(*std::get<commands::SetSoftness>(session.moves[0]).softness == (Softness{{}, {}, EnergyKind::isotropic}));
  QVERIFY(std::holds_alternative<commands::Grab>(session.moves[1]));
  const LinkId own = *find_link(*session.mesh, 3, 4);
  QVERIFY(*std::get<commands::SetSoftness>(session.moves[2]).softness ==
          (Softness{{0.5, 2, 0}, {{own, {1, 1, 0}}}, EnergyKind::isotropic}));
}

void SessionTest::the_file_is_json_as_it_is_documented() {
  Session session = session_on(made(MeshKind::grid, {3, 3, 1}));
  session.panels.resize(1);
  session.panels[0].positions = snapshot_of({true, {0, 2, 5, 9}, {0, 0.5, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10}},
                                            *session.mesh, Precision::single_precision);
  const auto document = QJsonDocument::fromJson(QByteArray::fromStdString(session_text(session)));
  QCOMPARE(document["format"].toString(), QStringLiteral("chainmail session"));
  QCOMPARE(document["version"].toInt(), 2);
  QCOMPARE(document["softness"]["energy"].toString(), QStringLiteral("corotated"));
  QCOMPARE(document["softness"]["stiffness"].toDouble(), 3.5);
  QCOMPARE(document["name"].toString(), QString::fromStdString(session.name));
  QCOMPARE(document["mesh"]["elements"].toInt(), 9);
  QCOMPARE(document["mesh"]["rest"].toArray().size(), 27);
  QCOMPARE(document["mesh"]["links"].toArray().size(), 24);
  QCOMPARE(document["cuts"].toArray(), (QJsonArray{0, 1, 1, 4}));
  QCOMPARE(document["pins"].toArray(), (QJsonArray{1, 8}));
  QCOMPARE(document["softness"]["own"].toArray(),
           (QJsonArray{1, 2, 0, 1, 7, 0.3, 1e-9, 2.5, 2, 5, 0.8, 1.2, 0.1, 1, 1, -1}));
  QCOMPARE(document["relaxation"]["scheme"].toString(), QStringLiteral("link"));
  QCOMPARE(document["moves"]["commands"][3]["target"].toArray(), (QJsonArray{0.1, 1.0 / 3, 0}));
  QCOMPARE(document["moves_done"].toInt(), 4);
  QCOMPARE(document["panels"][0]["algorithm"].toString(), QStringLiteral("exact"));
  QCOMPARE(document["panels"][0]["runs"].toArray(), (QJsonArray{0, 9}));
  QCOMPARE(document["panels"][0]["held"].toArray(),
           (QJsonArray{0, 0.5, 1, 2, 0, 0, 0, 0, 0, 0, 3, 4, 5, 6, 7, 8, 9, 10}));
}

/// Parts that would be too large to open again are not saved; the object itself always is.
void SessionTest::a_split_object_comes_back_with_its_moves() {
  MeshParts parts;
  parts.rest = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
  parts.triangles = {{0, 1, 2}, {0, 2, 3}};
  add_links_along_edges(parts);
  const MeshPointer mesh = build_mesh(std::move(parts));
  const auto split = make_split(mesh, {{SplitPoint::copy(0), SplitPoint::copy(2)}, {1}, {{4, 5, 3}}, {}, {}});
  const MeshPointer divided = split->after();
  Session session;
  session.mesh = divided;
  session.pins = {5};
  session.cuts = {*find_link(*divided, 4, 5)};
  session.moves = {commands::Grab{1}, commands::Drag{{0.5, 1, 0}}, commands::Split{split}, commands::Pin{{5}}};
  session.panels = {{Algorithm::natural_queue, Precision::single_precision,
                     snapshot_of({false, {4, 6}, {1, 2, 3, 4}}, *divided, Precision::single_precision)}};
  for (const std::size_t done : {4U, 3U, 2U}) {
    session.moves_done = done;
    if (done == 2) {  // the split has been undone
      session.mesh = mesh;
      session.pins = session.cuts = {};
      session.panels[0].positions = {};
    }
    const Session again = parse_session(session_text(session), std::filesystem::path("s.chainmail"));
    QCOMPARE(session_text(again), session_text(session));
    QCOMPARE(again.mesh->element_count(), session.mesh->element_count());
    QCOMPARE(again.mesh->links, session.mesh->links);
    QCOMPARE(again.moves.size(), 4U);
    const auto& saved = *std::get<commands::Split>(again.moves[2]).split;
    QCOMPARE(again.mesh, done > 2 ? saved.after() : saved.before());
    QCOMPARE(again.pins, session.pins);
    QCOMPARE(again.cuts, session.cuts);
  }
}

void SessionTest::moves_without_end_are_left_out() {
  Session session = session_on(made(MeshKind::grid, {40, 40, 1}));
  session.panels.resize(1);
  session.panels[0].positions = {};
  Softness softness;
  for (LinkId link = 0; link < 3000; ++link) {
    softness.links.set(link, {1, 1, 0});
  }
  const commands::SetSoftness own{softness};
  session.moves.assign(limits::session_moves / 3001, own);
  session.moves_done = 1;
  const Session most = parse_session(session_text(session), "a.chainmail");
  QCOMPARE(most.moves.size(), session.moves.size());
  session.moves.push_back(own);
  const Session beyond = parse_session(session_text(session), "a.chainmail");
  QVERIFY(beyond.moves.empty());
  QCOMPARE(beyond.cuts, session.cuts);
}

/// What the window writes, it opens again: names of objects grow with "filled" and "repaired".
void SessionTest::a_long_name_is_written_shortened() {
  Session session = session_on(generate({MeshKind::grid, {3, 3, 1}, 1, {}}));
  for (int i = 0; i < 100; ++i) {
    session.name += "∆, repaired";
  }
  const std::string name = parse_session(session_text(session), "a.chainmail").name;
  QVERIFY(name.size() <= limits::name_bytes && name.size() > limits::name_bytes - 4);
  QVERIFY(name.ends_with("…") && session.name.starts_with(name.substr(0, name.size() - 3)));
}

void SessionTest::numbers_that_are_none_are_not_written() {
  for (const double none : {std::nan(""), HUGE_VAL}) {
    Session session = session_on(made(MeshKind::grid, {3, 3, 1}));
    spoil(session, none);
    QVERIFY(error_of([&] { session_text(session); }).startsWith("session: a coordinate is not a finite number; "));
  }
}

void SessionTest::saving_is_whole_or_not_at_all() {
  const QTemporaryDir folder;
  const fs::path path = folder.filePath("a.chainmail").toStdString();
  Session session = session_on(made(MeshKind::cloth, {4, 3, 1}));
  save_session(path, session);
  compare(read_session(path), session);
  const std::string before = file_text(path);
  spoil(session, std::nan(""));
  QVERIFY(!error_of([&] { save_session(path, session); }).isEmpty());
  QCOMPARE(file_text(path), before);
  QCOMPARE(files_in(folder.path().toStdString()), 1);
}

void SessionTest::long_work_comes_to_its_end_and_is_cancelled() {
  const QTemporaryDir folder;
  const fs::path path = folder.filePath("a.chainmail").toStdString();
  const Session session = session_on(made(MeshKind::tetra, {20, 20, 20}));
  const Progress writing = Progress::watched(), reading = Progress::watched(), cancelled = Progress::watched();
  save_session(path, session, writing);
  QVERIFY(writing.share() > 0.5 && writing.share() <= 1);
  compare(read_session(path, reading), session);
  QVERIFY(reading.share() > 0.9 && reading.share() <= 1);
  cancelled.cancel();
  QVERIFY_THROWS_EXCEPTION(Cancelled, read_session(path, cancelled));
  QVERIFY_THROWS_EXCEPTION(Cancelled, parse_session(file_text(path), path, cancelled));
  fs::remove(path);
  QVERIFY_THROWS_EXCEPTION(Cancelled, save_session(path, session, cancelled));
  QCOMPARE(files_in(folder.path().toStdString()), 0);
}

CHAINMAIL_TEST(SessionTest)

}  // namespace chainmail::test_session

#include "test_session.moc"
