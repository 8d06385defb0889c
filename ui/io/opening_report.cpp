#include "io/opening_report.h"

#include <QLocale>
#include <QStringList>

#include "common/text.h"

namespace chainmail {

QString openingReport(const QString& name, const OpenedMesh& opened, std::size_t parts) {
  const Mesh& mesh = *opened.mesh;
  QStringList counts{counted(mesh.element_count(), QStringLiteral("element")),
                     counted(mesh.link_count(), QStringLiteral("link"))};
  if (!mesh.triangles.empty()) {
    counts << counted(mesh.triangles.size(), QStringLiteral("triangle"));
  }
  if (!mesh.tetrahedra.empty()) {
    counts << QStringLiteral("%L1 tetrahedra").arg(mesh.tetrahedra.size());
  }
  if (!mesh.hexahedra.empty()) {
    counts << QStringLiteral("%L1 hexahedra").arg(mesh.hexahedra.size());
  }
  counts << counted(parts, QStringLiteral("part"));
  QStringList extents;
  for (int k = 0; k < mesh.space_dimension; ++k) {
    extents << QLocale().toString((mesh.box[1] - mesh.box[0])[mesh.axes[k]], 'g', 4);
  }
  QString report = QStringLiteral("%1: %2, %3 units")
                       .arg(name, counts.join(QStringLiteral(", ")), extents.join(QStringLiteral(" × ")));
  if (const std::string flaws = in_words(opened.flaws); !flaws.empty()) {
    report += QStringLiteral(". ") + text(flaws);
  }
  return report;
}

}  // namespace chainmail
