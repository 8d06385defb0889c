#pragma once

#include <QString>
#include <filesystem>

namespace chainmail {

/// Converts a path of the interface for core.
inline std::filesystem::path asPath(const QString& path) { return {path.toStdU16String()}; }

}  // namespace chainmail
