#pragma once

#include <QString>
#include <filesystem>

namespace chainmail {

/// A path of the window, for core.
inline std::filesystem::path asPath(const QString& path) { return {path.toStdU16String()}; }

}  // namespace chainmail
