// Tests the manual in a real window, and the links of all pages for users.

#include <QClipboard>
#include <QDesktopServices>
#include <QDialog>
#include <QDialogButtonBox>
#include <QDir>
#include <QFile>
#include <QLineEdit>
#include <QPushButton>
#include <QRegularExpression>
#include <QScrollBar>
#include <QTextBlock>
#include <QTextBrowser>
#include <QTextTable>
#include <QToolButton>
#include <QWheelEvent>

#include "folders.h"
#include "window.h"
#include "window/manual_window.h"

namespace chainmail::window_manual {

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

/// The manual, opened with Help > Manual.
struct Manual : Workbench {
  Manual() {
    trigger("showManual");
    manual = find<ManualWindow>("manualWindow");
    page = manual->findChild<QTextBrowser*>(QStringLiteral("manualPage"));
    search = manual->findChild<QLineEdit*>(QStringLiteral("manualSearch"));
    active = QTest::qWaitFor([this] { return manual->isActiveWindow(); });
  }

  QString file() const { return page->source().fileName(); }

  /// Clicks in the middle of the first word that links to a target.
  void clickLink(const QString& target) {
    for (QTextBlock block = page->document()->begin(); block.isValid(); block = block.next()) {
      for (auto part = block.begin(); !part.atEnd(); ++part) {
        if (part.fragment().charFormat().anchorHref() == target) {
          QTextCursor cursor(page->document());
          cursor.setPosition(part.fragment().position() + 1);
          page->setTextCursor(cursor);
          page->ensureCursorVisible();
          QTest::mouseClick(page->viewport(), Qt::LeftButton, {}, page->cursorRect().center());
          return;
        }
      }
    }
    QFAIL(qPrintable(QStringLiteral("no link to ") + target));
  }

  /// True if a heading is in the visible part of the page.
  bool showsHeading(const QString& text) const {
    for (QTextBlock block = page->document()->begin(); block.isValid(); block = block.next()) {
      if (block.blockFormat().headingLevel() > 0 && block.text() == text) {
        return page->viewport()->rect().intersects(page->cursorRect(QTextCursor(block)));
      }
    }
    return false;
  }

  void press(const char* button) {
    QTest::mouseClick(manual->findChild<QToolButton*>(QLatin1String(button)), Qt::LeftButton);
  }

  ManualWindow* manual;
  QTextBrowser* page;
  QLineEdit* search;
  bool active = false;
};

/// Replaces the browser in which external links open.
class Browser : public QObject {
  Q_OBJECT

 public:
  Browser() { QDesktopServices::setUrlHandler(QStringLiteral("https"), this, "open"); }
  ~Browser() override { QDesktopServices::unsetUrlHandler(QStringLiteral("https")); }
  QList<QUrl> opened;

 public slots:
  void open(const QUrl& url) { opened << url; }
};

}  // namespace

class WindowManual : public QObject {
  Q_OBJECT

 private slots:
  void init() { failOnWarnings(); }

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

  void theMenuOpensItsFirstPage() {
    Manual bench;
    QVERIFY(bench.active && bench.manual->isVisible());
    QCOMPARE(bench.file(), ManualWindow::pages().front());
    QVERIFY(bench.page->toPlainText().startsWith(QStringLiteral("ChainMail manual")));
    bench.manual->open(QStringLiteral("speed.md"));
    bench.trigger("showManual");  // the same window, still with that page
    QCOMPARE(bench.window.findChildren<ManualWindow*>().size(), qsizetype{1});
    QCOMPARE(bench.file(), QStringLiteral("speed.md"));
  }

  void aClickOnALinkShowsItsPage() {
    Manual bench;
    bench.clickLink(QStringLiteral("physics.md"));
    QCOMPARE(bench.file(), QStringLiteral("physics.md"));
    bench.press("manualBack");
    QCOMPARE(bench.file(), QStringLiteral("index.md"));
    bench.press("manualForward");
    QCOMPARE(bench.file(), QStringLiteral("physics.md"));
  }

  void aLinkToAHeadingShowsIt() {
    Manual bench;
    bench.manual->open(QStringLiteral("tour.md"));
    QCOMPARE(bench.page->verticalScrollBar()->value(), 0);
    bench.clickLink(QStringLiteral("command-line.md#scripts-of-moves"));
    QCOMPARE(bench.file(), QStringLiteral("command-line.md"));
    QVERIFY(bench.showsHeading(QStringLiteral("Scripts of moves")));
    bench.manual->open(QStringLiteral("tour.md#cut"));
    QVERIFY(bench.showsHeading(QStringLiteral("Cut")));
    QVERIFY(!bench.showsHeading(QStringLiteral("Tour")));
  }

  void otherLinksOpenInTheBrowser() {
    Manual bench;
    Browser browser;
    bench.page->setMarkdown(QStringLiteral("[elsewhere](https://example.org/page)"));
    bench.clickLink(QStringLiteral("https://example.org/page"));
    QCOMPARE(browser.opened, QList<QUrl>{QUrl(QStringLiteral("https://example.org/page"))});
  }

