// Tests texts without a window: the links of all pages for users, and where texts of files could become rich text.

#include <QDir>
#include <QDirIterator>
#include <QFile>
#include <QMap>
#include <QRegularExpression>
#include <QTest>
#include <QUrl>

#include "folders.h"
#include "program.h"
#include "window/manual_window.h"

static void loadResources() { Q_INIT_RESOURCE(workbench); }

namespace chainmail::texts {

namespace {

const QString root = sourceFile();
const QString manual = QStringLiteral("resources/manual/");

QString textOf(const QString& file) {
  QFile page(root + QLatin1Char('/') + file);
  return page.open(QIODevice::ReadOnly) ? QString::fromUtf8(page.readAll()) : QString();
}

/// Returns Markdown without its code, in which brackets and # have other meanings.
QString withoutCode(QString text) {
  static const QRegularExpression fenced(QStringLiteral("```.*?```"), QRegularExpression::DotMatchesEverythingOption);
  static const QRegularExpression indented(QStringLiteral("^ {4}.*$"), QRegularExpression::MultilineOption);
  return text.remove(fenced).remove(indented);
}

/// Returns the targets of all links and pictures of a file.
QStringList linksOf(const QString& file) {
  static const QRegularExpression link(QStringLiteral(R"(\]\(([^)\s]+)\))"));
  static const QRegularExpression inlineCode(QStringLiteral("`[^`\n]*`"));
  const QString text = withoutCode(textOf(file)).remove(inlineCode);
  QStringList targets;
  for (auto match = link.globalMatch(text); match.hasNext();) {
    targets << match.next().captured(1);
  }
  return targets;
}

/// Returns the anchors of a page's headings.
QStringList anchorsOf(const QString& file) {
  static const QRegularExpression heading(QStringLiteral("^#+ (.*)$"), QRegularExpression::MultilineOption);
  static const QRegularExpression dropped(QStringLiteral("[^\\w\\- ]"), QRegularExpression::UseUnicodePropertiesOption);
  QStringList anchors;
  for (auto match = heading.globalMatch(withoutCode(textOf(file))); match.hasNext();) {
    anchors << match.next().captured(1).toLower().remove(dropped).replace(QLatin1Char(' '), QLatin1Char('-'));
  }
  return anchors;
}

bool isExternal(const QString& target) { return target.contains(QStringLiteral("://")); }

/// Returns the reason why a link of a file is broken; empty if it works.
QString fault(const QString& file, const QString& target) {
  const QString anchor = target.section(QLatin1Char('#'), 1);
  const QString path = target.section(QLatin1Char('#'), 0, 0);
  const QString to = path.isEmpty() ? file : QDir::cleanPath(QFileInfo(file).path() + QLatin1Char('/') + path);
  if (!QFileInfo::exists(root + QLatin1Char('/') + to)) {
    return QStringLiteral("%1: there is no file %2").arg(file, target);
  }
  if (!anchor.isEmpty() && !anchorsOf(to).contains(anchor)) {
    return QStringLiteral("%1: there is no heading %2").arg(file, target);
  }
  return {};
}

QStringList pagesInSource() {
  return QDir(root + QLatin1Char('/') + manual).entryList({QStringLiteral("*.md")}, QDir::Files, QDir::Name);
}

}  // namespace

class Texts : public QObject {
  Q_OBJECT

 private slots:
  void initTestCase() { loadResources(); }

  /// The first page links to all others.
  void everyPageCanBeReached() {
    QStringList pages = ManualWindow::pages();
    for (const QString& page : ManualWindow::pages().mid(1)) {
      QVERIFY2(linksOf(manual + pages.front()).contains(page), qPrintable(page));
    }
    pages.sort();
    QVERIFY(pages.size() > 5);
    QCOMPARE(pages, pagesInSource());
  }

