#include "io/mesh_filters.h"

namespace chainmail {
namespace {

QString asText(std::string_view text) { return QString::fromUtf8(text.data(), qsizetype(text.size())); }

QStringList endingsOf(const MeshFormat& format) { return asText(format.endings).split(QLatin1Char(' ')); }

}  // namespace

QStringList saveFilters(FormatUse use, bool lattice) {
  QStringList filters;
  for (const MeshFormat& format : mesh_formats()) {
    if (format.allows(use) && (format.holds_positions || lattice)) {
      filters << QStringLiteral("%1 (*%2)").arg(asText(format.name), endingsOf(format).first());
    }
  }
  return filters;
}

QString openFilter() {
  QString endings = QStringLiteral("*.chainmail");
  for (const MeshFormat& format : mesh_formats()) {
    if (format.reads()) {
      endings += QStringLiteral(" *") + endingsOf(format).join(QStringLiteral(" *"));
    }
  }
  return QStringLiteral("Sessions, meshes and pictures (%1 *.png *.jpg *.jpeg);;All files (*)").arg(endings);
}

}  // namespace chainmail
