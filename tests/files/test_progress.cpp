#include <QtTest>

#include "files/support.h"
#include "program.h"

namespace chainmail::test_progress {

using namespace chainmail::test;

namespace fs = std::filesystem;

/// Long work reports its progress, and cancelled work leaves no files.
class ProgressTest : public QObject {
  Q_OBJECT

 private slots:
  void parts_lie_within_their_whole();
  void nobody_need_watch();
  void watchers_receive_share_and_text();
  void what_is_read_comes_to_its_end_data();
  void what_is_read_comes_to_its_end();
  void cancelled_building_builds_nothing();
  void cancelled_reading_reads_nothing_data() { what_is_read_comes_to_its_end_data(); }
  void cancelled_reading_reads_nothing();
  void cancelled_saving_leaves_the_file_that_was_there_data();
  void cancelled_saving_leaves_the_file_that_was_there();

 private:
  fs::path path(const QString& name) const { return fs::path(folder_.filePath(name).toStdString()); }

  MeshPointer mesh_ = made(MeshKind::grid, {120, 100, 1});  // more elements than between two progress reports
  QTemporaryDir folder_;
};

void ProgressTest::parts_lie_within_their_whole() {
  const Progress progress = Progress::watched();
  progress.report(0.25);
  QCOMPARE(progress.share(), 0.25);
  const Progress part = progress.part(0.2, 0.6);
  part.report(0.5);
  QCOMPARE(progress.share(), 0.4);
  part.part(0.5, 1).report(1);
  QCOMPARE(progress.share(), 0.6);
  progress.cancel();
  QVERIFY_THROWS_EXCEPTION(Cancelled, part.report(0.7));
  QCOMPARE(progress.share(), 0.6);
}

void ProgressTest::nobody_need_watch() {
  Progress().report(0.5);
  Progress().part(0, 0.5).report(0, 0);
  Progress().cancel();
  QVERIFY(!Progress().cancelled() && Progress().text().empty());
}

void ProgressTest::watchers_receive_share_and_text() {
  std::vector<std::pair<double, std::string>> seen;
  const Progress job =
      Progress::watched([&](double share, const std::string& text) { seen.emplace_back(share, text); });
  job.show(0.1);
  job.say("half");
  QCOMPARE(job.text(), std::string("half"));
  job.part(0.5, 1).show(0);
  job.quiet().part(0, 1).report(0.9);  // only cancels
  QCOMPARE(job.share(), 0.5);
  job.cancel();
  job.show(0.6);  // the work ends by itself
  QVERIFY(seen == (decltype(seen){{0.1, ""}, {0.5, "half"}, {0.6, "half"}}));
  QVERIFY_THROWS_EXCEPTION(Cancelled, job.quiet().report(0.9));
}

void ProgressTest::what_is_read_comes_to_its_end_data() {
  QTest::addColumn<QString>("name");
  QTest::newRow("dat") << "mesh.dat";
  QTest::newRow("obj") << "mesh.obj";
}

void ProgressTest::what_is_read_comes_to_its_end() {
  QFETCH(QString, name);
  const Progress saving = Progress::watched(), reading = Progress::watched();
  save_mesh(path(name), {*mesh_, {}, rest_positions(*mesh_), {}}, saving);
  QVERIFY(saving.share() > 0.5 && saving.share() <= 1);
  const auto again = read_mesh(path(name), {}, reading);
  QVERIFY(reading.share() > 0.9 && reading.share() <= 1);
  QVERIFY(again->links == mesh_->links && again->rest == mesh_->rest);
}

void ProgressTest::cancelled_building_builds_nothing() {
  const Progress job = Progress::watched();
  job.cancel();
  QVERIFY_THROWS_EXCEPTION(Cancelled, generate({MeshKind::tetra, {20, 20, 20}, 1, {}}, job));
}

void ProgressTest::cancelled_reading_reads_nothing() {
  QFETCH(QString, name);
  save_mesh(path(name), {*mesh_, {}, rest_positions(*mesh_), {}});
  const Progress job = Progress::watched();
  job.cancel();
  QVERIFY_THROWS_EXCEPTION(Cancelled, read_mesh(path(name), {}, job));
}

void ProgressTest::cancelled_saving_leaves_the_file_that_was_there_data() {
  QTest::addColumn<QString>("name");
  for (const MeshFormat& format : mesh_formats()) {
    if (format.writes()) {
      const QString ending =
          QString::fromUtf8(format.endings.data(), qsizetype(format.endings.size())).section(' ', 0, 0);
      QTest::newRow(qPrintable(ending)) << "mesh" + ending;
    }
  }
}

void ProgressTest::cancelled_saving_leaves_the_file_that_was_there() {
  QFETCH(QString, name);
  QTemporaryDir folder;
  const fs::path there = fs::path(folder.filePath(name).toStdString());
  const MeshPointer mesh = made(MeshKind::tetra, {30, 20, 20});  // every format holds it
  const Progress job = Progress::watched();
  job.cancel();
  const auto save = [&] { save_mesh(there, {*mesh, {}, rest_positions(*mesh), {}}, job); };
  QVERIFY_THROWS_EXCEPTION(Cancelled, save());
  QCOMPARE(files_in(folder.path().toStdString()), 0);
  put_file(there, "before");
  QVERIFY_THROWS_EXCEPTION(Cancelled, save());
  QCOMPARE(file_text(there), std::string("before"));
  QCOMPARE(files_in(folder.path().toStdString()), 1);
}

CHAINMAIL_TEST(ProgressTest)

}  // namespace chainmail::test_progress

#include "test_progress.moc"