  void everyLinkLeadsSomewhere_data() {
    QTest::addColumn<QString>("file");
    for (const QString& page : pagesInSource()) {
      QTest::newRow(qPrintable(page)) << manual + page;
    }
    for (const char* file : {"README.md", "CONTRIBUTING.md", "CHANGELOG.md", "core/README.md", "meshes/README.md",
                             "tests/README.md", "tests/bench/README.md"}) {
      QTest::newRow(file) << QString::fromLatin1(file);
    }
  }
  void everyLinkLeadsSomewhere() {
    QFETCH(QString, file);
    QVERIFY(!textOf(file).isEmpty());
    for (const QString& target : linksOf(file)) {
      if (!isExternal(target)) {
        QVERIFY2(fault(file, target).isEmpty(), qPrintable(fault(file, target)));
      }
    }
  }

  void faultyLinksAreFound() {
    QVERIFY(linksOf(QStringLiteral("README.md")).contains(QStringLiteral("resources/manual/tour.md")));
    QCOMPARE(fault(manual + "index.md", QStringLiteral("formats.md#files-from-untrusted-sources")), QString());
    QVERIFY(!fault(manual + "index.md", QStringLiteral("format.md")).isEmpty());
    QVERIFY(!fault(manual + "index.md", QStringLiteral("formats.md#files")).isEmpty());
    QVERIFY(!fault(manual + "index.md", QStringLiteral("#files-from-untrusted-sources")).isEmpty());
  }

  /// All that the window shows must be compiled in, also pictures.
  void everyLinkOfAPageIsInTheWindow() {
    for (const QString& page : ManualWindow::pages()) {
      QCOMPARE(textOf(manual + page).isEmpty(), false);
      for (const QString& target : linksOf(manual + page)) {
        const QUrl url = QUrl(QStringLiteral("qrc:/manual/") + page).resolved(QUrl(target));
        QVERIFY2(isExternal(target) || QFile::exists(QLatin1Char(':') + url.path()), qPrintable(page + ": " + target));
      }
    }
  }

  /// Rich text is asked for by name, in these files. They show numbers and our own words, and escape the rest.
  void richTextIsAskedForByName() {
    const QMap<QString, int> known{
        {"common/theme.cpp", 1},       {"docks/frame_rate_dock.cpp", 1},    {"docks/mesh_dock.cpp", 1},
        {"docks/physics_dock.cpp", 1}, {"docks/propagation_column.cpp", 2}, {"docks/stiffness_dock.cpp", 1},
        {"panels/panel.cpp", 2},       {"tools/element_readout.cpp", 2},    {"window/keys_page.cpp", 3},
        {"window/keys_page.h", 2},     {"window/lecture_mode.cpp", 1},      {"window/manual_window.cpp", 8},
        {"window/manual_window.h", 2}};  // places in each file
    static const QRegularExpression rich(
        QStringLiteral(R"(RichText\)|AutoText\)|MarkdownText|setHtml\(|setMarkdown\(|insertHtml\(|appendHtml\()"
                       R"(|setWhatsThis\(|QWhatsThis|QTextBrowser|QTextEdit|QErrorMessage|convertFromPlainText)"));
    QDirIterator files(sourceFile("ui"), {"*.cpp", "*.h"}, QDir::Files, QDirIterator::Subdirectories);
    int checked = 0;
    while (files.hasNext()) {
      QFile file(files.next());
      QVERIFY(file.open(QIODevice::ReadOnly));
      const QString name = QDir(sourceFile("ui")).relativeFilePath(file.fileName());
      const QString text = QString::fromUtf8(file.readAll());
      int places = 0;
      for (auto found = rich.globalMatch(text); found.hasNext(); found.next()) {
        ++places;
      }
      QVERIFY2(places == known.value(name), qPrintable(QStringLiteral("%1: %2 places").arg(name).arg(places)));
      ++checked;
    }
    QVERIFY(checked > 200);
  }
};

CHAINMAIL_TEST(Texts)

}  // namespace chainmail::texts

#include "texts.moc"