  void wordsAreFoundInThePage() {
    Manual bench;
    bench.manual->open(QStringLiteral("tour.md"));
    QTest::keyClick(bench.page, Qt::Key_F, Qt::ControlModifier);
    QVERIFY(bench.search->hasFocus());
    QTest::keyClicks(bench.search, QStringLiteral("panels"));
    QList<int> found;
    const auto at = [&bench] { return bench.page->textCursor().selectionStart(); };
    do {
      QTest::keyClick(bench.search, Qt::Key_Return);
      QCOMPARE(bench.page->textCursor().selectedText().toLower(), QStringLiteral("panels"));
      found << at();
    } while (found.size() < 2 || found.back() > found[found.size() - 2]);
    QVERIFY(found.size() > 3);
    QCOMPARE(found.back(), found.front());  // after the last one, the first one
    QTest::keyClick(bench.page, Qt::Key_F3, Qt::ShiftModifier);
    QCOMPARE(at(), found[found.size() - 2]);
    bench.search->setText(QStringLiteral("no such words"));
    QTest::keyClick(bench.search, Qt::Key_Return);
    QVERIFY(bench.search->palette().color(QPalette::Text) != QApplication::palette().color(QPalette::Text));
    QCOMPARE(at(), found[found.size() - 2]);
  }

  void theWindowFitsTheScreen() {
    Manual bench;
    QVERIFY(bench.manual->screen()->availableGeometry().contains(bench.manual->frameGeometry()));
    bench.manual->open(QStringLiteral("tour.md"));
    bench.press("manualFirst");
    QCOMPARE(bench.file(), QStringLiteral("index.md"));
  }

  void aboutIsTextThatCanBeCopied() {
    Workbench bench;
    bench.trigger("showAbout");
    auto* dialog = bench.find<QDialog>("aboutDialog");
    QVERIFY(dialog->isVisible());
    bench.find<QPushButton>("aboutCopy")->click();
    const QString text = QApplication::clipboard()->text();
    for (const QString& part : {QStringLiteral("ChainMail workbench "), QStringLiteral("MIT licence"),
                                QStringLiteral("Qt: ") + QLatin1String(qVersion()), QStringLiteral("OpenGL: "),
                                QStringLiteral("Renderer: ")}) {
      QVERIFY2(text.contains(part), qPrintable(text));
    }
    QVERIFY(!text.contains(QStringLiteral("not available")));
    QVERIFY(!text.contains(QStringLiteral("Renderer: ,")));
    dialog->findChild<QDialogButtonBox*>()->button(QDialogButtonBox::Close)->click();
    QVERIFY(!dialog->isVisible());
  }

  void theWheelZooms() {
    Manual bench;
    const double before = bench.page->font().pointSizeF();
    const QPointF at = bench.page->viewport()->rect().center();
    QWheelEvent wheel(at, bench.page->viewport()->mapToGlobal(at), {}, {0, 120}, Qt::NoButton, Qt::ControlModifier,
                      Qt::NoScrollPhase, false);
    QApplication::sendEvent(bench.page->viewport(), &wheel);
    QVERIFY(bench.page->font().pointSizeF() > before);
  }

  /// No table or picture is wider than the page, even in a window with the initial size.
  void nothingIsCutOff() {
    Manual bench;
    for (const QString& page : ManualWindow::pages()) {
      bench.manual->open(page);
      QVERIFY2(bench.page->horizontalScrollBar()->maximum() == 0, qPrintable(page));
    }
  }

  void aLineWithAPictureIsAsHighAsIt() {
    Manual bench;
    bench.manual->open(QStringLiteral("physics.md"));
    for (QTextBlock block = bench.page->document()->begin(); block.isValid(); block = block.next()) {
      if (block.text().contains(QChar::ObjectReplacementCharacter)) {
        QCOMPARE(block.blockFormat().lineHeightType(), int(QTextBlockFormat::SingleHeight));
        return;
      }
    }
    QFAIL("no picture");
  }

  void tablesHaveAllTheirCells() {
    Manual bench;
    bench.manual->open(QStringLiteral("speed.md"));
    int tables = 0;
    for (QTextFrame* frame : bench.page->document()->rootFrame()->childFrames()) {
      const auto* table = qobject_cast<QTextTable*>(frame);
      for (int row = 0; table != nullptr && row < table->rows(); ++row) {
        QCOMPARE(table->cellAt(row, 0).columnSpan() + table->cellAt(row, table->columns() - 2).columnSpan(), 2);
      }
      tables += int(table != nullptr);
    }
    QVERIFY(tables > 1);
  }
};

CHAINMAIL_WINDOW_TEST(WindowManual)

}  // namespace chainmail::window_manual

#include "window_manual.moc"
