#include "window/manual_window.h"

#include <QFile>
#include <QHBoxLayout>
#include <QImageReader>
#include <QResizeEvent>
#include <QScrollBar>
#include <QShortcut>
#include <QSplitter>
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

constexpr QSize preferredSize(1100, 720);
constexpr int listWidth = 170;
constexpr int resultsHeight = 300;
constexpr int searchWidth = 220;
constexpr std::size_t mostMatches = 500;
constexpr int pageMargin = 18;
constexpr int cellPadding = 4;
constexpr int codeIndent = 12;
constexpr int codeSpace = 6;
constexpr int headingSpace = 14;
constexpr int tableSpace = 8;
constexpr int lineHeight = 125;  // percent
constexpr int rowSpacing = 3;    // of the list

constexpr std::array files{"index.md",   "tour.md",   "algorithms.md",     "hard-cases.md", "speed.md",
                           "physics.md", "suite.md",  "command-line.md",   "formats.md",    "sessions.md",
                           "library.md", "python.md", "exact-chainmail.md"};

QUrl urlOf(const QString& page) { return QStringLiteral("qrc:/manual/") + page; }

/// Returns the first heading of a page.
QString titleOf(const QString& page) {
  QFile file(QStringLiteral(":/manual/") + page);
  return file.open(QIODevice::ReadOnly) ? QString::fromUtf8(file.readLine()).mid(2).trimmed() : page;
}

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
    QTextBrowser::doSetSource(url, type);
    format();
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

ManualWindow::ManualWindow(QWidget* parent)
    : QWidget(parent, Qt::Window),
      list_(new QListWidget),
      page_(new Page),
      back_(makeButton("manualBack", "left", QStringLiteral("Previous page (Alt+Left)"))),
      forward_(makeButton("manualForward", "right", QStringLiteral("Next page (Alt+Right)"))),
      search_(new QLineEdit),
      answer_(new QLabel),
      results_(new QListWidget),
      previous_(makeButton("manualPrevious", "up", QStringLiteral("Previous match (Shift+F3)"))),
      next_(makeButton("manualNext", "down", QStringLiteral("Next match (F3)"))) {
  setObjectName(QStringLiteral("manualWindow"));
  setWindowTitle(QStringLiteral("ChainMail manual"));
  resize(preferredSize);
  list_->setObjectName(QStringLiteral("manualPages"));
  list_->setAccessibleName(QStringLiteral("Pages of the manual"));
  auto* split = new QSplitter;
  split->addWidget(makeLists());
  split->addWidget(makePageArea());
  split->setSizes({listWidth, preferredSize.width() - listWidth});
  split->setStretchFactor(1, 1);
  split->setChildrenCollapsible(false);
  auto* all = new QHBoxLayout(this);
  all->setContentsMargins(0, 0, 0, 0);
  all->addWidget(split);
  fillList();
  addKeys();
  connect(page_, &QTextBrowser::sourceChanged, this, &ManualWindow::showCurrent);
  open(pages().front());
  followTheme(*this, [this] { static_cast<Page*>(page_)->renew(); });
}

QStringList ManualWindow::pages() {
  QStringList all;
  std::ranges::transform(files, std::back_inserter(all), [](const char* file) { return QString::fromLatin1(file); });
  return all;
}

void ManualWindow::open(const QString& page) { page_->setSource(urlOf(page)); }

/// Puts the matches of a search below the pages.
QWidget* ManualWindow::makeLists() {
  results_->setObjectName(QStringLiteral("manualResults"));
  results_->setAccessibleName(QStringLiteral("Matches in the manual"));
  results_->setWordWrap(true);
  results_->setHorizontalScrollBarPolicy(Qt::ScrollBarAlwaysOff);
  results_->hide();
  connect(results_, &QListWidget::currentRowChanged, this, [this](int row) {
    if (row >= 0) {
      goTo(std::size_t(row));
    }
  });
  auto* lists = new QSplitter(Qt::Vertical);
  lists->addWidget(list_);
  lists->addWidget(results_);
  lists->setSizes({preferredSize.height() - resultsHeight, resultsHeight});
  lists->setChildrenCollapsible(false);
  return lists;
}

QWidget* ManualWindow::makePageArea() {
  auto* area = new QWidget;
  auto* column = new QVBoxLayout(area);
  column->setContentsMargins(0, 0, 0, 0);
  column->addLayout(makeBar());
  column->addWidget(page_, 1);
  page_->setObjectName(QStringLiteral("manualPage"));
  page_->setAccessibleName(QStringLiteral("Page of the manual"));
  return area;
}

QHBoxLayout* ManualWindow::makeBar() {
  search_->setObjectName(QStringLiteral("manualSearch"));
  search_->setPlaceholderText(QStringLiteral("Search the manual"));
  search_->setAccessibleName(search_->placeholderText());
  search_->setToolTip(
      QStringLiteral("Searches all pages (Ctrl+F); Enter shows the next match, Shift+Enter the previous one"));
  search_->setClearButtonEnabled(true);
  search_->addAction(icon("search"), QLineEdit::LeadingPosition);
  search_->setFixedWidth(searchWidth);
  answer_->setObjectName(QStringLiteral("manualAnswer"));
  auto* bar = new QHBoxLayout;
  bar->setContentsMargins(4, 4, 4, 0);
  bar->addWidget(back_);
  bar->addWidget(forward_);
  bar->addStretch(1);
  bar->addWidget(answer_);
  bar->addWidget(search_);
  bar->addWidget(previous_);
  bar->addWidget(next_);
  connect(previous_, &QToolButton::clicked, this, [this] { goOn(-1); });
  connect(next_, &QToolButton::clicked, this, [this] { goOn(1); });
  connect(back_, &QToolButton::clicked, page_, &QTextBrowser::backward);
  connect(forward_, &QToolButton::clicked, page_, &QTextBrowser::forward);
  connect(page_, &QTextBrowser::backwardAvailable, back_, &QWidget::setEnabled);
  connect(page_, &QTextBrowser::forwardAvailable, forward_, &QWidget::setEnabled);
  connect(search_, &QLineEdit::textChanged, this, &ManualWindow::search);
  back_->setEnabled(false);
  forward_->setEnabled(false);
  showResults();
  return bar;
}

