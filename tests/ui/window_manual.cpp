// Tests the manual in a real window. What its pages link to is tested in texts.cpp.

#include <QClipboard>
#include <QDesktopServices>
#include <QDialog>
#include <QDialogButtonBox>
#include <QLineEdit>
#include <QPushButton>
#include <QScrollBar>
#include <QTextBlock>
#include <QTextBrowser>
#include <QTextTable>
#include <QToolButton>
#include <QWheelEvent>

#include "window.h"
#include "window/manual_window.h"

namespace chainmail::window_manual {

namespace {

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

  void theMenuOpensItsFirstPageOnTheScreen() {
    Manual bench;
    QVERIFY(bench.active && bench.manual->isVisible());
    QCOMPARE(bench.file(), ManualWindow::pages().front());
    QVERIFY(bench.page->toPlainText().startsWith(QStringLiteral("ChainMail manual")));
    bench.manual->open(QStringLiteral("speed.md"));
    bench.trigger("showManual");  // the same window, still with that page
    QCOMPARE(bench.window.findChildren<ManualWindow*>().size(), qsizetype{1});
    QCOMPARE(bench.file(), QStringLiteral("speed.md"));
    QVERIFY(bench.manual->screen()->availableGeometry().contains(bench.manual->frameGeometry()));
    bench.manual->open(QStringLiteral("tour.md"));
    bench.press("manualFirst");
    QCOMPARE(bench.file(), QStringLiteral("index.md"));
  }

  void aClickOnALinkShowsItsPageOrHeadingOrOpensTheBrowser() {
    Manual bench;
    bench.clickLink(QStringLiteral("physics.md"));
    QCOMPARE(bench.file(), QStringLiteral("physics.md"));
    bench.press("manualBack");
    QCOMPARE(bench.file(), QStringLiteral("index.md"));
    bench.press("manualForward");
    QCOMPARE(bench.file(), QStringLiteral("physics.md"));

    bench.manual->open(QStringLiteral("tour.md"));
    QCOMPARE(bench.page->verticalScrollBar()->value(), 0);
    bench.clickLink(QStringLiteral("command-line.md#scripts-of-moves"));
    QCOMPARE(bench.file(), QStringLiteral("command-line.md"));
    QVERIFY(bench.showsHeading(QStringLiteral("Scripts of moves")));
    bench.manual->open(QStringLiteral("tour.md#cut"));
    QVERIFY(bench.showsHeading(QStringLiteral("Cut")));
    QVERIFY(!bench.showsHeading(QStringLiteral("Tour")));

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
    // A line with a picture is as high as it.
    bench.manual->open(QStringLiteral("physics.md"));
    bool pictured = false;
    for (QTextBlock block = bench.page->document()->begin(); block.isValid(); block = block.next()) {
      if (block.text().contains(QChar::ObjectReplacementCharacter)) {
        QCOMPARE(block.blockFormat().lineHeightType(), int(QTextBlockFormat::SingleHeight));
        pictured = true;
        break;
      }
    }
    QVERIFY(pictured);
    // Tables have all their cells.
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
