#pragma once

#include <QLabel>
#include <QLineEdit>
#include <QListWidget>
#include <QStringList>
#include <QTextBrowser>
#include <QWidget>

class QHBoxLayout;
class QToolButton;

namespace chainmail {

/// The manual in a separate window: the list of pages on the left, the chosen page on the right. The pages are the
/// Markdown files of resources/manual, which are compiled in.
class ManualWindow : public QWidget {
  Q_OBJECT

 public:
  explicit ManualWindow(QWidget* parent);

  /// Returns the file names of all pages, in the order of the list.
  static QStringList pages();
  /// Shows a page. If the name ends with an anchor, as in "tour.md#cut", scrolls to that heading.
  void open(const QString& page);

 private:
  QWidget* makePageArea();
  QHBoxLayout* makeBar();
  void fillList();
  void addKeys();
  void showCurrent(const QUrl& url);
  void search(const QString& words);
  void searchOn(QTextDocument::FindFlags direction);
  void resetZoom();

  QListWidget* list_;
  QTextBrowser* page_;
  QToolButton* back_;
  QToolButton* forward_;
  QLineEdit* search_;
  QLabel* answer_;  // result of the search
};

}  // namespace chainmail
