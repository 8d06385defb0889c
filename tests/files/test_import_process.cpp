#include <fcntl.h>
#include <unistd.h>

#include <QtTest>
#include <filesystem>
#include <fstream>
#include <future>
#include <set>

#include "files/import/import_process.h"
#include "files/mesh/open_mesh.h"
#include "files/support.h"

using namespace chainmail;
using namespace chainmail::test;

namespace fs = std::filesystem;

namespace {

/// Returns an octahedron of radius 3. Filling it with edges of 0.05 takes many seconds.
constexpr const char* work = "0.05";
void put_work(ImportInput& input) {
  ImportedMesh surface;
  surface.parts.rest = {{3, 0, 0}, {-3, 0, 0}, {0, 3, 0}, {0, -3, 0}, {0, 0, 3}, {0, 0, -3}};
  surface.parts.triangles = {{0, 2, 4}, {2, 1, 4}, {1, 3, 4}, {3, 0, 4}, {2, 0, 5}, {1, 2, 5}, {3, 1, 5}, {0, 3, 5}};
  const auto bytes = encode_imported(surface);
  input.write("surface", {reinterpret_cast<const char*>(bytes.data()), bytes.size()});
}

/// Returns the child processes of this process, started by any of its threads.
std::vector<fs::path> started() {
  std::vector<fs::path> found;
  for (const auto& thread : fs::directory_iterator("/proc/self/task")) {
    std::ifstream list(thread.path() / "children");
    for (std::string process; list >> process;) {
      found.push_back(fs::path("/proc") / process);
    }
  }
  return found;
}

/// Returns the value of `name` in the status file of a process.
std::string status_of(const fs::path& process, const std::string& name) {
  std::ifstream lines(process / "status");
  for (std::string word; lines >> word;) {
    if (word == name + ":") {
      lines >> word;
      return word;
    }
  }
  return {};
}

/// Returns the targets of the file descriptors of a process.
QStringList descriptors_of(const fs::path& process) {
  QStringList targets;
  std::error_code gone;
  for (const auto& entry : fs::directory_iterator(process / "fd", gone)) {
    targets += QString::fromStdString(fs::read_symlink(entry.path(), gone).string());
  }
  return targets;
}

}  // namespace

/// Tests the program in which third-party readers run: its limits, and the files it can access.
class ImportProcessTest : public QObject {
  Q_OBJECT

 private slots:
  void it_may_take_so_much_time_data();
  void it_may_take_so_much_time();
  void it_may_take_so_much_memory();
  void it_runs_in_the_sandbox_and_inherits_nothing();
  void the_file_that_was_opened_is_read();
  void it_says_how_much_it_has_read();
  void no_temporary_folder_stays();
};

void ImportProcessTest::it_may_take_so_much_time_data() {
  QTest::addColumn<unsigned>("processor");
  QTest::addColumn<unsigned>("wall");
  QTest::newRow("of a processor") << 1U << 1000U;
  QTest::newRow("by the clock on the wall") << 1000U << 1U;
}

void ImportProcessTest::it_may_take_so_much_time() {
  QFETCH(unsigned, processor);
  QFETCH(unsigned, wall);
  ImportInput input("ball.obj");
  put_work(input);
  const ImportLimits limits{std::uint64_t{12} << 30, processor, wall};
  JobState job;
  const Patience patience(job);
  const QString error = error_of([&] {
    try {
      run_import("fill", input, {work}, limits, Progress(job));
    } catch (const Cancelled&) {
    }
  });
  QCOMPARE(error, QString("ball.obj: reading it takes longer than 1 s; use a smaller file, or another format"));
}

/// A file of a few bytes may state that it has gigabytes of data, and the reader trusts it.
void ImportProcessTest::it_may_take_so_much_memory() {
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
  QSKIP("a sanitizer takes more address space than any limit");
#endif
  const QTemporaryDir folder;
  const fs::path path = fs::path(folder.path().toStdString()) / "claim.off";
  put_file(path, "OFF\n150000000 1 0\n0 0 0\n");  // 3.6 GB of coordinates
  const QString error = error_of([&] { open_mesh(path); });
  QVERIFY2(error.endsWith("claim.off: reading it takes more than 2048 MiB of memory; use a smaller file, or another "
                          "format"),
           qPrintable(error));
}

