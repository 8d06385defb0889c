#include "tools/simplifying.h"

#include <QLocale>
#include <QSignalBlocker>
#include <cmath>

#include "common/text.h"
#include "document/edits.h"
#include "drawing/prepared_levels.h"
#include "files/repair/simplify.h"
#include "mesh/error.h"

namespace chainmail {
namespace {

constexpr int fewest = int(fewest_simplified);
constexpr int offeredShare = 4;  // a quarter of the elements: edges become twice as long

bool isSurface(const Mesh& mesh) {
  return !mesh.triangles.empty() && !mesh.has_cells() && int(mesh.element_count()) > fewest;
}

}  // namespace

Simplifying::Simplifying(Document& document, Jobs& jobs)
    : AskBar(QStringLiteral("simplify"), QStringLiteral("&Simplify"),
             QStringLiteral("Replaces the surface with a coarser one, as one undo step. The object is then at rest, "
                            "without cuts, pins and softness of single links")),
      document_(document),
      jobs_(jobs),
      elements_(new QSpinBox) {
  makeFields();
  connect(elements_, &QSpinBox::valueChanged, this, &Simplifying::describe);
  connect(this, &AskBar::agreed, this, &Simplifying::start);
  connect(&document_, &Document::meshChanged, this, &Simplifying::adapt);
}

void Simplifying::makeFields() {
  elements_->setObjectName(QStringLiteral("simplifyElements"));
  elements_->setAccessibleName(QStringLiteral("Number of elements of the coarser surface"));
  elements_->setToolTip(
      QStringLiteral("Number of elements that are left. Those at the border of an open surface stay where they are"));
  elements_->setGroupSeparatorShown(true);
  addField(QStringLiteral("&Elements"), elements_);
}

void Simplifying::fill(QMenu& menu) {
  action_ = menu.addAction(QStringLiteral("&Simplify…"), this, [this] {
    fillsNext_ = false;
    ask(int(document_.mesh()->element_count()) / offeredShare);
  });
  action_->setObjectName(QStringLiteral("simplifySurface"));
  adapt();
}

void Simplifying::askBeforeFilling(int elements) {
  fillsNext_ = true;
  ask(elements);
}

void Simplifying::adapt() {
  hide();
  const bool possible = isSurface(*document_.mesh());
  action_->setEnabled(possible);
  action_->setStatusTip(possible ? QStringLiteral("Gives this surface fewer elements; asks how many")
                                 : QStringLiteral("This object is not a surface of faces: it cannot be simplified"));
}

void Simplifying::ask(int offered) {
  const int count = int(document_.mesh()->element_count());
  {
    const QSignalBlocker quiet(elements_);
    elements_->setRange(fewest, count - 1);
    elements_->setSingleStep(std::max(1, count / 100));
    elements_->setValue(offered);
  }
  describe();
  AskBar::ask(QStringLiteral("Simplify %1: %2").arg(document_.name(), counted(count, QStringLiteral("element"))) +
                  (fillsNext_ ? QStringLiteral(". The number offered suits filling for linear FEM; the bar for filling "
                                               "opens again afterwards")
                              : QString()),
              elements_);
  elements_->selectAll();
}

/// The length of edges grows with the root of the area that each element stands for.
void Simplifying::describe() {
  const Mesh& mesh = *document_.mesh();
  const double length = mesh.mean_link_length * std::sqrt(double(mesh.element_count()) / elements_->value());
  showResult(QStringLiteral("edges of about %1 instead of %2")
                 .arg(QLocale().toString(length, 'g', 3), QLocale().toString(mesh.mean_link_length, 'g', 3)));
}

void Simplifying::start() {
  const QString name = document_.name();
  jobs_.start(
      Jobs::Kind::compute, QStringLiteral("Simplifying %1").arg(name),
      [this, name, surface = document_.mesh(), elements = std::uint64_t(elements_->value()),
       fillsNext = fillsNext_](const Progress& progress) -> Jobs::Finish {
        try {
          const MeshPointer coarse = simplify(*surface, elements, progress.part(0, 0.9));
          prepareLevels(coarse, progress.part(0.9, 1));
          return [this, name, surface, coarse, fillsNext] {
            if (document_.mesh() != surface) {
              emit document_.refused(
                  QStringLiteral("%1: the object was changed while it was simplified. Simplify it again").arg(name));
              return;
            }
            edits::reworkMesh(
                document_, coarse, name,
                QStringLiteral("simplify to %1").arg(counted(coarse->element_count(), QStringLiteral("element"))));
            if (fillsNext) {
              emit readyToFill();
            }
          };
        } catch (const Error& error) {
          throw error.where() == "surface" ? error.at(name.toStdString()) : error;
        }
      });
}

}  // namespace chainmail
