#include "folders.h"

namespace chainmail {

std::filesystem::path source_file(const char* path) {
  return *path == '\0' ? SOURCE_FOLDER : std::filesystem::path(SOURCE_FOLDER) / path;
}

QString sourceFile(const char* path) { return QString::fromStdString(source_file(path).string()); }

QString builtFile(const char* path) { return QStringLiteral(BUILD_FOLDER "/") + QString::fromUtf8(path); }

}  // namespace chainmail
