#include "common/as_path.h"

#include <QFileInfo>

#include "common/text.h"
#include "files/text/outputs.h"
#include "files/text/text.h"

namespace chainmail {
namespace {

constexpr char16_t firstByte = 0xDC00;
constexpr int longestCharacter = 4;  // bytes of UTF-8
constexpr QLatin1String scheme("file://");

/// Returns the length of the character of UTF-8 with which bytes begin; 0 if there is none.
qsizetype characterLength(QByteArrayView bytes) {
  for (qsizetype length = 1; length <= std::min<qsizetype>(longestCharacter, bytes.size()); ++length) {
    if (bytes.first(length).isValidUtf8()) {
      return length;
    }
  }
  return 0;
}

}  // namespace

std::filesystem::path asPath(const QString& path) {
  std::string bytes;
  qsizetype from = 0;
  for (qsizetype i = 0; i < path.size(); ++i) {
    const bool isAlone = path[i].isLowSurrogate() && (i == 0 || !path[i - 1].isHighSurrogate());
    if (isAlone) {
      bytes += path.sliced(from, i - from).toStdString() + char(path[i].unicode() - firstByte);
      from = i + 1;
    }
  }
  return bytes + path.sliced(from).toStdString();
}

QString pathOf(const QByteArray& bytes) {
  QString path;
  for (qsizetype i = 0; i < bytes.size();) {
    const qsizetype length = characterLength(QByteArrayView(bytes).sliced(i));
    path += length > 0 ? QString::fromUtf8(bytes.sliced(i, length)) : QString(QChar(firstByte + uchar(bytes[i])));
    i += std::max<qsizetype>(length, 1);
  }
  return path;
}

QString shownName(const QString& path) { return shownPath(QFileInfo(path).fileName()); }

QString shownPath(const QString& path) { return text(printable(asPath(path).string())); }

QString keptPath(const QString& path) {
  const QByteArray bytes = QByteArray::fromStdString(asPath(path).string());
  return bytes.isValidUtf8() ? path : scheme + QString::fromLatin1(bytes.toPercentEncoding("/"));
}

QString pathOfKept(const QString& kept) {
  return kept.startsWith(scheme) ? pathOf(QByteArray::fromPercentEncoding(kept.sliced(scheme.size()).toLatin1()))
                                 : kept;
}

void writeBytes(const QString& path, const QByteArray& bytes) {
  if (bytes.isEmpty()) {
    throw Error(path.toStdString(), "there is not enough memory for the picture", "choose a smaller scale");
  }
  write_file(asPath(path), [&](std::ostream& out) { out.write(bytes.constData(), bytes.size()); });
}

}  // namespace chainmail
