#pragma once

#include <QByteArray>
#include <QString>

namespace chainmail {

/// Writes a picture that is complete in memory, as write_file does: completely or not at all. Empty bytes mean that
/// there was no memory for it. Throws Error.
void writeBytes(const QString& path, const QByteArray& bytes);

}  // namespace chainmail