void ManualWindow::fillList() {
  list_->setSpacing(rowSpacing);
  for (const QString& page : pages()) {
    list_->addItem(titleOf(page));
    list_->item(list_->count() - 1)->setData(Qt::UserRole, page);
  }
  connect(list_, &QListWidget::currentItemChanged, this,
          [this](const QListWidgetItem* item) { open(item->data(Qt::UserRole).toString()); });
}

void ManualWindow::addKeys() {
  const auto add = [this](const QKeySequence& keys, QWidget* where, auto action) {
    auto* key = new QShortcut(keys, where);
    key->setContext(where == this ? Qt::WindowShortcut : Qt::WidgetShortcut);
    connect(key, &QShortcut::activated, this, action);
  };
  add(QKeySequence::Find, this, [this] {
    search_->setFocus(Qt::ShortcutFocusReason);
    search_->selectAll();
  });
  add(QKeySequence::Back, this, [this] { page_->backward(); });
  add(QKeySequence::Forward, this, [this] { page_->forward(); });
  add(QKeySequence::ZoomIn, this, [this] { page_->zoomIn(); });
  add(QKeySequence::ZoomOut, this, [this] { page_->zoomOut(); });
  add(Qt::CTRL | Qt::Key_0, this, [this] { resetZoom(); });
  for (const auto enter : {Qt::Key_Return, Qt::Key_Enter}) {
    add(enter, search_, [this] { goOn(1); });
    add(Qt::SHIFT | enter, search_, [this] { goOn(-1); });
  }
  add(QKeySequence::FindNext, this, [this] { goOn(1); });
  add(QKeySequence::FindPrevious, this, [this] { goOn(-1); });
  add(Qt::Key_Escape, search_, [this] { page_->setFocus(); });
}

/// Selects the current page in the list, also if it was opened by a link.
void ManualWindow::showCurrent(const QUrl& url) {
  const QSignalBlocker block(list_);
  list_->setCurrentRow(int(pages().indexOf(url.fileName())));
  if (!goesToMatch_) {
    search_->clear();
  }
}

/// Searches while the user types, and shows the first match from the present position on.
void ManualWindow::search(const QString& words) {
  if (index_ == nullptr) {
    index_ = std::make_unique<ManualIndex>(pages());
  }
  matches_ = words.isEmpty() ? std::vector<ManualMatch>() : index_->find(words, mostMatches);
  current_.reset();
  showResults();
  if (!matches_.empty()) {
    goTo(firstFromHere());
  } else if (!words.isEmpty()) {
    answer_->setText(QStringLiteral("Not found in the manual"));
  }
}

/// Lists the matches, each with its page.
void ManualWindow::showResults() {
  const QSignalBlocker block(results_);
  results_->clear();
  for (const ManualMatch& match : matches_) {
    results_->addItem(QStringLiteral("%1: %2").arg(titleOf(match.page), match.context));
  }
  results_->setVisible(!matches_.empty());
  previous_->setEnabled(!matches_.empty());
  next_->setEnabled(!matches_.empty());
  answer_->clear();
}

/// Returns the first match that is on the present page and not before the cursor, or on a later page; else the first
/// one of all.
std::size_t ManualWindow::firstFromHere() const {
  const int here = int(pages().indexOf(page_->source().fileName()));
  int before = 0;  // matches on this page that end before the cursor
  const int cursor = page_->textCursor().selectionStart();
  QTextCursor at = page_->document()->find(search_->text(), 0);
  for (; !at.isNull() && at.selectionStart() < cursor; at = page_->document()->find(search_->text(), at)) {
    ++before;
  }
  const auto found = std::ranges::find_if(matches_, [&](const ManualMatch& one) {
    const int page = int(pages().indexOf(one.page));
    return page > here || (page == here && one.nth >= before);
  });
  return found == matches_.end() ? 0 : std::size_t(found - matches_.begin());
}

void ManualWindow::goTo(std::size_t match) {
  current_ = match;
  const ManualMatch& one = matches_[match];
  if (page_->source().fileName() != one.page) {
    goesToMatch_ = true;
    open(one.page);
    goesToMatch_ = false;
  }
  QTextCursor at = page_->document()->find(search_->text(), 0);
  for (int i = 0; i < one.nth && !at.isNull(); ++i) {
    at = page_->document()->find(search_->text(), at);
  }
  if (!at.isNull()) {
    page_->setTextCursor(at);
    page_->ensureCursorVisible();
  }
  const QSignalBlocker block(results_);
  results_->setCurrentRow(int(match));
  answer_->setText(QStringLiteral("%L1 of %2%L3")
                       .arg(match + 1)
                       .arg(matches_.size() == mostMatches ? QStringLiteral("more than ") : QString())
                       .arg(matches_.size()));
}

/// Shows the next match (1) or the previous one (-1). After the last match of the manual, continues with the first one.
void ManualWindow::goOn(int step) {
  if (!matches_.empty()) {
    const std::size_t count = matches_.size();
    goTo((current_.value_or(0) + count + std::size_t(step + int(count))) % count);
  }
}

void ManualWindow::resetZoom() { page_->setFont(font()); }

}  // namespace chainmail
