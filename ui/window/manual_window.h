#pragma once

#include <QLineEdit>
#include <QStringList>
#include <QTextBrowser>
#include <QWidget>

class QHBoxLayout;

namespace chainmail {

/// The manual in a separate window: a browser of its pages, the Markdown files of resources/manual, which are compiled
/// in. The first page lists the others.
class ManualWindow : public QWidget {
  Q_OBJECT

 public:
  explicit ManualWindow(QWidget* parent);

  /// Returns the file names of all pages.
  static QStringList pages();
  /// Shows a page. If the name ends with an anchor, as in "tour.md#cut", scrolls to that heading.
  void open(const QString& page);

 private:
  QHBoxLayout* makeBar();
  void addKeys();
  void find(QTextDocument::FindFlags flags);

  QTextBrowser* page_;
  QLineEdit* search_;
};

}  // namespace chainmail
