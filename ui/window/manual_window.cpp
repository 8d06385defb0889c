#include "window/manual_window.h"

#include <QHBoxLayout>
#include <QImageReader>
#include <QResizeEvent>
#include <QScreen>
#include <QScrollBar>
#include <QShortcut>
#include <QTextBlock>
#include <QTextTable>
#include <QToolButton>
#include <QVBoxLayout>
#include <algorithm>
#include <array>

#include "common/colours.h"
#include "common/icons.h"

namespace chainmail {
namespace {

constexpr QSize preferredSize(1240, 720);
constexpr int searchWidth = 220;
constexpr int pageMargin = 18;
constexpr int cellPadding = 4;
constexpr int codeIndent = 12;
constexpr int codeSpace = 6;
constexpr int headingSpace = 14;
constexpr int tableSpace = 8;
constexpr int lineHeight = 125;  // percent

constexpr std::array files{"index.md",   "tour.md",   "algorithms.md",     "hard-cases.md", "speed.md",
                           "physics.md", "suite.md",  "command-line.md",   "formats.md",    "sessions.md",
                           "library.md", "python.md", "exact-chainmail.md"};

QUrl urlOf(const QString& page) { return QStringLiteral("qrc:/manual/") + page; }

/// Returns the anchor of a heading in the form that code hosts use: "Files from others" gives files-from-others.
QString anchorOf(const QString& heading) {
  QString anchor;
  for (const QChar one : heading.toLower()) {
    if (one.isLetterOrNumber() || one == QLatin1Char('-') || one == QLatin1Char('_')) {
      anchor += one;
    } else if (one.isSpace()) {
      anchor += QLatin1Char('-');
    }
  }
  return anchor;
}

/// A page of the manual. Headings are anchors, tables have grid lines, and pictures have the width of the page.
class Page : public QTextBrowser {
 public:
  Page() {
    setOpenExternalLinks(true);
    setVerticalScrollBarPolicy(Qt::ScrollBarAlwaysOn);  // so that the width does not depend on the page
    document()->setDocumentMargin(pageMargin);
  }

  /// Loads the page again at the same position, after a change of its width or colours.
  void renew() {
    const int position = verticalScrollBar()->value();
    reload();
    verticalScrollBar()->setValue(position);
  }

 protected:
  void doSetSource(const QUrl& url, QTextDocument::ResourceType type) override {
    // Else Qt lays the page out after each piece of Markdown, which takes seconds.
    document()->setLayoutEnabled(false);
    QTextBrowser::doSetSource(url, type);
    format();
    document()->setLayoutEnabled(true);
    if (!url.fragment().isEmpty()) {
      scrollToAnchor(url.fragment());
    }
  }

  QVariant loadResource(int type, const QUrl& name) override {
    const QUrl url = source().resolved(name);
    if (type != QTextDocument::ImageResource || url.scheme() != QLatin1String("qrc")) {
      return QTextBrowser::loadResource(type, name);
    }
    QImageReader reader(QLatin1Char(':') + url.path());
    const int room = viewport()->width() - 2 * pageMargin;
    if (reader.size().width() > room) {
      reader.setScaledSize(reader.size().scaled(room, reader.size().height(), Qt::KeepAspectRatio));
    }
    pictures_ = true;
    return reader.read();
  }

  void resizeEvent(QResizeEvent* event) override {
    QTextBrowser::resizeEvent(event);
    if (pictures_ && event->size().width() != event->oldSize().width()) {
      renew();
    }
  }

 private:
  void format() {
    QTextCursor edit(document());
    edit.beginEditBlock();  // Qt lays the page out once, and not after each change
    for (QTextBlock block = document()->begin(); block.isValid(); block = block.next()) {
      if (block.blockFormat().headingLevel() > 0) {
        makeAnchor(block);
      } else if (isCode(block)) {
        markCode(block);
      } else if (QTextCursor(block).currentTable() == nullptr && !hasPicture(block)) {
        QTextBlockFormat format;
        format.setLineHeight(lineHeight, QTextBlockFormat::ProportionalHeight);
        QTextCursor(block).mergeBlockFormat(format);
      }
    }
    for (QTextFrame* frame : document()->rootFrame()->childFrames()) {
      if (auto* table = qobject_cast<QTextTable*>(frame)) {
        splitCells(*table);
        formatTable(*table);
      }
    }
    edit.endEditBlock();
  }

  static bool isCode(const QTextBlock& block) {
    return block.isValid() && block.blockFormat().hasProperty(QTextFormat::BlockCodeLanguage);
  }

  /// True if a line contains a picture. Such a line is as high as the picture.
  static bool hasPicture(const QTextBlock& block) { return block.text().contains(QChar::ObjectReplacementCharacter); }

  static void makeAnchor(const QTextBlock& block) {
    QTextCursor cursor(block);
    cursor.movePosition(QTextCursor::EndOfBlock, QTextCursor::KeepAnchor);
    QTextCharFormat anchor;
    anchor.setAnchor(true);
    anchor.setAnchorNames({anchorOf(block.text())});
    cursor.mergeCharFormat(anchor);
    QTextBlockFormat space;
    space.setTopMargin(headingSpace);
    cursor.mergeBlockFormat(space);
  }

  /// Gives a line of code its background and margins. Each line is a separate block.
  void markCode(const QTextBlock& line) {
    QTextBlockFormat format;
    format.setBackground(palette().alternateBase());
    format.setLeftMargin(codeIndent);
    format.setTopMargin(isCode(line.previous()) ? 0 : codeSpace);
    format.setBottomMargin(isCode(line.next()) ? 0 : codeSpace);
    QTextCursor(line).mergeBlockFormat(format);
  }

