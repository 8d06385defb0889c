#include <fcntl.h>
#include <pthread.h>
#include <seccomp.h>
#include <spawn.h>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/ptrace.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <sys/uio.h>
#include <sys/wait.h>
#include <unistd.h>

#include <QtTest>
#include <cstdlib>
#include <optional>

#include "files/import/sandbox.h"
#include "files/mesh/open_mesh.h"
#include "files/support.h"
#include "program.h"

namespace chainmail::test_sandbox {

using namespace chainmail::test;
using chainmail::import::SandboxFiles;

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

constexpr const char* triangle =
    "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n3\n1 0 0 0\n2 1 0 0\n3 0 1 0\n$EndNodes\n$Elements\n1\n1 2 2 0 1 1 "
    "2 3\n"
    "$EndElements\n";
constexpr const char* given = "../given";  // a file that is open when the sandbox is entered
constexpr const char* given_again = "/proc/self/fd/50";
constexpr int given_number = 50;

bool opens(const std::string& path) { return worked(open(path.c_str(), O_RDONLY)); }
bool writes_to_given() { return write(given_number, "more", 4) == 4; }

bool starts_a_thread() {
  pthread_t thread{};
  return pthread_create(
             &thread, nullptr, [](void* none) { return none; }, nullptr) == 0;
}

/// Reads a variable of the test, which has the same address as in this child process.
bool reads_memory_of_the_parent() {
  static int there = 0;
  int here = 0;
  const iovec to{&here, sizeof here}, from{&there, sizeof there};
  return process_vm_readv(getppid(), &to, 1, &from, 1, 0) == sizeof here;
}

/// Acts like a kernel without Landlock.
bool opens_without_landlock() {
  const scmp_filter_ctx filter = seccomp_init(SCMP_ACT_ALLOW);
  if (seccomp_rule_add(filter, SCMP_ACT_ERRNO(ENOSYS), 444, 0) != 0 || seccomp_load(filter) != 0) {
    return false;
  }
  return !chainmail::import::sandbox_hides_files() && chainmail::open_mesh("a.msh").mesh->element_count() == 3;
}

/// Makes a system call fail with an error, and returns the sentence that opening a mesh then gives.
QString sentence_without(std::initializer_list<const char*> calls, std::uint16_t error) {
  const scmp_filter_ctx filter = seccomp_init(SCMP_ACT_ALLOW);
  for (const char* call : calls) {
    seccomp_rule_add(filter, SCMP_ACT_ERRNO(error), seccomp_syscall_resolve_name(call), 0);
  }
  // The C library then starts processes by clone.
  seccomp_rule_add(filter, SCMP_ACT_ERRNO(ENOSYS), SCMP_SYS(clone3), 0);
  return seccomp_load(filter) == 0 ? error_of([] { chainmail::open_mesh("a.msh"); }) : QString();
}

bool says_that_no_file_can_be_created() {
  return sentence_without({"symlink", "symlinkat"}, ENOSPC)
      .endsWith(
          "/mesh.msh: a link cannot be created (No space left on device); free some space, or set TMPDIR to "
          "another folder");
}

bool says_that_no_process_can_be_started(std::uint16_t error, const char* reason) {
  const QString sentence = sentence_without({"clone", "vfork", "fork"}, error);
  return sentence.startsWith("chainmail-import: ") &&
         sentence.endsWith(QString(" cannot be started (%1); close other programs, or raise the limits of this user "
                                   "(ulimit)")
                               .arg(reason));
}

/// Acts like a kernel without seccomp: the import program gets no filter.
bool opens_without_seccomp() {
  const scmp_filter_ctx filter = seccomp_init(SCMP_ACT_ALLOW);
  const scmp_arg_cmp to_set_one{0, SCMP_CMP_EQ, PR_SET_SECCOMP, 0};
  if (seccomp_rule_add(filter, SCMP_ACT_ERRNO(ENOSYS), SCMP_SYS(seccomp), 0) != 0 ||
      seccomp_rule_add_array(filter, SCMP_ACT_ERRNO(EINVAL), SCMP_SYS(prctl), 1, &to_set_one) != 0 ||
      seccomp_load(filter) != 0) {
    return true;
  }
  const QString error = error_of([] { chainmail::open_mesh("a.msh"); });
  return !error.startsWith("a.msh: this system cannot sandbox the program that reads this format");
}

}  // namespace

using Attempt = bool (*)();

/// Tests the sandbox in which third-party readers run: everything that could leave a trace fails inside and works
/// outside.
class SandboxTest : public QObject {
  Q_OBJECT

 private slots:
  void initTestCase();
  void init();
  void it_forbids_data();
  void it_forbids();
  void it_hides_files_data();
  void it_hides_files();
  void it_allows_data();
  void it_allows();
  void a_file_cannot_grow();
  void where_there_is_no_landlock_files_open();
  void where_it_cannot_be_entered_nothing_is_read();
  void what_the_system_is_short_of_gets_a_sentence();

 private:
  enum Result { succeeded, failed, no_sandbox, died };

  /// Runs an attempt in a separate process, and returns its result. It starts in the folder `inside`.
  Result result_of(Attempt attempt, const std::optional<SandboxFiles>& sandbox) const;
  Result result_inside(Attempt attempt) const { return result_of(attempt, SandboxFiles{".", {given_number}}); }
  Result result_outside(Attempt attempt) const { return result_of(attempt, std::nullopt); }

