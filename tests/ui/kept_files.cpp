// Tests the files that the window keeps for its user, without a window: unsaved work and presets.

#include <QDateTime>
#include <QDir>
#include <QFile>
#include <QSettings>
#include <QTemporaryDir>
#include <QTest>
#include <memory>

#include "docks/preset_row.h"
#include "io/unsaved_work.h"
#include "mesh/error.h"
#include "program.h"

namespace chainmail::kept_files {

namespace {

QStringList kept() { return QDir(unsaved_work::folder()).entryList({QStringLiteral("*.chainmail")}, QDir::Files); }

void put(const QString& name, const QDateTime& changed) {
  QFile file(QDir(unsaved_work::folder()).filePath(name));
  QVERIFY(file.open(QIODevice::ReadWrite | QIODevice::Truncate) && file.write("{") == 1 && file.flush());
  QVERIFY(file.setFileTime(changed, QFileDevice::FileModificationTime));
}

void writeText(const QString& path, const char* text) {
  QFile file(path);
  QVERIFY(file.open(QIODevice::WriteOnly) && file.write(text) > 0);
}

}  // namespace

class KeptFiles : public QObject {
  Q_OBJECT

 private slots:
  void initTestCase() {
    QCoreApplication::setOrganizationName(QStringLiteral("ChainMail"));
    QCoreApplication::setApplicationName(QStringLiteral("workbench"));
    QSettings::setDefaultFormat(QSettings::IniFormat);
  }

  /// Each function has a folder of its own, so that the user's files are not used.
  void init() {
    folder_ = std::make_unique<QTemporaryDir>();
    QSettings::setPath(QSettings::IniFormat, QSettings::UserScope, folder_->path());
    qputenv("XDG_DATA_HOME", folder_->path().toUtf8());
    QVERIFY(QDir(folder_->path()).mkpath(QFileInfo(PresetStore::file()).path()));
  }

  void whatAnotherWindowOffersIsNotDeleted() {
    for (int i = 1; i <= unsaved_work::maxClosed; ++i) {
      put(QStringLiteral("%1-a.closed-%1.chainmail").arg(i), QDateTime::currentDateTime());
    }
    const QString oldest = QDir(unsaved_work::folder()).filePath(QStringLiteral("1-a.closed-1.chainmail"));
    auto offered = unsaved_work::lock(oldest);
    QVERIFY(offered);
    unsaved_work::discardOldest();
    put(QStringLiteral("99-a.closed-99.chainmail"), QDateTime::currentDateTime());
    unsaved_work::discardOldest();
    QVERIFY(QFile::exists(oldest));
    offered.reset();
    unsaved_work::discardOldest();
    QVERIFY(!QFile::exists(oldest));
    QCOMPARE(kept().size(), unsaved_work::maxClosed);
  }

  void presetsThatCannotBeReadAreKept() {
    const char* const damaged = "{\"presets\": [";
    writeText(PresetStore::file(), damaged);
    PresetStore store;
    QVERIFY_EXCEPTION_THROWN(store.load(), Error);
    store.save({"felt", {0.5, 1.5, 0.2}});
    QFile kept(PresetStore::file() + QStringLiteral(".damaged"));
    QVERIFY(kept.open(QIODevice::ReadOnly) && kept.readAll() == damaged);
    store.load();
    QCOMPARE(store.own().size(), std::size_t{1});
  }

  void presetsOfEarlierVersionsAreTakenOver() {
    QSettings().setValue(
        QStringLiteral("softnessPresets"),
        QStringLiteral("{\"version\": 1, \"presets\": [{\"name\": \"felt\", \"compression\": 0.5, \"stretch\": 1.5, "
                       "\"shear\": 0.2}]}"));
    PresetStore store;
    store.load();
    QCOMPARE(store.own().size(), std::size_t{1});
    store.save({"cloth", {0.9, 1.1, 0.1}});
    QSettings().clear();
    store.load();
    QCOMPARE(store.own().size(), std::size_t{2});
  }

 private:
  std::unique_ptr<QTemporaryDir> folder_;
};

CHAINMAIL_TEST(KeptFiles)

}  // namespace chainmail::kept_files

#include "kept_files.moc"
