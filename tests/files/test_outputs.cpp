#include <signal.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <QtTest>
#include <chrono>
#include <stdexcept>

#include "files/support.h"
#include "files/text/outputs.h"
#include "program.h"

namespace chainmail::test_outputs {

using namespace chainmail::test;

namespace fs = std::filesystem;

/// Files are written completely or not at all.
class OutputsTest : public QObject {
  Q_OBJECT

 private slots:
  void init() { folder_ = std::make_unique<QTemporaryDir>(); }
  void a_file_is_written_and_replaced();
  void nothing_is_touched_before_commit();
  void a_failing_writer_leaves_the_target();
  void a_failing_device_leaves_the_other_files();
  void wrong_targets_are_refused();
  void one_target_twice_is_refused();
  void a_link_stays_a_link_and_permissions_stay();
  void a_link_that_points_nowhere_is_followed();
  void a_hard_link_is_replaced();
  void a_killed_program_leaves_the_old_file();
  void a_program_that_changes_its_user_does_not_stay_one();
  void several_files_are_replaced_together();
  void a_long_name_is_written();
  void a_mesh_is_saved_by_its_ending();
  void endings_are_known_by_their_use();

 private:
  fs::path path(const std::string& name) const { return fs::path(folder_->path().toStdString()) / name; }

