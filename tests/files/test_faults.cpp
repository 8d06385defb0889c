// Lets each system call of a save fail in turn, and checks that nothing is lost.

#include <QtTest>
#include <algorithm>
#include <cerrno>
#include <map>

#include "faults.h"
#include "files/session/session.h"
#include "files/support.h"
#include "files/text/outputs.h"
#include "program.h"

namespace chainmail::test_faults {

using namespace chainmail::test;

namespace fs = std::filesystem;

namespace {

/// What a person saves: the files, and how.
struct Saving {
  std::map<std::string, std::string> before;  // content by name
  std::function<void(const fs::path& folder)> save;
};

Outputs::Writer text(const std::string& written) {
  return [written](std::ostream& out) { out << written; };
}

/// Longer than the buffer, so that it takes several writes.
std::string longText(char letter) { return std::string(200'000, letter); }

std::map<std::string, std::string> contentOf(const fs::path& folder) {
  std::map<std::string, std::string> content;
  for (const auto& entry : fs::directory_iterator(folder)) {
    content[entry.path().filename().string()] = file_text(entry.path());
  }
  return content;
}

}  // namespace

class FaultsTest : public QObject {
  Q_OBJECT

 private slots:
  void nothing_is_lost_data();
  void nothing_is_lost();

 private:
  /// Returns the outcome for a fault at the n-th call; empty if there are fewer calls.
  static QString outcome(const Saving& saving, const NamedCall& call, int n, int error, bool stays);
  static QStringList outcomes(const Saving& saving, const NamedCall& call, int error, bool stays);
};

void FaultsTest::nothing_is_lost_data() {
  QTest::addColumn<Saving>("saving");
  QTest::newRow("a new file") << Saving{{},
                                        [](const fs::path& folder) { write_file(folder / "a", text(longText('n'))); }};
  QTest::newRow("one file") << Saving{{{"a", longText('o')}},
                                      [](const fs::path& folder) { write_file(folder / "a", text(longText('n'))); }};
  QTest::newRow("three files") << Saving{{{"a", "old"}, {"c", "old"}}, [](const fs::path& folder) {
                                           Outputs outputs;
                                           for (const char* name : {"a", "b", "c"}) {
                                             outputs.add(folder / name, text("new"));
                                           }
                                           outputs.commit();
                                         }};
  QTest::newRow("a session") << Saving{{{"a.chainmail", "old"}}, [](const fs::path& folder) {
                                         Session session;
                                         session.mesh = made(MeshKind::grid, {30, 20, 1});
                                         session.panels.emplace_back();
                                         save_session(folder / "a.chainmail", session);
                                       }};
}

QString FaultsTest::outcome(const Saving& saving, const NamedCall& call, int n, int error, bool stays) {
  QTemporaryDir temporary;
  const fs::path folder = fs::path(temporary.path().toStdString()) / "work";
  fs::create_directory(folder);
  for (const auto& [name, content] : saving.before) {
    put_file(folder / name, content);
  }
  std::string sentence;
  arm_fault(folder.string(), call.call, n, error, stays);
  try {
    saving.save(folder);
  } catch (const Error& failure) {
    sentence = failure.what();
  }
  const bool has_failed = disarm_fault();
  const auto after = contentOf(folder);
  saving.save(folder);
  const auto next = contentOf(folder);
  if (!has_failed) {
    return {};
  }
  const bool is_old = after == saving.before, is_new = after == next;
  const bool is_whole = std::ranges::all_of(after, [&](const auto& file) {
    return (saving.before.contains(file.first) && saving.before.at(file.first) == file.second) ||
           (next.contains(file.first) && next.at(file.first) == file.second);
  });
  if (!is_whole) {
    return QStringLiteral("LOST: neither old nor new");
  }
  if (sentence.empty() && !is_new) {
    return QStringLiteral("LOST: nothing was said");
  }
  return sentence.empty() ? QStringLiteral("new") : is_old ? QStringLiteral("old, said") : QStringLiteral("new, said");
}

/// Returns the outcomes of a fault at each call of a kind.
QStringList FaultsTest::outcomes(const Saving& saving, const NamedCall& call, int error, bool stays) {
  QStringList seen;
  for (int n = 1; n < 100; ++n) {
    const QString one = outcome(saving, call, n, error, stays);
    if (one.isEmpty()) {
      break;
    }
    seen << QStringLiteral("%1%2: %3").arg(n).arg(stays ? QStringLiteral("…") : QString(), one);
  }
  return seen;
}

void FaultsTest::nothing_is_lost() {
  QFETCH(Saving, saving);
  int faults = 0;
  for (const NamedCall& call : file_calls()) {
    QStringList seen;
    for (const int error : {ENOSPC, EIO, EROFS, EACCES}) {
      seen += outcomes(saving, call, error, false);
      seen += outcomes(saving, call, error, true);
    }
    faults += int(seen.size());
    seen.removeDuplicates();
    const QString words = seen.join(QStringLiteral("; "));
    qInfo("%s: %s", call.name, qPrintable(words));
    QVERIFY(!words.contains(QStringLiteral("LOST")));
  }
  QVERIFY(faults >= 12);  // each error at least at an open, a write and a rename
}

CHAINMAIL_TEST(FaultsTest)

}  // namespace chainmail::test_faults

#include "test_faults.moc"
