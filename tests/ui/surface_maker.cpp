// Tests the computation of the surfaces of large meshes, in time and without memory. It limits the address space of its
// process, so it is a program of its own.

#include "drawing/surface_maker.h"

#include <malloc.h>
#include <sys/resource.h>

#include <QFile>
#include <QTest>

#include "mesh/generate.h"

namespace chainmail {

namespace {

/// Returns a mesh whose surface is computed on a separate thread.
MeshPointer largeVolume() { return generate({MeshKind::tetra, {60, 30, 15}, 1, {}}); }

/// Returns the address space of this process in bytes.
rlim_t addressSpace() {
  QFile status(QStringLiteral("/proc/self/status"));
  if (!status.open(QIODevice::ReadOnly)) {
    return RLIM_INFINITY;
  }
  const QByteArray text = status.readAll();
  return text.mid(text.indexOf("VmSize:") + 7).trimmed().split(' ').first().toULongLong() * 1024;
}

/// The process gets no more address space than it has.
class NoMoreMemory {
 public:
  NoMoreMemory() {
    ::getrlimit(RLIMIT_AS, &before_);
    const rlimit now{addressSpace(), before_.rlim_max};
    ::setrlimit(RLIMIT_AS, &now);
  }
  ~NoMoreMemory() { ::setrlimit(RLIMIT_AS, &before_); }
  NoMoreMemory(const NoMoreMemory&) = delete;
  NoMoreMemory& operator=(const NoMoreMemory&) = delete;

 private:
  rlimit before_{};
};

}  // namespace

class SurfaceMakerTest : public QObject {
  Q_OBJECT

 private slots:
  void aLargeSurfaceIsMadeMeanwhileAndSaysWhenItIsThere() {
    const MeshPointer mesh = largeVolume();
    SurfaceMaker maker;
    bool isMade = false;
    connect(&maker, &SurfaceMaker::made, this, [&] { isMade = true; });
    maker.has(mesh);
    QTRY_VERIFY(isMade);
    QVERIFY(maker.has(mesh));
    QCOMPARE(maker.take(mesh)->table().mesh(), mesh);
  }

  void withoutMemoryItSaysSoOnceForEachMesh() {
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
    QSKIP("the sanitizers reserve terabytes of address space");
#endif
    const MeshPointer mesh = largeVolume();
    SurfaceMaker maker;
    QStringList said;
    connect(&maker, &SurfaceMaker::failed, this, [&](const QString& sentence) { said << sentence; });
    bool succeeds = true;
    {
      const NoMoreMemory limit;
      succeeds = maker.succeeds(mesh);
    }
    QVERIFY(!succeeds);
    QVERIFY(!maker.has(mesh));
    QCOMPARE(said.size(), 1);
    QVERIFY2(said.first().startsWith(QStringLiteral("faces: there is not enough memory")), qPrintable(said.first()));
    const MeshPointer other = largeVolume();
    QVERIFY(maker.succeeds(other));
    QCOMPARE(said.size(), 1);
  }
};

}  // namespace chainmail

int main(int argc, char** argv) {
  // Before the first thread starts: large vectors get address space of their own and give it back, so that a limit of
  // it takes effect.
  ::mallopt(M_MMAP_THRESHOLD, 64 * 1024);
  ::mallopt(M_ARENA_MAX, 1);
  const QCoreApplication application(argc, argv);
  chainmail::SurfaceMakerTest test;
  return QTest::qExec(&test, argc, argv);
}
#include "surface_maker.moc"