void ImportProcessTest::it_runs_in_the_sandbox_and_inherits_nothing() {
  qputenv("CHAINMAIL_TEST_SECRET", "1");
  const QTemporaryDir folder;
  const fs::path open_file = fs::path(folder.path().toStdString()) / "open";
  put_file(open_file, "text");
  const int open_here = open(open_file.c_str(), O_RDWR);  // some shells leave open descriptors to their programs
  QVERIFY(open_here >= 0);
  JobState job;
  const Patience patience(job);
  auto running = std::async(std::launch::async, [&job] {
    ImportInput input("ball.obj");
    put_work(input);
    run_import("fill", input, {work}, {std::uint64_t{12} << 30, 1000, 1000}, Progress(job));
  });
  fs::path confined;
  while (confined.empty() && running.wait_for(std::chrono::milliseconds(1)) != std::future_status::ready) {
    const auto processes = started();
    const auto found = std::find_if(processes.begin(), processes.end(),
                                    [](const fs::path& process) { return status_of(process, "Seccomp") == "2"; });
    confined = found == processes.end() ? fs::path() : *found;
  }
  const std::string privileges = confined.empty() ? "" : status_of(confined, "NoNewPrivs");
  const QStringList descriptors = descriptors_of(confined);
  const std::string environment = file_text(confined / "environ");
  job.cancelled = true;
  QVERIFY_THROWS_EXCEPTION(Cancelled, running.get());
  close(open_here);
  QVERIFY2(!confined.empty(), "no process of this one was in a sandbox");
  QCOMPARE(privileges, std::string("1"));
  QVERIFY(!descriptors.isEmpty() && !descriptors.contains(QString::fromStdString(open_file.string())));
  QVERIFY(environment.find("HOME=") != std::string::npos);
  QVERIFY(environment.find("CHAINMAIL_TEST_SECRET") == std::string::npos);
}

/// The reader gets the file that was opened first, even if its path leads to another file when a library opens it.
void ImportProcessTest::the_file_that_was_opened_is_read() {
  const QTemporaryDir folder;
  const fs::path path = fs::path(folder.path().toStdString()) / "a.off";
  put_file(path, "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n");
  ImportInput input(path);
  input.link("mesh.off", RegularFile(path));
  fs::remove(path);
  put_file(path, "not a mesh");
  const auto imported = run_import("off", input, {}, limits_for(input.linked_size()), {});
  QCOMPARE(std::get<ImportedMesh>(imported).parts.rest.size(), std::size_t{3});
}

void ImportProcessTest::it_says_how_much_it_has_read() {
  constexpr std::size_t points = 400'000;
  const QTemporaryDir folder;
  const fs::path path = fs::path(folder.path().toStdString()) / "large.off";
  std::string text = "OFF\n" + std::to_string(points) + " 1 0\n";
  for (std::size_t i = 0; i < points; ++i) {
    text += std::to_string(i) + ".125 0.0625 1.5\n";
  }
  put_file(path, text + "3 0 1 2\n");
  JobState job;
  ImportInput input(path);
  input.link("mesh.off", RegularFile(path));
  auto running = std::async(
      std::launch::async, [&] { return run_import("off", input, {}, limits_for(input.linked_size()), Progress(job)); });
  std::set<double> shares;
  while (running.wait_for(std::chrono::milliseconds(1)) != std::future_status::ready) {
    shares.insert(job.share.load());
  }
  running.get();
  shares.erase(0.0);
  shares.erase(1.0);
  QVERIFY2(shares.size() > 1, "a share between nothing and all, more than once");
}

void ImportProcessTest::no_temporary_folder_stays() {
  const QTemporaryDir folder, elsewhere;
  const fs::path path = folder.path().toStdString();
  qputenv("TMPDIR", folder.path().toUtf8());
  put_file(elsewhere.filePath("good.off").toStdString(), "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n");
  put_file(elsewhere.filePath("script.msh").toStdString(), "Printf(\"\");\n");
  open_mesh(elsewhere.filePath("good.off").toStdString());
  QCOMPARE(files_in(path), 0);
  QVERIFY(!error_of([&] { open_mesh(elsewhere.filePath("script.msh").toStdString()); }).isEmpty());
  QCOMPARE(files_in(path), 0);
  JobState job;
  job.cancelled = true;
  QVERIFY_THROWS_EXCEPTION(Cancelled, open_mesh(elsewhere.filePath("good.off").toStdString(), {}, Progress(job)));
  QCOMPARE(files_in(path), 0);
  qunsetenv("TMPDIR");
}

QTEST_APPLESS_MAIN(ImportProcessTest)
#include "test_import_process.moc"
