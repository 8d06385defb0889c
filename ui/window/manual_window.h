#pragma once

#include <QLabel>
#include <QLineEdit>
#include <QListWidget>
#include <QStringList>
#include <QTextBrowser>
#include <QWidget>
#include <memory>
#include <optional>
#include <vector>

#include "window/manual_index.h"

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
  QWidget* makeLists();
  void search(const QString& words);
  void showResults();
  std::size_t firstFromHere() const;
  void goTo(std::size_t match);
  void goOn(int step);
  void resetZoom();

  QListWidget* list_;
  QTextBrowser* page_;
  QToolButton* back_;
  QToolButton* forward_;
  QLineEdit* search_;
  QLabel* answer_;        // result of the search
  QListWidget* results_;  // hidden while nothing is searched
  QToolButton* previous_;
  QToolButton* next_;
  std::unique_ptr<ManualIndex> index_;  // made on the first search
  std::vector<ManualMatch> matches_;
  std::optional<std::size_t> current_;  // index of the match that is shown
  bool goesToMatch_ = false;            // true while the search opens a page
};

}  // namespace chainmail