  /// Splits merged cells: Qt's Markdown reader merges empty cells at the end of a row with the cell before them.
  static void splitCells(QTextTable& table) {
    for (int row = 0; row < table.rows(); ++row) {
      for (int column = 0; column < table.columns(); ++column) {
        if (table.cellAt(row, column).columnSpan() > 1) {
          table.splitCell(row, column, 1, 1);
        }
      }
    }
  }

  void formatTable(QTextTable& table) {
    QTextTableFormat format = table.format();
    format.setBorder(1);
    format.setBorderCollapse(true);
    format.setBorderStyle(QTextFrameFormat::BorderStyle_Solid);
    format.setBorderBrush(palette().mid());
    format.setCellPadding(cellPadding);
    format.setCellSpacing(0);
    format.setTopMargin(tableSpace);
    format.setBottomMargin(tableSpace);
    table.setFormat(format);
    QTextCharFormat head;
    head.setBackground(palette().alternateBase());
    for (int column = 0; column < table.columns(); ++column) {
      QTextTableCell cell = table.cellAt(0, column);
      QTextCharFormat merged = cell.format();
      merged.merge(head);
      cell.setFormat(merged);
    }
  }

  bool pictures_ = false;  // true after a page with pictures was shown
};

QToolButton* makeButton(const char* name, const char* picture, const QString& tip) {
  auto* button = new QToolButton;
  button->setObjectName(QLatin1String(name));
  button->setIcon(icon(picture));
  button->setAutoRaise(true);
  button->setToolTip(tip);
  button->setAccessibleName(tip);
  return button;
}

}  // namespace

ManualWindow::ManualWindow(QWidget* parent) : QWidget(parent, Qt::Window), page_(new Page), search_(new QLineEdit) {
  setObjectName(QStringLiteral("manualWindow"));
  setWindowTitle(QStringLiteral("ChainMail manual"));
  resize(preferredSize.boundedTo(screen()->availableSize() - QSize(20, 60)));
  page_->setObjectName(QStringLiteral("manualPage"));
  page_->setAccessibleName(QStringLiteral("Page of the manual"));
  auto* column = new QVBoxLayout(this);
  column->setContentsMargins(0, 0, 0, 0);
  column->addLayout(makeBar());
  column->addWidget(page_, 1);
  addKeys();
  open(pages().front());
  followTheme(*this, [this] { static_cast<Page*>(page_)->renew(); });
}

QStringList ManualWindow::pages() {
  QStringList all;
  std::ranges::transform(files, std::back_inserter(all), [](const char* file) { return QString::fromLatin1(file); });
  return all;
}

void ManualWindow::open(const QString& page) { page_->setSource(urlOf(page)); }

QHBoxLayout* ManualWindow::makeBar() {
  auto* first = makeButton("manualFirst", "help", QStringLiteral("Contents (Alt+Home)"));
  auto* back = makeButton("manualBack", "left", QStringLiteral("Previous page (Alt+Left)"));
  auto* forward = makeButton("manualForward", "right", QStringLiteral("Next page (Alt+Right)"));
  search_->setObjectName(QStringLiteral("manualSearch"));
  search_->setPlaceholderText(QStringLiteral("Find in this page"));
  search_->setAccessibleName(search_->placeholderText());
  search_->setToolTip(QStringLiteral("Finds words in this page (Ctrl+F). Enter or F3 goes on, Shift+F3 goes back"));
  search_->setClearButtonEnabled(true);
  search_->addAction(icon("search"), QLineEdit::LeadingPosition);
  search_->setFixedWidth(searchWidth);
  auto* bar = new QHBoxLayout;
  bar->setContentsMargins(4, 4, 4, 0);
  bar->addWidget(first);
  bar->addWidget(back);
  bar->addWidget(forward);
  bar->addStretch(1);
  bar->addWidget(search_);
  connect(first, &QToolButton::clicked, page_, [this] { open(pages().front()); });
  connect(back, &QToolButton::clicked, page_, &QTextBrowser::backward);
  connect(forward, &QToolButton::clicked, page_, &QTextBrowser::forward);
  connect(page_, &QTextBrowser::backwardAvailable, back, &QWidget::setEnabled);
  connect(page_, &QTextBrowser::forwardAvailable, forward, &QWidget::setEnabled);
  back->setEnabled(false);
  forward->setEnabled(false);
  connect(search_, &QLineEdit::returnPressed, this, [this] { find({}); });
  return bar;
}

void ManualWindow::addKeys() {
  const auto add = [this](const QKeySequence& keys, auto action) {
    connect(new QShortcut(keys, this), &QShortcut::activated, this, action);
  };
  add(QKeySequence::Find, [this] {
    search_->setFocus(Qt::ShortcutFocusReason);
    search_->selectAll();
  });
  add(QKeySequence::FindNext, [this] { find({}); });
  add(QKeySequence::FindPrevious, [this] { find(QTextDocument::FindBackward); });
  add(QKeySequence::ZoomIn, [this] { page_->zoomIn(); });
  add(QKeySequence::ZoomOut, [this] { page_->zoomOut(); });
}

/// Selects the next match; after the last one, the first one. Red words are not in the page.
void ManualWindow::find(QTextDocument::FindFlags flags) {
  bool found = page_->find(search_->text(), flags);
  if (!found) {
    const QTextCursor before = page_->textCursor();
    page_->moveCursor(flags.testFlag(QTextDocument::FindBackward) ? QTextCursor::End : QTextCursor::Start);
    found = page_->find(search_->text(), flags);
    if (!found) {
      page_->setTextCursor(before);
    }
  }
  QPalette palette;
  if (!found && !search_->text().isEmpty()) {
    palette.setColor(QPalette::Text, colours::errorSign);
  }
  search_->setPalette(palette);
}

}  // namespace chainmail