  std::unique_ptr<QTemporaryDir> folder_;
};

/// Some systems forbid a process to trace its parent. Here it may, so that only the sandbox forbids it.
void SandboxTest::initTestCase() { prctl(PR_SET_PTRACER, PR_SET_PTRACER_ANY); }

void SandboxTest::init() {
  folder_ = std::make_unique<QTemporaryDir>();
  const std::filesystem::path path = folder_->path().toStdString();
  std::filesystem::create_directories(path / "inside" / "folder");
  put_file(path / "inside" / "old", "text");
  put_file(path / "secret", "text");
  put_file(path / "given", "text");
}

SandboxTest::Result SandboxTest::result_of(Attempt attempt, const std::optional<SandboxFiles>& sandbox) const {
  const pid_t process = fork();
  if (process == 0) {
    const bool prepared =
        chdir(qPrintable(folder_->filePath("inside"))) == 0 && dup2(open(given, O_RDWR), given_number) == given_number;
    if (!prepared || (sandbox && !chainmail::import::enter_sandbox(*sandbox))) {
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
  row("targets of links", [] {
    char target[64];
    return worked(readlink("/proc/self/exe", target, sizeof target));
  });
  row("tracing others", [] { return worked(ptrace(PTRACE_SEIZE, getppid(), nullptr, nullptr)); });
  row("memory of others", reads_memory_of_the_parent);
  row("a descriptor of another process", [] { return worked(syscall(SYS_pidfd_open, getppid(), 0)); });
  row("a thread", starts_a_thread);
}

void SandboxTest::it_forbids() {
  QFETCH(Attempt, forbidden);
  QCOMPARE(result_inside(forbidden), failed);
  QCOMPARE(result_outside(forbidden), succeeded);
}

void SandboxTest::it_hides_files_data() {
  QTest::addColumn<Attempt>("hidden");
  const auto row = [](const char* name, Attempt hidden) { QTest::newRow(name) << hidden; };
  row("a file of the user", [] { return opens("../secret"); });
  row("a folder of the user", [] { return opens(".."); });
  row("a file of the system", [] { return opens("/etc/passwd"); });
  row("the memory of the program that started it", [] { return opens("/proc/" + std::to_string(getppid()) + "/mem"); });
  row("the environment of that program", [] { return opens("/proc/" + std::to_string(getppid()) + "/environ"); });
  row("its own memory", [] { return opens("/proc/self/mem"); });
  row("a device", [] { return opens("/dev/zero"); });
}

void SandboxTest::it_hides_files() {
  if (!chainmail::import::sandbox_hides_files()) {
    QSKIP("this kernel has no Landlock, so the sandbox cannot hide files");
  }
  QFETCH(Attempt, hidden);
  QCOMPARE(result_inside(hidden), failed);
  QCOMPARE(result_outside(hidden), succeeded);
}

void SandboxTest::it_allows_data() {
  QTest::addColumn<Attempt>("allowed");
  const auto row = [](const char* name, Attempt allowed) { QTest::newRow(name) << allowed; };
  row("reading a file", [] { return file_text("old") == "text"; });
  row("listing a folder", [] { return files_in(".") == 2; });
  row("much memory", [] { return std::vector<char>(std::size_t{64} << 20, 'x').back() == 'x'; });
  row("opening a given file again", [] { return file_text(given_again) == "text"; });
  row("a pipe", [] {
    int ends[2];
    char letter = 0;
    return pipe(ends) == 0 && write(ends[1], "x", 1) == 1 && read(ends[0], &letter, 1) == 1 && letter == 'x';
  });
}

void SandboxTest::it_allows() {
  QFETCH(Attempt, allowed);
  QCOMPARE(result_inside(allowed), succeeded);
}

/// This holds on kernels without Landlock, too.
void SandboxTest::a_file_cannot_grow() {
  QCOMPARE(result_inside(writes_to_given), died);  // by a signal
  QCOMPARE(result_outside(writes_to_given), succeeded);
}

void SandboxTest::where_there_is_no_landlock_files_open() {
  put_file(folder_->filePath("inside/a.msh").toStdString(), triangle);
  QCOMPARE(result_outside(opens_without_landlock), succeeded);
}

void SandboxTest::where_it_cannot_be_entered_nothing_is_read() {
  put_file(folder_->filePath("inside/a.msh").toStdString(), triangle);
  QCOMPARE(result_outside([] { return chainmail::open_mesh("a.msh").mesh->element_count() == 3; }), succeeded);
  QCOMPARE(result_outside(opens_without_seccomp), failed);
}

void SandboxTest::what_the_system_is_short_of_gets_a_sentence() {
  put_file(folder_->filePath("inside/a.msh").toStdString(), triangle);
  QCOMPARE(result_outside(says_that_no_file_can_be_created), succeeded);
  QCOMPARE(
      result_outside([] { return says_that_no_process_can_be_started(EAGAIN, "Resource temporarily unavailable"); }),
      succeeded);
  QCOMPARE(result_outside([] { return says_that_no_process_can_be_started(ENOMEM, "Cannot allocate memory"); }),
           succeeded);
}

CHAINMAIL_TEST(SandboxTest)

}  // namespace chainmail::test_sandbox

#include "test_sandbox.moc"
