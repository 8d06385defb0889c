#pragma once

#include <QString>
#include <algorithm>
#include <array>

namespace chainmail {

/// True if objects in files of this format usually stand on the xy plane: parts for printing, and scans of patients.
/// Otherwise the y axis usually points up, as in graphics.
inline bool usuallyZUp(const QString& fileName) {
  constexpr std::array endings{".stl", ".nrrd", ".nhdr", ".mha", ".mhd"};
  return std::ranges::any_of(
      endings, [&](const char* ending) { return fileName.endsWith(QLatin1String(ending), Qt::CaseInsensitive); });
}

}  // namespace chainmail
