#pragma once

#include <QString>
#include <QStringList>
#include <vector>

namespace chainmail {

/// A place in the manual where words were found.
struct ManualMatch {
  QString page;     // file name
  int nth = 0;      // how many matches the page has before it
  QString context;  // the words with some text around them, in one line
};

/// The texts of all pages of the manual as a reader sees them, without the signs of Markdown.
class ManualIndex {
 public:
  explicit ManualIndex(const QStringList& pages);

  /// Finds words in all pages, in the order of the pages, without regard to case; at most `most` matches.
  std::vector<ManualMatch> find(const QString& words, std::size_t most) const;

 private:
  struct Page {
    QString name;
    QStringList lines;
  };
  std::vector<Page> pages_;
};

}  // namespace chainmail
