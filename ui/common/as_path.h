#pragma once

#include <QByteArray>
#include <QString>
#include <filesystem>

namespace chainmail {

/// Converts a path of the interface for core, and back. A path of the system is bytes: one that is not UTF-8 is a lone
/// surrogate in the interface (U+DC80 to U+DCFF), as in Python, so that it comes back. Qt finds no file by such a path.
std::filesystem::path asPath(const QString& path);
QString pathOf(const QByteArray& bytes);

/// Returns the name of a file, or a path, as one line for people.
QString shownName(const QString& path);
QString shownPath(const QString& path);

/// Returns a path as a text that settings and JSON keep, and the path of such a text: of a path that is not UTF-8, this
/// is a URL.
QString keptPath(const QString& path);
QString pathOfKept(const QString& kept);

/// Writes a picture that is complete in memory, as write_file does: completely or not at all. Empty bytes mean that
/// there was no memory for it. Throws Error.
void writeBytes(const QString& path, const QByteArray& bytes);

}  // namespace chainmail
