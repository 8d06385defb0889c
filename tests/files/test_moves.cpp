#include <QTemporaryDir>
#include <QtTest>
#include <cmath>
#include <ctime>

#include "core/allocations.h"
#include "files/session/moves.h"
#include "files/support.h"
#include "mesh/cells.h"
#include "program.h"
#include "simulate/simulation.h"

namespace chainmail::test_moves {

using namespace chainmail::test;

/// Tests recorded moves as JSON. The grid of 3x2 has the links 0-1, 0-3, 1-2, 1-4, 2-5, 3-4, 4-5, in this order.
class MovesTest : public QObject {
  Q_OBJECT

 private slots:
  void commands_are_read();
  void a_handle_of_many_is_read();
  void what_is_written_reads_back();
  void splits_are_written_and_read();
  void what_is_known_of_the_object_follows_a_split();
  void splits_of_cells_are_written_and_read();
  void splits_that_do_not_fit_are_refused_data();
  void splits_that_do_not_fit_are_refused();
  void a_drag_after_a_split_needs_a_grab();
  void many_splits_are_refused_before_they_take_memory();
  void what_is_not_the_objects_is_left_out();
  void a_change_of_mesh_is_not_written();
  void other_files_are_refused_data();
  void other_files_are_refused();
  void other_commands_are_refused_data();
  void other_commands_are_refused();
  void deep_nesting_is_refused();
  void damaged_files_never_do_worse();
  void keys_come_in_any_order();
  void a_key_that_stands_twice_is_refused_data();
  void a_key_that_stands_twice_is_refused();
  void what_is_wrong_with_the_file_comes_before_its_commands();
  void a_large_file_takes_little_memory_besides_its_commands_data();
  void a_large_file_takes_little_memory_besides_its_commands();
  void frames_of_the_object_are_found_once();
  void reading_and_writing_can_be_cancelled();
  void files();

 private:
  std::vector<Command> read(const std::string& text) const {
    return read_moves(text, std::filesystem::path("m.json"), mesh_);
  }
  std::string written(const std::vector<Command>& moves) const {
    std::ostringstream out;
    write_moves(out, moves, *mesh_);
    return out.str();
  }

  MeshPointer mesh_ = made(MeshKind::grid, {3, 2, 1});
};

namespace {

const std::string every_command = R"({"version": 1, "commands": [
  {"do": "grab", "element": 5}, {"do": "drag", "target": [1, -2.5, 0]}, {"do": "release"},
  {"do": "cut", "links": [[1, 0], [4, 5]]}, {"do": "uncut", "links": [[0, 1]]},
  {"do": "pin", "elements": [3, 0]}, {"do": "unpin", "elements": [3]}, {"do": "reset"},
  {"do": "softness", "compression": 0.5, "stretch": 2, "shear": 0, "links": [[3, 0, 1, 1, 0.25]]}]})";

std::string with_commands(const std::string& commands) { return R"({"version": 1, "commands": [)" + commands + "]}"; }

}  // namespace