  std::unique_ptr<QTemporaryDir> folder_;
};

namespace {

Outputs::Writer text(const std::string& written) {
  return [written](std::ostream& out) { out << written; };
}

}  // namespace

void OutputsTest::a_file_is_written_and_replaced() {
  write_file(path("a"), text("one"));
  write_file(path("a"), text("two\r\n"));
  QCOMPARE(file_text(path("a")), std::string("two\r\n"));
  QCOMPARE(files_in(path(".")), 1);
}

void OutputsTest::nothing_is_touched_before_commit() {
  put_file(path("a"), "old");
  {
    Outputs outputs;
    outputs.add(path("a"), text("new"));
    outputs.add(path("b"), text("new"));
    QCOMPARE(file_text(path("a")), std::string("old"));
    QVERIFY(!fs::exists(path("b")));
  }
  QCOMPARE(file_text(path("a")), std::string("old"));
  QCOMPARE(files_in(path(".")), 1);
}

void OutputsTest::a_failing_writer_leaves_the_target() {
  put_file(path("a"), "old");
  QVERIFY_EXCEPTION_THROWN(write_file(path("a"),
                                      [](std::ostream& out) {
                                        out << "half";
                                        throw std::runtime_error("");
                                      }),
                           std::runtime_error);
  QVERIFY_EXCEPTION_THROWN(write_file(path("a"), [](std::ostream& out) { out.setstate(std::ios::failbit); }),
                           WriteFailure);
  QCOMPARE(file_text(path("a")), std::string("old"));
  QCOMPARE(files_in(path(".")), 1);
}

void OutputsTest::a_failing_device_leaves_the_other_files() {
  if (!fs::exists("/dev/full")) {
    QSKIP("there is no device that is full");
  }
  put_file(path("a"), "old");
  Outputs outputs;
  outputs.add(path("a"), text("new"));
  outputs.add("/dev/full", text("new"));
  QVERIFY_EXCEPTION_THROWN(outputs.commit(), WriteFailure);
  QCOMPARE(file_text(path("a")), std::string("old"));
  QVERIFY(fs::is_character_file("/dev/full"));
}

void OutputsTest::wrong_targets_are_refused() {
  const auto error = [&](const fs::path& target) { return error_of([&] { write_file(target, text("")); }); };
  fs::create_directory(path("folder"));
  QVERIFY(error(path("folder")).contains("folder: it is a folder; "));
  QVERIFY(error(path("none/a")).contains("none/a: its folder does not exist; "));
  put_file(path("file"), "");
  QVERIFY(error(path("file/a")).contains("file/a: its folder does not exist; "));
  QVERIFY(error("").contains("it is empty; "));
  QVERIFY(error(path(std::string(300, 'a'))).contains("it cannot be"));
  QCOMPARE(files_in(path(".")), 2);
}

void OutputsTest::one_target_twice_is_refused() {
  Outputs outputs;
  outputs.add(path("a"), text(""));
  QVERIFY(error_of([&] { outputs.add(path("./a"), text("")); }).contains("./a: two outputs have this name; "));
  outputs.add("-", text(""));
  QVERIFY(error_of([&] { outputs.add("-", text("")); }).startsWith("standard output: two outputs have this name; "));
}

void OutputsTest::a_link_stays_a_link_and_permissions_stay() {
  put_file(path("a"), "old");
  fs::permissions(path("a"), fs::perms::owner_read | fs::perms::owner_write);
  fs::create_symlink("a", path("link"));
  write_file(path("link"), text("new"));
  QVERIFY(fs::is_symlink(path("link")));
  QCOMPARE(file_text(path("a")), std::string("new"));
  QVERIFY(fs::status(path("a")).permissions() == (fs::perms::owner_read | fs::perms::owner_write));
}

void OutputsTest::a_link_that_points_nowhere_is_followed() {
  fs::create_directory(path("folder"));
  fs::create_symlink("folder/second", path("first"));
  fs::create_symlink("a", path("folder/second"));
  write_file(path("first"), text("new"));
  QVERIFY(fs::is_symlink(path("first")) && fs::is_symlink(path("folder/second")));
  QCOMPARE(file_text(path("folder/a")), std::string("new"));
  fs::create_symlink("turn", path("turn"));
  QVERIFY(!error_of([&] { write_file(path("turn"), text("new")); }).isEmpty());
  QVERIFY(fs::is_symlink(path("turn")));
}

void OutputsTest::a_hard_link_is_replaced() {
  put_file(path("a"), "old");
  fs::create_hard_link(path("a"), path("b"));
  write_file(path("b"), text("new"));
  QCOMPARE(file_text(path("a")), std::string("old"));
  QCOMPARE(file_text(path("b")), std::string("new"));
}

void OutputsTest::a_killed_program_leaves_the_old_file() {
  put_file(path("a"), "old");
  const pid_t child = fork();
  if (child == 0) {
    Outputs outputs;
    outputs.add(path("a"), text("new"));
    kill(getpid(), SIGKILL);
  }
  int status = 0;
  QCOMPARE(waitpid(child, &status, 0), child);
  QVERIFY(WIFSIGNALED(status));
  QCOMPARE(file_text(path("a")), std::string("old"));
}

void OutputsTest::a_program_that_changes_its_user_does_not_stay_one() {
  put_file(path("a"), "old");
  QCOMPARE(chmod(path("a").c_str(), 06751), 0);
  write_file(path("a"), text("new"));
  struct stat status {};
  QCOMPARE(stat(path("a").c_str(), &status), 0);
  QCOMPARE(int(status.st_mode & 07777), 0751);
}

void OutputsTest::several_files_are_replaced_together() {
  put_file(path("a"), "old a");
  put_file(path("c"), "old c");
  Outputs outputs;
  for (const char* name : {"a", "b", "c"}) {
    outputs.add(path(name), text("new"));
  }
  fs::create_directory(path("d"));
  QVERIFY(!error_of([&] { outputs.add(path("d"), text("new")); }).isEmpty());
  QCOMPARE(file_text(path("a")), std::string("old a"));
  QVERIFY(!fs::exists(path("b")));
  outputs.commit();
  for (const char* name : {"a", "b", "c"}) {
    QCOMPARE(file_text(path(name)), std::string("new"));
  }
}

void OutputsTest::a_long_name_is_written() {
  const fs::path target = path(std::string(255, 'n'));
  write_file(target, text("x"));
  QCOMPARE(file_text(target), std::string("x"));
}

void OutputsTest::a_mesh_is_saved_by_its_ending() {
  const auto mesh = made(MeshKind::grid, {3, 2, 1});
  for (const char* name : {"a.dat", "a.OBJ"}) {
    save_mesh(path(name), {*mesh, {}, rest_positions(*mesh), {}});
    QCOMPARE(read_mesh(path(name))->links, mesh->links);
  }
  save_mesh(path("a.csv"), {*mesh, {}, rest_positions(*mesh), {}});
  QVERIFY(file_text(path("a.csv")).starts_with("id,x,y,z\n0,0,0,0\n"));
  const auto error = error_of([&] { save_mesh(path("a.doc"), {*mesh, {}, rest_positions(*mesh), {}}); });
  QVERIFY2(error.contains("a.doc: the ending .doc is not known; write the mesh in one of these formats: .obj"),
           qPrintable(error));
}

void OutputsTest::endings_are_known_by_their_use() {
  for (const MeshFormat& format : mesh_formats()) {
    for (const FormatUse use : {FormatUse::read, FormatUse::write, FormatUse::write_positions}) {
      for (const QString& ending : QString::fromUtf8(format.endings.data(), format.endings.size()).split(' ')) {
        const std::string name = std::string(1, 'a').append(ending.toUpper().toStdString());
        const auto error = error_of([&] { QVERIFY(&mesh_format(name, use) == &format); });
        QCOMPARE(error.isEmpty(), format.allows(use));
        QCOMPARE(QString::fromStdString(mesh_endings(use)).contains(ending), format.allows(use));
      }
    }
  }
  const auto error = [](const char* name, FormatUse use) { return error_of([&] { mesh_format(name, use); }); };
  QVERIFY(
      error("a.csv", FormatUse::read)
          .startsWith("a.csv: a .csv file can be written but not opened; open a mesh in one of these formats: .obj"));
  QVERIFY(error("a.dat", FormatUse::write_positions)
              .startsWith("a.dat: a .dat file contains no positions; write positions in one of these formats: "));
}

CHAINMAIL_TEST(OutputsTest)

}  // namespace chainmail::test_outputs

#include "test_outputs.moc"
