#include <linux/sched.h>
#include <seccomp.h>
#include <sys/resource.h>
#include <sys/stat.h>

#include <cerrno>

#include "cli/chainmail_program.h"
#include "folders.h"
#include "packed_voxels.h"
#include "program.h"

namespace chainmail::test_hostile_files {

using namespace chainmail::test;

/// Tests harmful files from outside: the command line refuses them with a message, and no output remains.
class HostileFilesTest : public QObject {
  Q_OBJECT

 private slots:
  void init() { program_ = std::make_unique<Program>(); }
  void scripts_are_not_run_data();
  void scripts_are_not_run();
  void what_is_no_file_is_refused_at_once_data();
  void what_is_no_file_is_refused_at_once();
  void data_outside_need_to_be_allowed();
  void a_temporary_folder_that_is_none_gets_a_sentence_data();
  void a_temporary_folder_that_is_none_gets_a_sentence();
  void known_attacks_end_soon_data();
  void known_attacks_end_soon();
  void a_small_file_of_many_voxels_takes_little_memory();
  void without_threads_it_works_all_the_same();
  void a_limit_of_file_size_is_as_a_full_disk_data();
  void a_limit_of_file_size_is_as_a_full_disk();

 private:
  void make_pipe(const char* name) const { QCOMPARE(mkfifo(qPrintable(program_->path(name)), 0600), 0); }

