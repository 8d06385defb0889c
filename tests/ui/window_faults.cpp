// Lets each system call of what the window writes fail in turn, and checks that nothing is lost.

#include <QDir>
#include <QFile>
#include <QProcess>
#include <cerrno>

#include "docks/preset_row.h"
#include "docks/replay_dock.h"
#include "document/edits.h"
#include "document/element_facts.h"
#include "faults.h"
#include "io/unsaved_work.h"
#include "mesh/error.h"
#include "report_bench.h"
#include "safe_bench.h"
#include "window/bars.h"

namespace chainmail::window_faults {

using namespace chainmail::test;

namespace {

/// Something that the window writes.
class Written {
 public:
  virtual ~Written() = default;

  /// The folder of all its files.
  virtual QString folder() const = 0;
  /// Changes what will be written.
  virtual void change() = 0;
  /// Writes, and returns what the window says about a failure.
  virtual QString write() = 0;
  /// Returns what the files say: equal for equal content. Throws Error if they cannot be read as a whole.
  virtual QString content() const = 0;
  /// True if `after` is what this would have written without a fault, where `again` is the content of the next write.
  virtual bool isNew(const QString& /*before*/, const QString& after, const QString& again) const {
    return after == again;
  }
};

QByteArray bytesOf(const QString& path) {
  QFile file(path);
  return file.open(QIODevice::ReadOnly) ? file.readAll() : QByteArray();
}

/// Returns the number of pins in a session; "none" if there is no file.
QString pinsIn(const QString& path) {
  return QFile::exists(path) ? QString::number(unsaved_work::read(path).pins.size()) : QStringLiteral("none");
}

void pinOrUnpin(Document& document) { edits::setPinned(document, {3}, !isPinned(document, 3)); }

/// Collects the sentences of a signal.
template <class Object, class Signal>
QString saidDuring(Object* object, Signal signal, const std::function<void()>& act) {
  QStringList said;
  QObject context;
  QObject::connect(object, signal, &context, [&](const QString& sentence) { said << sentence; });
  act();
  return said.join(QLatin1Char('\n'));
}

class WrittenSession : public Written {
 public:
  QString folder() const override { return folder_.path(); }
  void change() override { pinOrUnpin(bench_.document()); }
  QString write() override {
    return saidDuring(&bench_.window.jobs(), &Jobs::failed, [&] {
      bench_.window.sessions().savePath(path_);
      bench_.settle();
    });
  }
  QString content() const override { return pinsIn(path_); }

 private:
  QTemporaryDir folder_;
  QString path_ = folder_.filePath(QStringLiteral("work.chainmail"));
  Workbench bench_{cloth()};
};

class WrittenByItself : public Written {
 public:
  QString folder() const override { return unsaved_work::folder(); }
  void change() override { pinOrUnpin(bench_.document()); }
  QString write() override {
    bench_.save();
    const QString said = bench_.window.messages().isVisible() ? bench_.window.messages().sentence() : QString();
    return said.startsWith(QStringLiteral("Automatic saving failed")) ? said : QString();
  }
  QString content() const override {
    const QStringList files = QDir(folder()).entryList({QStringLiteral("*.chainmail")}, QDir::Files);
    return files.size() == 1 ? pinsIn(QDir(folder()).filePath(files.first()))
                             : QStringLiteral("%1 files").arg(files.size());
  }

 private:
  SafeBench bench_;
};

class WrittenPresets : public Written {
 public:
  QString folder() const override { return QFileInfo(PresetStore::file()).path(); }
  void change() override { ++number_; }
  QString write() override {
    try {
      PresetStore().save({"felt", LinkSoftness{0.5, 1 + 0.01 * number_, 0.1}});
      return {};
    } catch (const Error& error) {
      return QString::fromStdString(error.what());
    }
  }
  QString content() const override {
    PresetStore store;
    store.load();
    return store.own().empty() ? QStringLiteral("none") : QString::number(store.own().front().softness.stretch);
  }

 private:
  int number_ = 0;
};

class WrittenReport : public Written {
 public:
  WrittenReport() { bench_.run(); }
  QString folder() const override { return folder_.path(); }
  void change() override { bench_.run(); }
  QString write() override {
    return saidDuring(bench_.window.findChild<ReportDock*>(), &ReportDock::failed,
                      [&] { bench_.results().saveTo(folder_.path()); });
  }
  QString content() const override {
    QStringList files;
    for (const QString& name : QDir(folder_.path()).entryList(QDir::Files)) {
      QByteArray bytes = bytesOf(folder_.filePath(name));
      files << QStringLiteral("%1:%2:%3").arg(name).arg(bytes.size()).arg(qHash(bytes));
    }
    return files.join(QLatin1Char(' '));
  }
  /// Each file is old or new as a whole.
  bool isNew(const QString& before, const QString& after, const QString& again) const override {
    const QStringList whole = (before + QLatin1Char(' ') + again).split(QLatin1Char(' '));
    return std::ranges::all_of(after.split(QLatin1Char(' ')), [&](const QString& one) { return whole.contains(one); });
  }

