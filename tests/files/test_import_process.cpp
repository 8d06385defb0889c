#include <fcntl.h>
#include <sys/resource.h>
#include <unistd.h>

#include <QProcess>
#include <QtTest>
#include <filesystem>
#include <fstream>
#include <future>
#include <set>
#include <sstream>

#include "files/import/handover.h"
#include "files/import/import_process.h"
#include "files/import/sandbox.h"
#include "files/mesh/open_mesh.h"
#include "files/support.h"
#include "folders.h"
#include "program.h"

namespace chainmail::test_import_process {

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

/// Begins to fill an object, which takes long, on another thread.
std::future<void> fill_beside(const Progress& job) {
  return std::async(std::launch::async, [job] {
    ImportInput input("ball.obj");
    put_work(input);
    run_import("fill", input, {work}, {std::uint64_t{12} << 30, 1000, 1000}, job);
  });
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

/// Returns the present and the highest size of the stack of a process, from its file of limits.
std::vector<std::string> stack_limits_of(const fs::path& process) {
  std::ifstream lines(process / "limits");
  for (std::string line; std::getline(lines, line);) {
    std::istringstream words(line);
    std::string max, stack, size, present, highest;
    if (words >> max >> stack >> size >> present >> highest && stack == "stack") {
      return {present, highest};
    }
  }
  return {};
}

/// Waits until a process of this one is in a sandbox, at most while the work is running. Returns an empty path if none
/// is.
fs::path sandboxed_process(const std::future<void>& running) {
  while (running.wait_for(std::chrono::milliseconds(1)) != std::future_status::ready) {
    const auto processes = started();
    const auto found = std::find_if(processes.begin(), processes.end(),
                                    [](const fs::path& process) { return status_of(process, "Seccomp") == "2"; });
    if (found != processes.end()) {
      return *found;
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
/// Returns a triangle with so many points, in Gmsh's format.
std::string msh_of(std::size_t points) {
  std::string text = "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n" + std::to_string(points) + "\n";
  for (std::size_t i = 1; i <= points; ++i) {
    text += std::to_string(i) + " " + std::to_string(i) + " " + std::to_string(i % 7) + ".0625 1.5\n";
  }
  return text + "$EndNodes\n$Elements\n1\n1 2 2 0 1 1 2 3\n$EndElements\n";
}

class ImportProcessTest : public QObject {
  Q_OBJECT

 private slots:
  void it_may_take_so_much_time_data();
  void it_may_take_so_much_time();
  void it_may_take_so_much_memory();
  void it_runs_in_the_sandbox_and_inherits_nothing();
  void its_stack_may_grow_as_far_as_the_system_allows();
  void the_file_that_was_opened_is_read();
  void it_says_how_much_it_has_read();
  void it_says_how_much_of_its_work_is_done();
  void no_temporary_folder_stays();
  void other_files_are_hidden();
  void its_version_says_what_the_sandbox_has();
  void a_program_of_another_kind_gets_a_sentence_data();
  void a_program_of_another_kind_gets_a_sentence();
  void when_no_file_can_be_opened_it_says_so();
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
  const Progress job = Progress::watched();
  const Patience patience(job);
  const QString error = error_of([&] {
    try {
      run_import("fill", input, {work}, limits, job);
    } catch (const Cancelled&) {
    }
  });
  QCOMPARE(error, QString("ball.obj: reading it takes longer than 1 s; use a smaller file, or another format"));
}

void ImportProcessTest::it_may_take_so_much_memory() {
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
  QSKIP("a sanitizer takes more address space than any limit");
#endif
  const QTemporaryDir folder;
  const fs::path path = fs::path(folder.path().toStdString()) / "large.msh";
  put_file(path, msh_of(2'000'000));
  ImportInput input(path);
  input.link("mesh.msh", RegularFile(path));
  const ImportLimits limits{std::uint64_t{256} << 20, 100, 100};
  const QString error = error_of([&] { run_import("msh", input, {}, limits, {}); });
  QVERIFY2(error.endsWith("large.msh: reading it takes more than 256 MiB of memory; use a smaller file, or another "
                          "format"),
           qPrintable(error));
}

void ImportProcessTest::it_runs_in_the_sandbox_and_inherits_nothing() {
  qputenv("CHAINMAIL_TEST_SECRET", "1");
  const QTemporaryDir folder;
  const fs::path open_file = fs::path(folder.path().toStdString()) / "open";
  put_file(open_file, "text");
  const int open_here = open(open_file.c_str(), O_RDWR);  // some shells leave open descriptors to their programs
  const int as_an_input = fcntl(open_here, F_DUPFD, import::last_input);
  QVERIFY(open_here >= 0 && as_an_input == import::last_input);
  const Progress job = Progress::watched();
  const Patience patience(job);
  auto running = fill_beside(job);
  const fs::path confined = sandboxed_process(running);
  const std::string privileges = confined.empty() ? "" : status_of(confined, "NoNewPrivs");
  const std::string threads = confined.empty() ? "" : status_of(confined, "Threads");
  const QStringList descriptors = descriptors_of(confined);
  const std::string environment = file_text(confined / "environ");
  job.cancel();
  QVERIFY_THROWS_EXCEPTION(Cancelled, running.get());
  close(open_here);
  close(as_an_input);
  QVERIFY2(!confined.empty(), "no process of this one was in a sandbox");
  QCOMPARE(privileges, std::string("1"));
  QCOMPARE(threads, std::string("1"));
  QVERIFY(!descriptors.isEmpty() && !descriptors.contains(QString::fromStdString(open_file.string())));
  QVERIFY(environment.find("HOME=") != std::string::npos);
  QVERIFY(environment.find("CHAINMAIL_TEST_SECRET") == std::string::npos);
}

/// Gmsh recurses deeply.
void ImportProcessTest::its_stack_may_grow_as_far_as_the_system_allows() {
  rlimit usual{};
  QCOMPARE(getrlimit(RLIMIT_STACK, &usual), 0);
  const rlimit low{rlim_t{4} << 20, usual.rlim_max};  // the process inherits it
  QCOMPARE(setrlimit(RLIMIT_STACK, &low), 0);
  const Progress job = Progress::watched();
  const Patience patience(job);
  auto running = fill_beside(job);
  const std::vector<std::string> limits = stack_limits_of(sandboxed_process(running));
  job.cancel();
  QVERIFY_THROWS_EXCEPTION(Cancelled, running.get());
  QCOMPARE(setrlimit(RLIMIT_STACK, &usual), 0);
  QCOMPARE(limits.size(), std::size_t{2});
  QCOMPARE(limits[0], limits[1]);
}

/// The reader gets the file that was opened first, even if its path leads to another file when a library opens it.
void ImportProcessTest::the_file_that_was_opened_is_read() {
  const QTemporaryDir folder;
  const fs::path path = fs::path(folder.path().toStdString()) / "a.msh";
  put_file(path, msh_of(3));
  ImportInput input(path);
  input.link("mesh.msh", RegularFile(path));
  fs::remove(path);
  put_file(path, "not a mesh");
  const auto imported = run_import("msh", input, {}, limits_for(input.linked_size()), {});
  QCOMPARE(std::get<ImportedMesh>(imported).parts.rest.size(), std::size_t{3});
}

void ImportProcessTest::it_says_how_much_it_has_read() {
  constexpr std::size_t points = 400'000;
  const QTemporaryDir folder;
  const fs::path path = fs::path(folder.path().toStdString()) / "large.msh";
  put_file(path, msh_of(points));
  const Progress job = Progress::watched();
  ImportInput input(path);
  input.link("mesh.msh", RegularFile(path));
  auto running = std::async(std::launch::async,
                            [&] { return run_import("msh", input, {}, limits_for(input.linked_size()), job); });
  std::set<double> shares;
  while (running.wait_for(std::chrono::milliseconds(1)) != std::future_status::ready) {
    shares.insert(job.share());
  }
  running.get();
  shares.erase(0.0);
  shares.erase(1.0);
  QVERIFY2(shares.size() > 1, "a share between nothing and all, more than once");
}

/// Filling reads little and takes long. The first tenth is reading and checking the surface.
void ImportProcessTest::it_says_how_much_of_its_work_is_done() {
  const Progress job = Progress::watched();
  const Patience patience(job);
  auto running = fill_beside(job);
  double share = 0;
  while (share <= 0.1 && running.wait_for(std::chrono::milliseconds(1)) != std::future_status::ready) {
    share = job.share();
  }
  job.cancel();
  QVERIFY_THROWS_EXCEPTION(Cancelled, running.get());
  QVERIFY2(share > 0.1 && share < 1, qPrintable(QString::number(share)));
}

void ImportProcessTest::no_temporary_folder_stays() {
  const QTemporaryDir folder, elsewhere;
  const fs::path path = folder.path().toStdString();
  qputenv("TMPDIR", folder.path().toUtf8());
  put_file(elsewhere.filePath("good.msh").toStdString(), msh_of(3));
  put_file(elsewhere.filePath("script.msh").toStdString(), "Printf(\"\");\n");
  open_mesh(elsewhere.filePath("good.msh").toStdString());
  QCOMPARE(files_in(path), 0);
  QVERIFY(!error_of([&] { open_mesh(elsewhere.filePath("script.msh").toStdString()); }).isEmpty());
  QCOMPARE(files_in(path), 0);
  const Progress job = Progress::watched();
  job.cancel();
  QVERIFY_THROWS_EXCEPTION(Cancelled, open_mesh(elsewhere.filePath("good.msh").toStdString(), {}, job));
  QCOMPARE(files_in(path), 0);
  qunsetenv("TMPDIR");
}

/// A header in the private folder names data elsewhere. No reader of ours writes such a header: this acts like a
/// library that a damaged file has taken over.
void ImportProcessTest::other_files_are_hidden() {
  if (!import::sandbox_hides_files()) {
    QSKIP("this kernel has no Landlock, so the sandbox cannot hide files");
  }
  const QTemporaryDir folder;
  const std::string secret = folder.filePath("secret").toStdString();
  put_file(secret, "1234");
  ImportInput input("a.nhdr");
  input.write("volume.nhdr",
              "NRRD0004\ntype: uint8\ndimension: 3\nsizes: 2 2 1\nencoding: raw\ndata file: " + secret + "\n");
  const QString error = error_of([&] { run_import("nrrd", input, {}, limits_for(0), {}); });
  QVERIFY2(error.startsWith("a.nhdr: teem cannot read it (") && error.contains("couldn't open"), qPrintable(error));
}

void ImportProcessTest::its_version_says_what_the_sandbox_has() {
  QProcess program;
  program.start(builtFile("bin/chainmail-import"), {"--version"});
  QVERIFY(program.waitForFinished());
  const QByteArray line = import::sandbox_hides_files() ? "Sandbox: Landlock and seccomp." : "Sandbox: seccomp only.";
  const QByteArray said = program.readAllStandardOutput();
  QVERIFY2(said.contains(line), said);
}

void ImportProcessTest::a_program_of_another_kind_gets_a_sentence_data() {
  QTest::addColumn<QByteArray>("script");
  QTest::addColumn<QString>("sentence");
  const QString begin = "chainmail-import: ", again = "install it and the libraries that it needs again";
  QTest::newRow("an answer of another kind")
      << QByteArray("#!/bin/sh\nexec /bin/cat \"$0\".answer >/proc/self/fd/30\n")
      << "a.msh: the answer of the import program is damaged; open it again, or convert it to another format";
  QTest::newRow("an end at once") << QByteArray("#!/bin/sh\nexit 127\n")
                                  << begin + "it ended as soon as it started (exit status 127); " + again;
  QTest::newRow("no answer") << QByteArray("#!/bin/sh\nexit 0\n")
                             << begin + "it ended as soon as it started (exit status 0); " + again;
  QTest::newRow("no program") << QByteArray("text")
                              << begin + "PROGRAM cannot be started (Exec format error); install it again";
}

void ImportProcessTest::a_program_of_another_kind_gets_a_sentence() {
  QFETCH(QByteArray, script);
  QFETCH(QString, sentence);
  const QTemporaryDir folder;
  const QString program = folder.filePath("program");
  const fs::path path = program.toStdString();
  put_file(path, script.toStdString());
  fs::permissions(path, fs::perms::owner_all);
  Volume volume;
  volume.densities.assign(volume.voxel_count(), 0);
  const auto answer = encode_imported(volume);
  put_file(path.string() + ".answer", {reinterpret_cast<const char*>(answer.data()), answer.size()});
  const ImportInput input("a.msh");
  const QString error = error_of([&] { run_import_of<ImportedMesh>("msh", input, {}, limits_for(0), {}, path); });
  QCOMPARE(error, sentence.replace("PROGRAM", program));
}

void ImportProcessTest::when_no_file_can_be_opened_it_says_so() {
  const ImportInput input("a.msh");
  rlimit before{};
  getrlimit(RLIMIT_NOFILE, &before);
  for (const rlim_t limit : {rlim_t{20}, rlim_t{3}}) {
    const rlimit few{limit, before.rlim_max};
    setrlimit(RLIMIT_NOFILE, &few);
    const QString error = error_of([&] { run_import("msh", input, {}, limits_for(0), {}); });
    setrlimit(RLIMIT_NOFILE, &before);
    QVERIFY2(
        error.startsWith("chainmail-import: ") &&
            error.endsWith(" (Too many open files); close other programs, or raise the limits of this user (ulimit)"),
        qPrintable(error));
  }
}

CHAINMAIL_TEST(ImportProcessTest)

}  // namespace chainmail::test_import_process

#include "test_import_process.moc"
