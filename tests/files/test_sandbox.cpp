#include <fcntl.h>
#include <seccomp.h>
#include <spawn.h>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/ptrace.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

#include <QtTest>
#include <cstdlib>
#include <thread>

#include "files/import/sandbox.h"
#include "files/mesh/open_mesh.h"
#include "files/support.h"

using namespace chainmail::test;

namespace {

/// Returns true if a call returned a descriptor or 0.
bool worked(long result) { return result >= 0; }

bool starts_a_process() {
  const pid_t process = fork();
  if (process == 0) {
    _exit(0);
  }
  return process > 0;  // true even if waiting for the process is not allowed
}

bool starts_a_program() {
  char name[] = "true";
  char* words[] = {name, nullptr};
  pid_t process = 0;
  return posix_spawn(&process, "/bin/true", nullptr, nullptr, words, environ) == 0;
}

/// If it works, it ends this process with status 0, which means success in this test.
bool becomes_a_program() { return execl("/bin/true", "true", nullptr) == 0; }

bool opens_a_socket(int domain) { return worked(socket(domain, SOCK_STREAM, 0)); }

/// Acts like a kernel without seccomp: the import program gets no filter.
bool opens_without_seccomp() {
  const scmp_filter_ctx filter = seccomp_init(SCMP_ACT_ALLOW);
  const scmp_arg_cmp to_set_one{0, SCMP_CMP_EQ, PR_SET_SECCOMP, 0};
  if (seccomp_rule_add(filter, SCMP_ACT_ERRNO(ENOSYS), SCMP_SYS(seccomp), 0) != 0 ||
      seccomp_rule_add_array(filter, SCMP_ACT_ERRNO(EINVAL), SCMP_SYS(prctl), 1, &to_set_one) != 0 ||
      seccomp_load(filter) != 0) {
    return true;
  }
  const QString error = error_of([] { chainmail::open_mesh("a.off"); });
  return !error.startsWith("a.off: this system cannot sandbox the program that reads this format");
}

}  // namespace

using Attempt = bool (*)();
Q_DECLARE_METATYPE(Attempt)

/// Tests the sandbox in which third-party readers run: everything that could leave a trace fails inside and works
/// outside.
class SandboxTest : public QObject {
  Q_OBJECT

 private slots:
  void init();
  void it_forbids_data();
  void it_forbids();
  void it_allows_data();
  void it_allows();
  void where_it_cannot_be_entered_nothing_is_read();

 private:
  enum Result { succeeded, failed, no_sandbox, died };

  /// Runs an attempt in a separate process, and returns its result.
  Result result_of(Attempt attempt, bool in_sandbox) const;

  std::unique_ptr<QTemporaryDir> folder_;
};

void SandboxTest::init() {
  folder_ = std::make_unique<QTemporaryDir>();
  const std::filesystem::path path = folder_->path().toStdString();
  put_file(path / "old", "text");
  std::filesystem::create_directory(path / "folder");
}

SandboxTest::Result SandboxTest::result_of(Attempt attempt, bool in_sandbox) const {
  const pid_t process = fork();
  if (process == 0) {
    if (chdir(qPrintable(folder_->path())) != 0 || (in_sandbox && !chainmail::import::enter_sandbox())) {
      _exit(no_sandbox);
    }
    try {
      _exit(attempt() ? succeeded : failed);
    } catch (...) {
      _exit(died);  // the child process must not continue the test
    }
  }
  int status = 0;
  waitpid(process, &status, 0);
  return WIFEXITED(status) ? Result(WEXITSTATUS(status)) : died;
}

void SandboxTest::it_forbids_data() {
  QTest::addColumn<Attempt>("forbidden");
  const auto row = [](const char* name, Attempt forbidden) { QTest::newRow(name) << forbidden; };
  row("creating a file", [] { return worked(open("new", O_WRONLY | O_CREAT, 0600)); });
  row("creating a file, as of old", [] { return worked(creat("new", 0600)); });
  row("creating a file with a stream", [] { return std::fopen("new", "w") != nullptr; });
  row("creating a file without a name", [] { return worked(open(".", O_WRONLY | O_TMPFILE, 0600)); });
  row("opening a file for writing", [] { return worked(open("old", O_WRONLY)); });
  row("opening a file for both", [] { return worked(open("old", O_RDWR)); });
  row("emptying a file", [] { return worked(open("old", O_RDONLY | O_TRUNC)); });
  row("cutting a file off", [] { return worked(truncate("old", 0)); });
  row("removing a file", [] { return worked(unlink("old")); });
  row("renaming a file", [] { return worked(rename("old", "new")); });
  row("linking to a file", [] { return worked(link("old", "new")); });
  row("linking to a name", [] { return worked(symlink("old", "new")); });
  row("changing permissions", [] { return worked(chmod("old", 0777)); });
  row("making a folder", [] { return worked(mkdir("new", 0700)); });
  row("removing a folder", [] { return worked(rmdir("folder")); });
  row("making a pipe with a name", [] { return worked(mkfifo("new", 0600)); });
  row("a file in memory", [] { return worked(memfd_create("new", 0)); });
  row("starting a process", starts_a_process);
  row("starting a program", starts_a_program);
  row("becoming a program", becomes_a_program);
  row("running a command", [] { return std::system("exit 0") == 0; });
  row("a socket of the network", [] { return opens_a_socket(AF_INET); });
  row("a socket of the machine", [] { return opens_a_socket(AF_UNIX); });
  row("signals to others", [] { return worked(kill(getppid(), 0)); });
  row("being traced", [] { return worked(ptrace(PTRACE_TRACEME, 0, nullptr, nullptr)); });
}

void SandboxTest::it_forbids() {
  QFETCH(Attempt, forbidden);
  QCOMPARE(result_of(forbidden, true), failed);
  QCOMPARE(result_of(forbidden, false), succeeded);
}

void SandboxTest::it_allows_data() {
  QTest::addColumn<Attempt>("allowed");
  const auto row = [](const char* name, Attempt allowed) { QTest::newRow(name) << allowed; };
  row("reading a file", [] { return file_text("old") == "text"; });
  row("listing a folder", [] { return files_in(".") == 2; });
  row("much memory", [] { return std::vector<char>(std::size_t{64} << 20, 'x').back() == 'x'; });
  row("a thread", [] {
    bool ran = false;
    std::jthread([&ran] { ran = true; }).join();
    return ran;
  });
  row("a pipe", [] {
    int ends[2];
    char letter = 0;
    return pipe(ends) == 0 && write(ends[1], "x", 1) == 1 && read(ends[0], &letter, 1) == 1 && letter == 'x';
  });
}

void SandboxTest::it_allows() {
  QFETCH(Attempt, allowed);
  QCOMPARE(result_of(allowed, true), succeeded);
}

void SandboxTest::where_it_cannot_be_entered_nothing_is_read() {
  put_file(folder_->filePath("a.off").toStdString(), "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n");
  QCOMPARE(result_of([] { return chainmail::open_mesh("a.off").mesh->element_count() == 3; }, false), succeeded);
  QCOMPARE(result_of(opens_without_seccomp, false), failed);
}

QTEST_APPLESS_MAIN(SandboxTest)
#include "test_sandbox.moc"
