#include "window/manual_index.h"

#include <QFile>
#include <QTextDocument>
#include <algorithm>

namespace chainmail {
namespace {

constexpr qsizetype contextBefore = 30, contextAfter = 60;  // characters around a match

QString aroundMatch(const QString& line, qsizetype at, qsizetype length) {
  const qsizetype from = std::max(qsizetype{0}, at - contextBefore),
                  to = std::min(line.size(), at + length + contextAfter);
  return (from > 0 ? QStringLiteral("…") : QString()) + line.mid(from, to - from).simplified() +
         (to < line.size() ? QStringLiteral("…") : QString());
}

}  // namespace

ManualIndex::ManualIndex(const QStringList& pages) {
  for (const QString& name : pages) {
    QFile file(QStringLiteral(":/manual/") + name);
    if (file.open(QIODevice::ReadOnly)) {
      QTextDocument document;
      document.setMarkdown(QString::fromUtf8(file.readAll()));
      pages_.push_back({name, document.toPlainText().split(QLatin1Char('\n'))});
    }
  }
}

std::vector<ManualMatch> ManualIndex::find(const QString& words, std::size_t most) const {
  std::vector<ManualMatch> found;
  for (const Page& page : pages_) {
    int nth = 0;
    for (const QString& line : page.lines) {
      for (qsizetype at = line.indexOf(words, 0, Qt::CaseInsensitive); at >= 0 && found.size() < most;
           at = line.indexOf(words, at + words.size(), Qt::CaseInsensitive)) {
        found.push_back({page.name, nth++, aroundMatch(line, at, words.size())});
      }
    }
  }
  return found;
}

}  // namespace chainmail