  std::unique_ptr<Program> program_;
};

void HostileFilesTest::scripts_are_not_run_data() {
  QTest::addColumn<QString>("name");
  QTest::newRow("Gmsh") << "mesh.msh";
  QTest::newRow("Medit") << "mesh.mesh";
}

void HostileFilesTest::scripts_are_not_run() {
  QFETCH(QString, name);
  const QByteArray script =
      "SystemCall \"touch " + program_->path("trace").toUtf8() + "\";\nPrintf(\"gone\") > \"victim\";\n";
  program_->write("victim", "precious");
  program_->write(name, script);
  for (const char* command : {"info", "convert -o out.obj", "fill -o out.msh"}) {
    const auto outcome = program_->run((command + (" " + name)).toUtf8().constData());
    QCOMPARE(outcome.code, 2);
    QVERIFY2(is_one_sentence(outcome) && outcome.error.contains(": it does not begin as a "), outcome.error);
  }
  QCOMPARE(program_->files(), (QStringList{name, "victim"}));
  QCOMPARE(program_->read("victim"), QByteArray("precious"));
}

void HostileFilesTest::what_is_no_file_is_refused_at_once_data() {
  QTest::addColumn<QString>("line");
  QTest::addColumn<QString>("sentence");
  for (const char* name : {"pipe.obj", "pipe.msh", "pipe.ply", "pipe.nhdr", "pipe.mha", "pipe.chainmail"}) {
    QTest::newRow(name) << QString("info %1").arg(name) << QString("%1: it is a pipe; ").arg(name);
  }
  QTest::newRow("device") << "info /dev/zero"
                          << "/dev/zero: it is a device; ";
  QTest::newRow("folder") << "info folder.msh"
                          << "folder.msh: it is a folder; ";
  QTest::newRow("link to a pipe") << "info link.obj"
                                  << "link.obj: it is a pipe; ";
  QTest::newRow("half of a pair") << "info pair.node"
                                  << "pair.ele: it is a pipe; ";
  QTest::newRow("script") << "deform mesh.obj --algorithm exact --script pipe.obj"
                          << "pipe.obj: it is a pipe; ";
  QTest::newRow("softness") << "deform mesh.obj --algorithm exact --softness pipe.obj"
                            << "pipe.obj: it is a pipe; ";
  QTest::newRow("data that are a pipe") << "info pipe.mhd"
                                        << "pipe.raw: it is a pipe; ";
  QTest::newRow("data that are a pipe, NRRD") << "info data.nhdr"
                                              << "pipe.raw: it is a pipe; ";
  QTest::newRow("data that are a device") << "info zero.mhd --data-outside allow"
                                          << "/dev/zero: it is a device; ";
}

void HostileFilesTest::what_is_no_file_is_refused_at_once() {
  QFETCH(QString, line);
  QFETCH(QString, sentence);
  for (const char* name :
       {"pipe.obj", "pipe.msh", "pipe.ply", "pipe.nhdr", "pipe.mha", "pipe.chainmail", "pipe.raw", "pair.ele"}) {
    make_pipe(name);
  }
  QVERIFY(QDir(program_->path(".")).mkdir("folder.msh"));
  QVERIFY(QFile::link("pipe.obj", program_->path("link.obj")));
  const QByteArray head = "ObjectType = Image\nNDims = 3\nDimSize = 2 2 1\nElementType = MET_UCHAR\nElementDataFile = ";
  program_->write("mesh.obj", "v 0 0 0\nv 1 0 0\nl 1 2\n");
  program_->write("pair.node", "1 3 0 0\n1 0 0 0\n");
  program_->write("pipe.mhd", head + "pipe.raw\n");
  program_->write("zero.mhd", head + "/dev/zero\n");
  program_->write("data.nhdr",
                  "NRRD0001\ntype: uchar\ndimension: 3\nsizes: 2 2 1\nencoding: raw\n"
                  "data file: pipe.raw\n");
  const auto outcome = program_->run(line.toUtf8().constData());  // a program that hangs gives no status
  QCOMPARE(outcome.code, 2);
  QVERIFY2(is_one_sentence(outcome) && QString::fromUtf8(outcome.error).contains(sentence), outcome.error);
}

/// The header of a volume may name data in its folder and below; other places need the user's permission.
void HostileFilesTest::data_outside_need_to_be_allowed() {
  const QDir folder(program_->path("."));
  QVERIFY(folder.mkdir("outside") && folder.mkpath("volume/beneath"));
  const QByteArray data(8, '\1');
  program_->write("outside/data.raw", data);
  program_->write("volume/beneath/data.raw", data);
  QVERIFY(QFile::link("../outside/data.raw", program_->path("volume/link.raw")));
  const QByteArray there = program_->path("outside/data.raw").toUtf8();
  const auto info = [&](const QByteArray& ending, const QByteArray& name, const char* option) {
    const QByteArray mhd =
        "ObjectType = Image\nNDims = 3\nDimSize = 2 2 2\nElementType = MET_UCHAR\nElementDataFile = ";
    const QByteArray nhdr = "NRRD0001\ntype: uchar\ndimension: 3\nsizes: 2 2 2\nencoding: raw\ndata file: ";
    program_->write("volume/a." + ending, (ending == "mhd" ? mhd : nhdr) + name + "\n");
    return program_->run("info volume/a." + ending + " --threshold 1 " + option);
  };
  for (const char* ending : {"mhd", "nhdr"}) {
    for (const QByteArray& name : {QByteArray("../outside/data.raw"), there, QByteArray("link.raw"),
                                   QByteArray("beneath/../../outside/data.raw")}) {
      const auto refused = info(ending, name, "");
      QCOMPARE(refused.code, 2);
      QVERIFY2(is_one_sentence(refused) && refused.error.contains(": its data are outside its folder, in '") &&
                   refused.error.contains("--data-outside allow"),
               refused.error);
      QCOMPARE(info(ending, name, "--data-outside refuse").code, 2);
      QVERIFY2(info(ending, name, "--data-outside allow").out.startsWith("elements          8\n"), name);
    }
    QVERIFY(info(ending, "beneath/data.raw", "").out.startsWith("elements          8\n"));
    QVERIFY(info(ending, "./beneath/../beneath/data.raw", "").out.startsWith("elements          8\n"));
  }
}

void HostileFilesTest::a_temporary_folder_that_is_none_gets_a_sentence_data() {
  QTest::addColumn<QString>("folder");
  QTest::addColumn<QString>("sentence");
  QTest::newRow("a file") << "file"
                          << ": it cannot take temporary files (Not a directory); set TMPDIR to a folder";
  QTest::newRow("missing") << "missing"
                           << ": it cannot take temporary files (No such file or directory); set TMPDIR to a folder";
  QTest::newRow("nothing can be created there") << "/proc"
                                                << ": the folder cannot be created (";
}

void HostileFilesTest::a_temporary_folder_that_is_none_gets_a_sentence() {
  QFETCH(QString, folder);
  QFETCH(QString, sentence);
  program_->write("file", "");
  program_->write("a.msh", "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n");
  qputenv("TMPDIR", folder.toUtf8());
  const auto outcome = program_->run("info a.msh");
  qunsetenv("TMPDIR");
  QCOMPARE(outcome.code, 2);
  QVERIFY2(is_one_sentence(outcome), outcome.error);
  QVERIFY2(outcome.error.startsWith("chainmail: " + folder.toUtf8()) && outcome.error.contains(sentence.toUtf8()),
           outcome.error);
  QCOMPARE(program_->files(), (QStringList{"a.msh", "file"}));
}

void HostileFilesTest::known_attacks_end_soon_data() {
  QTest::addColumn<QByteArray>("text");
  const QDir folder(sourceFile("tests/cli/hostile"));
  for (const QString& name : folder.entryList(QDir::Files)) {
    QFile file(folder.filePath(name));
    QVERIFY(file.open(QIODevice::ReadOnly));
    QTest::newRow(qPrintable(name)) << file.readAll();
  }
  QTest::newRow("thin.mha") << packed_volume({1 << 26, 1, 1});
  QTest::newRow("slab.mha") << packed_volume({1 << 13, 1 << 13, 1});
}

/// Each opens, or gives one sentence.
void HostileFilesTest::known_attacks_end_soon() {
  QFETCH(QByteArray, text);
  const QString name = QTest::currentDataTag();
  program_->write(name, text);
  program_->write("grid.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 1 1 0\nf 1 2 4 3\n");
  for (const QStringList& arguments : {QStringList{"info", name}, QStringList{"convert", name, "-o", "out.obj"}}) {
    const auto outcome = program_->run(arguments, [] { limit_resources(5, 1U << 30); });
    QVERIFY2(outcome.code == 0 || (outcome.code == 2 && is_one_sentence(outcome)), outcome.error);
  }
}

/// 2^29 voxels in half a megabyte: they are averaged while they are unpacked.
void HostileFilesTest::a_small_file_of_many_voxels_takes_little_memory() {
  program_->write("large.mha", packed_volume({1024, 1024, 512}));
  const auto outcome = program_->run({"info", "large.mha"}, [] { limit_resources(60, 1U << 29); });
  QVERIFY2(outcome.code == 0, outcome.error);
  QVERIFY2(outcome.out.contains("\nread as           voxels from a density of "), outcome.out);
}

/// Acts like a system on which no more threads may be started: the work is then done by the only one.
void HostileFilesTest::without_threads_it_works_all_the_same() {
#ifdef __SANITIZE_THREAD__
  QSKIP("this sanitizer needs a thread of its own");
#endif
  const scmp_filter_ctx filter = seccomp_init(SCMP_ACT_ALLOW);
  const scmp_arg_cmp of_a_thread{0, SCMP_CMP_MASKED_EQ, CLONE_THREAD, CLONE_THREAD};
  QCOMPARE(seccomp_rule_add(filter, SCMP_ACT_ERRNO(ENOSYS), SCMP_SYS(clone3), 0), 0);  // then clone is used
  QCOMPARE(seccomp_rule_add_array(filter, SCMP_ACT_ERRNO(EAGAIN), SCMP_SYS(clone), 1, &of_a_thread), 0);
  QCOMPARE(program_->run("generate tetra 3x3x3 -o t.msh").code, 0);
  const QString line = "calibrate t.msh --young 3000 --poisson 0.45 --pins bottom --relaxation equilibrium -o new.json";
  const auto outcome = program_->run(line.split(' '), [filter] { seccomp_load(filter); });
  seccomp_release(filter);
  QVERIFY2(outcome.code == 0, outcome.error);
  QVERIFY(program_->files().contains("new.json"));
}

void HostileFilesTest::a_limit_of_file_size_is_as_a_full_disk_data() {
  QTest::addColumn<QString>("line");
  QTest::addColumn<unsigned>("limit");  // file size limit (bytes)
  QTest::addColumn<QString>("file");
  QTest::newRow("generate") << "generate cloth 40x40 -o out.obj" << 4096U << "out.obj";
  QTest::newRow("deform") << "deform mesh.obj --algorithm exact --by 0:-1 --positions out.obj --json out.json" << 4096U
                          << "out.obj";
  QTest::newRow("fill") << "fill ball.obj --edge 0.5 -o out.msh" << 4096U << "out.msh";
  QTest::newRow("what fill needs aside") << "fill ball.obj -o out.msh" << 100U << "/surface";
}

void HostileFilesTest::a_limit_of_file_size_is_as_a_full_disk() {
  QCOMPARE(program_->run("generate cloth 40x40 -o mesh.obj").code, 0);
  program_->write("ball.obj",
                  "v 3 0 0\nv -3 0 0\nv 0 3 0\nv 0 -3 0\nv 0 0 3\nv 0 0 -3\nf 1 3 5\nf 3 2 5\nf 2 4 5\nf 4 1 5\n"
                  "f 3 1 6\nf 2 3 6\nf 4 2 6\nf 1 4 6\n");
  program_->write("out.obj", "old");
  program_->write("out.msh", "old");
  const auto before = program_->files();
  QFETCH(QString, line);
  QFETCH(unsigned, limit);
  QFETCH(QString, file);
  const auto outcome = program_->run(line.split(' '), [limit] {
    const rlimit both{limit, limit};
    setrlimit(RLIMIT_FSIZE, &both);
  });
  QCOMPARE(outcome.code, 1);
  QVERIFY2(is_one_sentence(outcome) &&
               QString::fromUtf8(outcome.error).contains(file + ": it cannot be written to its end (File too large); "),
           outcome.error);
  QCOMPARE(program_->files(), before);
  QCOMPARE(program_->read("out.obj"), QByteArray("old"));
  QCOMPARE(program_->read("out.msh"), QByteArray("old"));
}

CHAINMAIL_TEST(HostileFilesTest)

}  // namespace chainmail::test_hostile_files

#include "test_hostile_files.moc"