 private:
  QTemporaryDir folder_;
  ReportBench bench_;
};

class WrittenFilm : public Written {
 public:
  WrittenFilm() : path_(folder_.filePath(QStringLiteral("film.mp4"))) {
    drag(bench_.document(), 31, {1.5, 0.3, 0});
    bench_.settle();
  }
  QString folder() const override { return folder_.path(); }
  /// Moves the camera, so that every picture changes.
  void change() override {
    bench_.view(0).pan(QPointF(turns_ % 2 == 0 ? 20 : -20, 0));
    ++turns_;
  }
  QString write() override {
    auto* dock = bench_.window.findChild<ReplayDock*>();
    return saidDuring(dock, &ReplayDock::failed, [&] {
      dock->saveFilm(path_);
      QTRY_VERIFY_WITH_TIMEOUT(!bench_.document().moves().isFilming(), 60'000);
      bench_.settle();
    });
  }
  QString content() const override {
    QStringList files;
    for (const QString& name : QDir(folder_.path()).entryList(QDir::Files)) {
      requireWhole(folder_.filePath(name));
      files << QString::number(qHash(bytesOf(folder_.filePath(name))));
    }
    return files.join(QLatin1Char(' '));
  }
  /// The pictures contain times, so that no two films are equal. Each picture is old or new as a whole.
  bool isNew(const QString& before, const QString& after, const QString& /*again*/) const override {
    const QStringList old = before.split(QLatin1Char(' ')), present = after.split(QLatin1Char(' '));
    return old.size() == present.size() &&
           (old.size() > 1 || std::ranges::none_of(present, [&](const QString& one) { return old.contains(one); }));
  }

 private:
  static void requireWhole(const QString& path) {
    const bool isWhole = QProcess::execute(QStringLiteral("ffmpeg"),
                                           {QStringLiteral("-v"), QStringLiteral("error"), QStringLiteral("-i"), path,
                                            QStringLiteral("-f"), QStringLiteral("null"), QStringLiteral("-")}) == 0;
    if (!isWhole) {
      throw Error(path.toStdString(), "it is damaged", "mend the film");
    }
  }

  QTemporaryDir folder_;
  QString path_;
  Workbench bench_;
  int turns_ = 0;
};

}  // namespace

class WindowFaults : public QObject {
  Q_OBJECT

 private slots:
  void init() { QVERIFY(QDir(unsaved_work::folder()).removeRecursively()); }

  void nothingIsLost_data() {
    QTest::addColumn<std::function<std::unique_ptr<Written>()>>("make");
    QTest::addColumn<std::vector<int>>("errors");
    const auto row = [](const char* name, const std::vector<int>& errors,
                        std::function<std::unique_ptr<Written>()> make) {
      QTest::newRow(name) << std::move(make) << errors;
    };
    const std::vector<int> all{ENOSPC, EIO, EROFS, EACCES}, full{ENOSPC};
    row("session", all, [] { return std::make_unique<WrittenSession>(); });
    row("automatic saving", all, [] { return std::make_unique<WrittenByItself>(); });
    row("presets", all, [] { return std::make_unique<WrittenPresets>(); });
    // These make many calls, and each takes a whole report or film: the first of a kind must do.
    row("report", full, [] { return std::make_unique<WrittenReport>(); });
    row("video", full, [] { return std::make_unique<WrittenFilm>(); });
  }
  void nothingIsLost() {
    QFETCH(std::function<std::unique_ptr<Written>()>, make);
    QFETCH(std::vector<int>, errors);
    const bool everything = errors.size() > 1;
    const int most = everything ? 100 : 3;
    const std::unique_ptr<Written> written = make();
    written->change();
    QCOMPARE(written->write(), QString());
    int faults = 0;
    for (const NamedCall& call : file_calls()) {
      QStringList seen;
      for (const int error : errors) {
        seen += outcomes(*written, call, error, false, most);
      }
      if (everything) {
        seen += outcomes(*written, call, ENOSPC, true, most);
      }
      faults += int(seen.size());
      seen.removeDuplicates();
      const QString words = seen.join(QStringLiteral("; "));
      qInfo("%s: %s", call.name, qPrintable(words));
      QVERIFY(!words.contains(QStringLiteral("LOST")));
    }
    QVERIFY(faults >= 4);
  }

 private:
  /// Returns the outcome for a fault at the n-th call; empty if there are fewer calls.
  static QString outcome(Written& written, const NamedCall& call, int n, int error, bool stays) {
    const QString before = written.content();
    written.change();
    arm_fault(written.folder().toStdString(), call.call, n, error, stays);
    const QString said = written.write();
    const bool hasFailed = disarm_fault();
    QString after;
    try {
      after = written.content();
    } catch (const Error& failure) {
      return QStringLiteral("LOST: ") + QString::fromStdString(failure.what());
    }
    if (const QString again = written.write(); !again.isEmpty()) {
      return QStringLiteral("LOST: the next one failed, too: ") + again;
    }
    if (!hasFailed) {
      return {};
    }
    const bool isOld = after == before;
    if (!isOld && !written.isNew(before, after, written.content())) {
      return QStringLiteral("LOST: neither old nor new: ") + after;
    }
    if (said.isEmpty() && isOld) {
      return QStringLiteral("LOST: nothing was said");
    }
    return (isOld ? QStringLiteral("old") : QStringLiteral("new")) +
           (said.isEmpty() ? QString() : QStringLiteral(", said"));
  }

  /// Returns the outcomes of a fault at each call of a kind.
  static QStringList outcomes(Written& written, const NamedCall& call, int error, bool stays, int most) {
    QStringList seen;
    for (int n = 1; n <= most; ++n) {
      const QString one = outcome(written, call, n, error, stays);
      if (one.isEmpty()) {
        break;
      }
      seen << QStringLiteral("%1%2: %3").arg(n).arg(stays ? QStringLiteral("…") : QString(), one);
    }
    return seen;
  }
};

CHAINMAIL_WINDOW_TEST(WindowFaults)

}  // namespace chainmail::window_faults

#include "window_faults.moc"