void MovesTest::commands_are_read() {
  const auto moves = read(every_command);
  QCOMPARE(moves.size(), std::size_t{9});
  QCOMPARE(std::get<commands::Grab>(moves[0]).elements, std::vector<ElementId>{5});
  QVERIFY(std::get<commands::Drag>(moves[1]).target == Point(1, -2.5, 0));
  QVERIFY(std::holds_alternative<commands::Release>(moves[2]));
  QCOMPARE(std::get<commands::Cut>(moves[3]).links, (std::vector<LinkId>{0, 6}));
  QCOMPARE(std::get<commands::Uncut>(moves[4]).links, std::vector<LinkId>{0});
  QCOMPARE(std::get<commands::Pin>(moves[5]).elements, (std::vector<ElementId>{3, 0}));
  QCOMPARE(std::get<commands::Unpin>(moves[6]).elements, std::vector<ElementId>{3});
  QVERIFY(std::holds_alternative<commands::Reset>(moves[7]));
  QVERIFY(
      (*std::get<commands::SetSoftness>(moves[8]).softness == Softness{{0.5, 2, 0}, {{1, {1, 1, 0.25}}}, link_energy}));
  // A simulation accepts the commands that were read.
  Simulation simulation(mesh_, Algorithm::exact, Precision::double_precision);
  for (const Command& move : moves) {
    simulation.apply(move);
  }
  QVERIFY(read(with_commands("")).empty());
  // An unpinned element may be grabbed again, and a released one may be pinned.
  QCOMPARE(read(with_commands(R"({"do": "pin", "elements": [2]}, {"do": "unpin", "elements": [2]},
                                 {"do": "grab", "element": 2}, {"do": "release"}, {"do": "pin", "elements": [2]})"))
               .size(),
           std::size_t{5});
}

void MovesTest::a_handle_of_many_is_read() {
  const auto moves = read(with_commands(R"({"do": "grab", "elements": [4, 1]}, {"do": "drag", "by": [1, 0.5, 0]},
      {"do": "drag", "rotate": {"axis": [0, 0, 2], "degrees": 30}},
      {"do": "drag", "target": [1, 2, 0], "rotate": {"axis": [0, 0, 1], "degrees": -5}})"));
  QCOMPARE(moves.size(), std::size_t{4});
  QCOMPARE(std::get<commands::Grab>(moves[0]).elements, (std::vector<ElementId>{4, 1}));
  const auto drag = [&](std::size_t i) { return std::get<commands::Drag>(moves[i]); };
  QVERIFY(drag(1).relative && drag(1).target == Point(1, 0.5, 0) && drag(1).rotation == Rotation());
  QVERIFY(drag(2).relative && drag(2).target == Point(0, 0, 0) && drag(2).rotation == (Rotation{Point(0, 0, 2), 30}));
  QVERIFY(!drag(3).relative && drag(3).target == Point(1, 2, 0) && drag(3).rotation.degrees == -5);
  QCOMPARE(written(read(written(moves))), written(moves));
  Simulation simulation(mesh_, Algorithm::exact, Precision::double_precision);
  for (const Command& move : moves) {
    simulation.apply(move);
  }
  QCOMPARE(simulation.grabbed().size(), std::size_t{2});
}

void MovesTest::what_is_written_reads_back() {
  // Numbers that need many digits.
  const Point odd(0.1, 1.0 / 3, -1e-300), large(1e100, -0.0, 123456789.123456789);
  const std::vector<Command> moves{
      commands::Grab{4},
      commands::Drag{odd},
      commands::Drag{large},
      commands::Release{},
      commands::Cut{{0, 6}},
      commands::Uncut{{}},
      commands::SetSoftness{{{1.0 / 3, 1.1, 0.7}, {{2, {0, 1e9, 0}}, {5, {1, 1, 0}}}}},
      commands::SetSoftness{{{0, 1, 0, 0.3, 2, -2}, {{5, {1, 1, 0, 0, 3, 4}}}, EnergyKind::corotated}},
      commands::Relax{3, 0.1, RelaxationScheme::link},
      commands::Reset{},
      commands::Relax{200, 1, RelaxationScheme::equilibrium, 1.0 / 3},
      commands::Relax{200, 1, RelaxationScheme::equilibrium, 0, true}};
  const std::string text = written(moves);
  const auto again = read(text);
  QCOMPARE(again.size(), moves.size());
  QCOMPARE(written(again), text);
  QVERIFY(std::get<commands::Drag>(again[1]).target == odd);
  QVERIFY(std::get<commands::Drag>(again[2]).target == large);
  QVERIFY(*std::get<commands::SetSoftness>(again[6]).softness == *std::get<commands::SetSoftness>(moves[6]).softness);
  QVERIFY(*std::get<commands::SetSoftness>(again[7]).softness == *std::get<commands::SetSoftness>(moves[7]).softness);
  QCOMPARE(written(read(written(read(every_command)))), written(read(every_command)));
  QVERIFY(std::get<commands::Relax>(again[10]).scheme == RelaxationScheme::equilibrium);
  QCOMPARE(std::get<commands::Relax>(again[10]).until, 1.0 / 3);
  QVERIFY(!std::get<commands::Relax>(again[10]).local && std::get<commands::Relax>(again[11]).local);
}

namespace {

/// Two triangles.
MeshPointer two_triangles() {
  MeshParts parts;
  parts.rest = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
  parts.triangles = {{0, 1, 2}, {0, 2, 3}};
  add_links_along_edges(parts);
  return build_mesh(std::move(parts));
}

}  // namespace

/// Commands after a split are about the object after it.
void MovesTest::splits_are_written_and_read() {
  const MeshPointer mesh = two_triangles();
  const auto split = make_split(mesh, {{SplitPoint::copy(0), SplitPoint::copy(2)}, {1}, {{4, 5, 3}}, {}, {}});
  const MeshPointer divided = split->after();
  const std::vector<Command> moves{commands::Pin{{0}}, commands::Split{split}, commands::Grab{5},
                                   commands::Drag{{1.0 / 3, 2, 0}}, commands::Cut{{*find_link(*divided, 4, 5)}}};
  std::ostringstream out;
  write_moves(out, moves, *divided);
  QVERIFY(out.str().starts_with(R"({"version": 2,)"));
  const auto again = read_moves(out.str(), std::filesystem::path("m.json"), mesh);
  QCOMPARE(again.size(), moves.size());
  QCOMPARE(std::get<commands::Split>(again[1]).split->edit(), split->edit());
  QCOMPARE(std::get<commands::Split>(again[1]).split->before(), mesh);
  QCOMPARE(std::get<commands::Cut>(again[4]).links, std::get<commands::Cut>(moves[4]).links);
  std::ostringstream twice;
  write_moves(twice, again, *mesh);
  QCOMPARE(twice.str(), out.str());
}

/// A rectangle of 2 by 1 with copies of two opposite corners: its spreads are 6 and 1.5, mixed 1.
void MovesTest::what_is_known_of_the_object_follows_a_split() {
  MeshParts parts;
  parts.rest = {{0, 0, 0}, {2, 0, 0}, {2, 1, 0}, {0, 1, 0}};
  parts.triangles = {{0, 1, 2}, {0, 2, 3}};
  add_links_along_edges(parts);
  const MeshPointer mesh = build_mesh(std::move(parts));
  const std::string softness =
      R"({"do": "softness", "compression": 1, "stretch": 1, "shear": 0, "frame": {"kind": "object"}})";
  const std::string split =
      R"({"do": "split", "elements": [[0, 0, 0, 0, 0], [2, 2, 2, 0, 0]], "removed": [1], "triangles": [[4, 5, 3]]})";
  const auto read = [&](const std::string& commands) {
    return read_moves(with_commands(commands), std::filesystem::path("m.json"), mesh);
  };
  const auto moves = read(softness + ", " + split + ", " + softness);
  const auto axes = [&](std::size_t i) { return std::get<commands::SetSoftness>(moves[i]).softness->axes; };
  QVERIFY(axes(0).kind() == AxesKind::object && axes(2).kind() == AxesKind::object);
  QCOMPARE(axes(0).rotation(), Point(0, 0, 0));
  QVERIFY((axes(2).rotation() - Point(0, 0, std::atan2(2 * 1, 6 - 1.5) / 2)).norm() < 1e-12);
  // The copy of a pinned element is pinned.
  const std::string pin = R"({"do": "pin", "elements": [0]}, )", grab = R"(, {"do": "grab", "element": )";
  QVERIFY(error_of([&] { read(pin + split + grab + "4}"); }).startsWith("m.json: command 2: element 4 is pinned "));
  QCOMPARE(error_of([&] { read(pin + split + grab + "5}"); }), QString());
}

void MovesTest::splits_of_cells_are_written_and_read() {
  const MeshPointer mesh = made(MeshKind::tetra, {2, 2, 2});
  const auto [a, b, c, d] = mesh->tetrahedra[3];
  const SplitEdit edit{{SplitPoint::copy(a), SplitPoint::between(b, c, 1.0 / 3)},
                       {},
                       {},
                       {},
                       {},
                       {3},
                       {{8, b, 9, d}, {8, 9, c, d}},
                       {{0, 1, 3, 2, 4, 5, 7, 6}}};
  const auto split = make_split(mesh, edit);
  const MeshPointer divided = split->after();
  const std::vector<Command> moves{commands::Split{split}, commands::Grab{9}, commands::Drag{{1, 2, 0}}};
  std::ostringstream out;
  write_moves(out, moves, *divided);
  QVERIFY(out.str().starts_with(R"({"version": 4,)"));
  const auto again = read_moves(out.str(), std::filesystem::path("m.json"), mesh);
  const Split& read = *std::get<commands::Split>(again[0]).split;
  QCOMPARE(read.edit(), edit);
  const MeshPointer read_mesh = read.after();
  QCOMPARE(read_mesh->tetrahedra, divided->tetrahedra);
  QCOMPARE(read_mesh->hexahedra, divided->hexahedra);
  QCOMPARE(read_mesh->links, divided->links);
}

void MovesTest::splits_that_do_not_fit_are_refused_data() {
  QTest::addColumn<QString>("command");
  QTest::addColumn<QString>("sentence");
  const auto row = [](const char* command, const char* sentence) { QTest::newRow(command) << command << sentence; };
  row(R"({"do": "split"})", "m.json: command 0: 'elements' is missing; add it");
  row(R"({"do": "split", "elements": []})", "m.json: command 0: split: it changes nothing");
  row(R"({"do": "split", "elements": [[0, 0]]})", "m.json: command 0: 'elements' does not contain arrays of 5 ");
  row(R"({"do": "split", "elements": [[0, 0, 0, 0, "x"]]})", "m.json: command 0: ");
  row(R"({"do": "split", "elements": [[9, 0, 0, 0, 0]]})", "m.json: command 0: split: element 4 lies between");
  row(R"({"do": "split", "elements": [], "removed": [-1]})",
      "m.json: command 0: number 0 of 'removed' is not a whole number; ");
  row(R"({"do": "split", "elements": [], "removed": [7]})", "m.json: command 0: split: the triangles to replace");
  row(R"({"do": "split", "elements": [], "triangles": [[0, 1]]})",
      "m.json: command 0: 'triangles' does not contain arrays of 3 ");
  row(R"({"do": "split", "elements": [], "triangles": [[0, 1, 7]]})", "m.json: command 0: split: a new face");
  row(R"({"do": "split", "elements": [], "polygons": [4, 0, 1, 2]})", "m.json: command 0: split: a new polygon");
  row(R"({"do": "split", "elements": [], "tetrahedra": [[0, 1, 2, 3]]})",
      "m.json: command 0: split: it adds cells to an object without cells");
  row(R"({"do": "split", "elements": [], "hexahedra": [[0, 1, 2, 3, 0, 1, 2, 3]]})",
      "m.json: command 0: split: it adds cells to an object without cells");
  row(R"({"do": "split", "elements": [], "removed_cells": [0, 0]})",
      "m.json: command 0: split: the cells to replace are not ascending numbers below 0");
  row(R"({"do": "split", "elements": [], "polygons": [0, 0]})", "m.json: command 0: split: a new face");
  row(R"({"do": "split", "elements": [], "sides": []})", "m.json: command 0: ");
}

void MovesTest::splits_that_do_not_fit_are_refused() {
  QFETCH(QString, command);
  QFETCH(QString, sentence);
  const QString error = error_of([&] {
    read_moves(R"({"version": 2, "commands": [)" + command.toStdString() + "]}", std::filesystem::path("m.json"),
               two_triangles());
  });
  QVERIFY2(error.startsWith(sentence), qPrintable(error));
}

/// Each split keeps a mesh: what counts are the elements, links and triangles of all of them.
void MovesTest::many_splits_are_refused_before_they_take_memory() {
  const auto mesh = made(MeshKind::cloth, {300, 300, 1});
  std::string commands;
  for (int i = 0; i < 200; ++i) {  // of 540,000 each
    const std::string copy = std::to_string(90'000 + i);
    commands += (i == 0 ? "" : ", ") + (R"({"do": "split", "elements": [[0, 0, 0, 0, 0]], "triangles": [[)" + copy +
                                        R"(, 1, 2]], "removed": [0]})");
  }
  const auto refused = [](const std::string& text, const MeshPointer& of) {
    return error_of([&] { read_moves(text, std::filesystem::path("m.json"), of); });
  };
  const std::size_t before = bytes_held;
  max_bytes_held = before;
  QVERIFY(refused(with_commands(commands), mesh)
              .startsWith(
                  "m.json: the meshes after all splits have more than 100000000 elements, links, triangles and cells; "
                  "use fewer splits"));
  QVERIFY(max_bytes_held - before < 1'000'000);
}

/// A simulation would refuse it, too: the handle was of the object before.
void MovesTest::a_drag_after_a_split_needs_a_grab() {
  const std::string split =
      R"({"do": "split", "elements": [[0, 0, 0, 0, 0], [2, 2, 2, 0, 0]], "removed": [1], "triangles": [[4, 5, 3]]})";
  const auto error_with = [&](const std::string& between) {
    return error_of([&] {
      read_moves(R"({"version": 2, "commands": [{"do": "grab", "element": 1}, )" + between +
                     R"({"do": "drag", "target": [1, 2, 0]}]})",
                 std::filesystem::path("m.json"), two_triangles());
    });
  };
  QCOMPARE(error_with(""), QString());
  QVERIFY(error_with(split + ", ").startsWith("m.json: command 2: no element is grabbed at that time"));
  QCOMPARE(error_with(split + R"(, {"do": "grab", "element": 5}, )"), QString());
}

void MovesTest::what_is_not_the_objects_is_left_out() {
  const auto again = read(written({commands::SetAlgorithm{Algorithm::spiral}, commands::SetRelaxation{true, 1},
                                   commands::KeepState{1}, commands::Grab{1}, commands::DropState{1}}));
  QCOMPARE(again.size(), std::size_t{1});
  QCOMPARE(std::get<commands::Grab>(again[0]).elements.front(), 1U);
  QVERIFY(read(written({commands::KeepState{1}})).empty());
}

void MovesTest::a_change_of_mesh_is_not_written() {
  QVERIFY(error_of([&] { written({commands::ReplaceMesh{mesh_}}); }).startsWith("moves: "));
  QVERIFY(error_of([&] { written({commands::RestoreState{1}}); }).startsWith("moves: "));
}

void MovesTest::other_files_are_refused_data() {
  QTest::addColumn<QString>("text");
  QTest::addColumn<QString>("said");
  const auto row = [](const char* text, const char* said) { QTest::newRow(text) << QString(text) << QString(said); };
  row("{\"version\": 1,\n\"commands\": [}", "m.json:2: it is not JSON; ");
  row("0 2 1 3", "m.json:1: it is not JSON; ");
  row(" ", "m.json:1: it ends too early; ");
  row(R"({"version": 1, "commands": []} x)", "m.json:1: it is not JSON; ");
  row(R"({"version": 1, "commands": [NaN]})", "m.json:1: it is not JSON; ");
  row(R"({"version": 1, "commands": [1e999]})", "m.json: it contains a number that is too large");
  row("[]", "m.json: it contains no recorded moves; ");
  row("null", "m.json: it contains no recorded moves; ");
  row("{}", "m.json: 'version' is missing; ");
  row(R"({"commands": []})", "m.json: 'version' is missing; ");
  row(R"({"version": 5, "commands": []})",
      "m.json: its version is 5, but this program knows only version 4 and older; ");
  row(R"({"version": "1", "commands": []})", "m.json: 'version' is not a whole number from 1 to 4; ");
  row(R"({"version": 1.5, "commands": []})", "m.json: 'version' is not a whole number from 1 to 4; ");
  row(R"({"version": -1, "commands": []})", "m.json: 'version' is not a whole number from 1 to 4; ");
  row(R"({"version": 1})", "m.json: 'commands' is missing; ");
  row(R"({"version": 1, "commands": {}})", "m.json: 'commands' is not an array; ");
  row(R"({"version": 1, "commands": [], "more": 1})", "m.json: 'more' is not a known key; ");
}

void MovesTest::other_files_are_refused() {
  QFETCH(QString, text);
  QFETCH(QString, said);
  const QString error = error_of([&] { read(text.toStdString()); });
  QVERIFY2(error.startsWith(said), qPrintable(error));
}

void MovesTest::other_commands_are_refused_data() {
  QTest::addColumn<QString>("commands");
  QTest::addColumn<QString>("said");
  const auto row = [](const char* text, const char* said) { QTest::newRow(text) << QString(text) << QString(said); };
  row("5", "0: it is not an object; ");
  row("{}", "0: 'do' is missing; ");
  row(R"({"do": 1})", "0: 'do' is not known; use grab, ");
  row(R"({"do": "Grab", "element": 1})", "0: 'do' is not known; use grab, ");
  row(R"({"do": "grab"})", "0: 'element' is missing; ");
  row(R"({"do": "grab", "element": 6})", "0: 'element' names element 6, which does not exist; ids run from 0 to 5");
  row(R"({"do": "grab", "element": 4294967296})", "0: 'element' names element 4294967296, which does not exist; ");
  row(R"({"do": "grab", "element": 18446744073709551616})", "0: '1.8446744073709552e+19' is not an element's id; ");
  row(R"({"do": "grab", "element": -1})", "0: '-1' is not an element's id; ");
  row(R"({"do": "grab", "element": 1.5})", "0: '1.5' is not an element's id; ");
  row(R"({"do": "grab", "element": [1]})", "0: '[1]' is not an element's id; ");
  row(R"({"do": "grab", "element": 1, "elemen": 2})", "0: 'elemen' is not a known key; ");
  row(R"({"do": "release"}, {"do": "drag", "target": [1, 2, 3]})", "1: no element is grabbed at that time; ");
  row(R"({"do": "grab", "element": 1}, {"do": "release"}, {"do": "drag", "target": [1, 2, 3]})", "2: no element is ");
  row(R"({"do": "grab", "element": 1}, {"do": "drag", "target": [1, 2]})", "1: 'target' does not have three ");
  row(R"({"do": "grab", "element": 1}, {"do": "drag", "target": 1})", "1: 'target' is not an array; ");
  row(R"({"do": "grab", "element": 1}, {"do": "drag", "target": [1, null, 2]})", "1: 'null' is not a number; ");
  row(R"({"do": "grab", "element": 1}, {"do": "drag", "target": [1, "2", 2]})", "1: '\"2\"' is not a number; ");
  row(R"({"do": "grab", "element": 1}, {"do": "drag", "target": [1, 1e101, 2]})", "1: '1e+101' is too large");
  row(R"({"do": "grab", "element": 1}, {"do": "drag", "target": [1, -1e101, 2]})", "1: '-1e+101' is too large");
  row(R"({"do": "grab", "elements": []})", "0: the handle has no elements; ");
  row(R"({"do": "grab", "elements": [1, 6]})", "0: 'elements' names element 6, which does not exist; ");
  row(R"({"do": "grab", "elements": [1, 2, 1]})", "0: element 1 is grabbed twice; ");
  row(R"({"do": "grab", "element": 1, "elements": [1]})", "0: 'element' is not a known key; ");
  row(R"({"do": "pin", "elements": [2]}, {"do": "grab", "elements": [1, 2]})", "1: element 2 is pinned at that time ");
  row(R"({"do": "grab", "elements": [1, 2]}, {"do": "pin", "elements": [2]})",
      "1: element 2 is grabbed at that time; ");
  const std::string grabbed = R"({"do": "grab", "elements": [1, 2]}, {"do": "drag", )";
  const std::vector<std::pair<std::string, const char*>> drags{
      {R"("by": [1, 2, 0], "x": 1})", "1: 'x' is not a known key; "},
      {R"("x": 1})", "1: 'target' is missing; "},
      {R"("by": [1, 2, 0], "target": [1, 2, 0]})", "1: 'target' is not a known key; "},
      {R"("by": [1, 2]})", "1: 'by' does not have three coordinates; "},
      {R"("rotate": 30})", "1: 'rotate' is not an object; "},
      {R"("rotate": {"degrees": 30}})", "1: 'axis' is missing; "},
      {R"("rotate": {"axis": [0, 0, 0], "degrees": 30}})", "1: rotation: it has no axis: "},
      {R"("rotate": {"axis": [0, 0, 1]}})", "1: 'degrees' is missing; "},
      {R"("rotate": {"axis": [0, 0, 1], "degrees": "a"}})", "1: '\"a\"' is not a number; "},
      {R"("rotate": {"axis": [1, 0, 0], "degrees": 30}})",
       "1: rotation: about x, it would leave the space of the object; "}};
  for (const auto& [text, said] : drags) {
    row((grabbed + text).c_str(), said);
  }
  row(R"({"do": "cut", "links": [[0, 1], [0, 2]]})", "0: the elements 0 and 2 are not linked; ");
  row(R"({"do": "cut", "links": [[1, 1]]})", "0: the elements 1 and 1 are not linked; ");
  row(R"({"do": "cut", "links": [0, 1]})", "0: 'links' does not contain arrays of 2 numbers; ");
  row(R"({"do": "uncut", "links": [[0, 1, 2]]})", "0: 'links' does not contain arrays of 2 numbers; ");
  row(R"({"do": "pin", "elements": 1})", "0: 'elements' is not an array; ");
  row(R"({"do": "pin", "elements": [6]})", "0: 'elements' names element 6, which does not exist; ");
  row(R"({"do": "pin", "elements": [2]}, {"do": "grab", "element": 2})", "1: element 2 is pinned at that time ");
  row(R"({"do": "grab", "element": 2}, {"do": "pin", "elements": [1, 2]})", "1: element 2 is grabbed at that time; ");
  row(R"({"do": "softness", "compression": 1, "stretch": 1})", "0: 'shear' is missing; ");
  row(R"({"do": "softness", "compression": 2, "stretch": 1, "shear": 0})", "0: compression: ");
  row(R"({"do": "softness", "compression": 1, "stretch": 1, "shear": 0, "stiffness": 0})", "0: stiffness: ");
  row(R"({"do": "softness", "compression": 1, "stretch": 1, "shear": 0, "energy": "elastic"})",
      "0: energy: there is no such kind of energy; use isotropic, axial, corotated or material");
  row(R"({"do": "softness", "compression": 1, "stretch": 1, "shear": 0, "frame": {"kind": "object"}, "shaer": 1})",
      "0: 'shaer' is not a known key; ");
  row(R"({"do": "softness", "compression": 1, "stretch": 1, "shear": 0, "frame": {"kind": "own"}})",
      "0: 'kind' is not known; ");
  row(R"({"do": "softness", "compression": 1, "stretch": 1, "shear": 0, "frame": {"kind": "given"}})",
      "0: 'rotation' is missing; ");
  row(R"({"do": "softness", "compression": 1, "stretch": 1, "shear": 0, "energy": 1})", "0: 'energy' is not a text; ");
  const char* softness = R"({"do": "softness", "compression": 1, "stretch": 1, "shear": 0, "links": )";
  const std::vector<std::pair<std::string, const char*>> links{
      {"[[0, 1, 1, 1]]}", "0: 'links' does not contain arrays of 5 or 8 numbers; "},
      {"[[0, 1, 1, 0.5, 0]]}", "0: stretch: "},
      {"[[0, 1, 1, 1, 0, -1, 1, 0]]}", "0: lateral: "},
      {"[[0, 1, 1, 1, 0, 1, 1, 0], [1, 2, 1, 1, 0], [3, 4, 2, 1, 0, 1, 1, 0]]}",
       "0: number 1 of 'links' is a row of 5 numbers; "},
      {"[[0, 1, 1, 1, 0], [1, 0, 1, 1, 0]]}", "0: the link 1-0 is given twice; "},
      {"3}", "0: 'links' is not an array; "}};
  for (const auto& [text, said] : links) {
    row((softness + text).c_str(), said);
  }
}

void MovesTest::other_commands_are_refused() {
  QFETCH(QString, commands);
  QFETCH(QString, said);
  const QString error = error_of([&] { read(with_commands(commands.toStdString())); });
  QVERIFY2(error.startsWith("m.json: command " + said), qPrintable(error));
}

void MovesTest::deep_nesting_is_refused() {
  for (const char* open : {"[", "{\"a\":"}) {
    std::string text;
    for (int i = 0; i < 200'000; ++i) {
      text += open;
    }
    QVERIFY(error_of([&] { read(text); }).startsWith("m.json: it is nested too deeply; "));
  }
}

void MovesTest::damaged_files_never_do_worse() {
  // A file cut off at any place, or with any character replaced, gives moves or an Error, nothing else.
  for (std::size_t i = 0; i < every_command.size(); ++i) {
    QVERIFY(!error_of([&] { read(every_command.substr(0, i)); }).isEmpty());
    for (const char other : {'0', '9', '"', '[', '}', '-', '\xff'}) {
      std::string text = every_command;
      text[i] = other;
      error_of([&] { read(text); });
    }
  }
}

void MovesTest::keys_come_in_any_order() {
  const auto moves = read(R"({"commands": [{"links": [[1, 0], [4, 5]], "do": "cut"}, {"elements": [3], "do": "pin"},
    {"links": [[3, 0, 1, 1, 0.25]], "shear": 0, "compression": 0.5, "stretch": 2, "do": "softness"}], "version": 1})");
  QCOMPARE(moves.size(), std::size_t{3});
  QCOMPARE(std::get<commands::Cut>(moves[0]).links, (std::vector<LinkId>{0, 6}));
  QCOMPARE(std::get<commands::Pin>(moves[1]).elements, std::vector<ElementId>{3});
  QVERIFY(
      (*std::get<commands::SetSoftness>(moves[2]).softness == Softness{{0.5, 2, 0}, {{1, {1, 1, 0.25}}}, link_energy}));
}

/// A key that occurs twice is an error, because one of the two values would be ignored.
void MovesTest::a_key_that_stands_twice_is_refused_data() {
  QTest::addColumn<QString>("text");
  QTest::addColumn<QString>("said");
  QTest::newRow("commands") << R"({"version": 1, "commands": [], "commands": []})"
                            << "m.json: 'commands' appears twice; remove one of them";
  QTest::newRow("do") << R"({"version": 1, "commands": [{"do": "reset"}, {"do": "release", "do": "reset"}]})"
                      << "m.json: command 1: 'do' appears twice; remove one of them";
}

void MovesTest::a_key_that_stands_twice_is_refused() {
  QFETCH(QString, text);
  QFETCH(QString, said);
  QCOMPARE(error_of([&] { read(text.toStdString()); }), said);
}

/// The version is checked before the commands, at any position in the file: a newer file may have commands that this
/// program does not know.
void MovesTest::what_is_wrong_with_the_file_comes_before_its_commands() {
  QVERIFY(error_of([&] {
            read(R"({"commands": [{"do": "twist"}], "version": 5})");
          }).startsWith("m.json: its version is 5, but "));
  QVERIFY(error_of([&] {
            read(R"({"version": 1, "commands": [{"do": "twist"}] ,})");
          }).startsWith("m.json:1: it is not JSON; "));
  QVERIFY(error_of([&] {
            read(R"({"version": 1, "commands": [{"do": "twist"}, {"do": "turn"}]})");
          }).startsWith("m.json: command 0: 'do' is not known; "));
}

void MovesTest::a_large_file_takes_little_memory_besides_its_commands_data() {
  QTest::addColumn<QString>("begin");
  QTest::addColumn<QString>("item");
  QTest::addColumn<QString>("end");
  QTest::addColumn<std::size_t>("of_item");  // bytes per item in the result
  QTest::newRow("drags") << R"({"version": 1, "commands": [{"do": "grab", "element": 5})"
                         << R"(, {"do": "drag", "target": [1.25, -2.5, 0]})"
                         << "]}" << sizeof(Command);
  QTest::newRow("pinned elements") << R"({"version": 1, "commands": [{"do": "pin", "elements": [0)"
                                   << ", 3"
                                   << "]}]}" << sizeof(ElementId);
  QTest::newRow("links") << R"({"version": 1, "commands": [{"do": "cut", "links": [[0, 1])"
                         << ", [4, 5]"
                         << "]}]}" << sizeof(LinkId);
}

/// Reading takes linear time and little memory. A tree of the file would take more than ten times as much memory, and
/// the parser's own filter takes quadratic time.
void MovesTest::a_large_file_takes_little_memory_besides_its_commands() {
  QFETCH(QString, begin);
  QFETCH(QString, item);
  QFETCH(QString, end);
  QFETCH(std::size_t, of_item);
  constexpr std::size_t items = 100'000;
  const std::string text = (begin + item.repeated(items) + end).toStdString();
  const std::size_t before = bytes_held;
  max_bytes_held = before;
  const auto moves = read(text);
  QVERIFY(!moves.empty());
  // A growing vector takes up to three times its size; a number that is not yet checked takes 16 bytes.
  const std::size_t bound = items * (3 * of_item + (of_item < sizeof(Command) ? 2 * 3 * 16 : 0)) + (1U << 16);
  QVERIFY2(max_bytes_held - before < bound,
           qPrintable(QString("%1 bytes an item").arg((max_bytes_held - before) / items)));
}

/// A short command asks for the principal axes, which takes time in proportion to the object.
void MovesTest::frames_of_the_object_are_found_once() {
  const auto large = made(MeshKind::grid, {400, 500, 1});
  std::string text = R"({"version": 1, "commands": [)";
  for (int i = 0; i < 30'000; ++i) {
    text += i == 0 ? "" : ",";
    text += R"({"do": "softness", "compression": 1, "stretch": 1, "shear": 0, "frame": {"kind": "object"}})";
  }
  const std::clock_t before = std::clock();
  QCOMPARE(read_moves(text + "]}", std::filesystem::path("m.json"), large).size(), std::size_t{30'000});
  const double seconds = double(std::clock() - before) / CLOCKS_PER_SEC;
  QVERIFY2(seconds < 5, qPrintable(QString::number(seconds)));
}

void MovesTest::reading_and_writing_can_be_cancelled() {
  const auto moves = read(every_command);
  const Progress job = Progress::watched();
  job.cancel();
  QVERIFY_THROWS_EXCEPTION(Cancelled, read_moves(every_command, "m.json", mesh_, job));
  std::ostringstream out;
  QVERIFY_THROWS_EXCEPTION(Cancelled, write_moves(out, moves, *mesh_, job));
}

void MovesTest::files() {
  const QTemporaryDir folder;
  const std::filesystem::path path = folder.filePath("m.json").toStdString();
  QVERIFY(error_of([&] { read_moves(path, mesh_); }).contains(": there is no such file; "));
  put_file(path, "");
  QVERIFY(
      error_of([&] { read_moves(path, mesh_); }).endsWith(": it is empty; use a file that contains recorded moves"));
  put_file(path, "\xef\xbb\xbf" + every_command);
  QCOMPARE(read_moves(path, mesh_).size(), std::size_t{9});
}

CHAINMAIL_TEST(MovesTest)

}  // namespace chainmail::test_moves

#include "test_moves.moc"
