#include "tools/filling.h"

#include <Eigen/Geometry>
#include <QSignalBlocker>
#include <algorithm>
#include <cmath>

#include "document/edits.h"
#include "drawing/prepared_levels.h"
#include "elastic/limits.h"
#include "files/mesh/fill.h"

namespace chainmail {
namespace {

// Range of the edge length on a logarithmic slider: from 1/3 to 3 times the mean link length of the surface. Much
// shorter edges would take minutes.
constexpr double widest = 3;
constexpr int sliderSteps = 200;  // on either side of the middle

// Largest number of elements. More would take minutes, and would be too many for dragging.
constexpr double maxElements = 2e6;

// Share of the limit of linear FEM that the coarser edges aim at, because the number of elements is an estimate.
constexpr double aimedShare = 0.8;

/// Returns a number rounded to two significant digits.
double roughly(double number) {
  const double unit = std::pow(10, std::floor(std::log10(number)) - 1);
  return unit * std::round(number / unit);
}

double enclosedVolume(const Mesh& mesh) {
  double sum = 0;
  for (const auto& [a, b, c] : mesh.triangles) {
    const Point from = mesh.rest_position(a) - mesh.box[0];
    sum += from.dot((mesh.rest_position(b) - mesh.box[0]).cross(mesh.rest_position(c) - mesh.box[0])) / 6;
  }
  return std::abs(sum);
}

bool isSurfaceInSpace(const Mesh& mesh) { return mesh.object_dimension == 2 && mesh.space_dimension == 3; }

}  // namespace

Filling::Filling(Document& document, Jobs& jobs)
    : AskBar(QStringLiteral("fill"), QStringLiteral("&Fill"),
             QStringLiteral("Replaces the surface with a volume of tetrahedra, as one undo step")),
      document_(document),
      jobs_(jobs),
      size_(new QDoubleSpinBox),
      slider_(new QSlider(Qt::Horizontal)) {
  makeFields();
  connect(slider_, &QSlider::valueChanged, this, [this](int place) {
    size_->setValue(document_.mesh()->mean_link_length * std::pow(widest, double(place) / sliderSteps));
  });
  connect(size_, &QDoubleSpinBox::valueChanged, this, &Filling::describe);
  connect(this, &AskBar::agreed, this, &Filling::start);
  connect(&document_, &Document::meshChanged, this, &Filling::adapt);
}

void Filling::makeFields() {
  size_->setObjectName(QStringLiteral("fillSize"));
  size_->setAccessibleName(QStringLiteral("Edge length inside (mesh units)"));
  size_->setToolTip(QStringLiteral(
      "Approximate edge length of the tetrahedra, in mesh units; the edges of the surface stay the same"));
  slider_->setObjectName(QStringLiteral("fillSlider"));
  slider_->setAccessibleName(QStringLiteral("Edge length inside, slider"));
  slider_->setToolTip(QStringLiteral("From 1/3 to 3 times the mean link length of the surface"));
  slider_->setRange(-sliderSteps, sliderSteps);
  slider_->setMinimumWidth(60);
  addField(QStringLiteral("&Edges of"), size_);
  addField({}, slider_);
}

void Filling::fill(QMenu& menu) {
  action_ = menu.addAction(QStringLiteral("&Fill with tetrahedra…"), this, &Filling::askSize);
  action_->setObjectName(QStringLiteral("fillSurface"));
  adapt();
}

void Filling::adapt() {
  hide();
  const bool surface = isSurfaceInSpace(*document_.mesh());
  action_->setEnabled(surface);
  action_->setStatusTip(
      surface ? QStringLiteral("Makes a volume of this surface, which must be closed; asks for the edge length")
              : QStringLiteral("This object is not a surface in 3D: it cannot be filled"));
}

void Filling::askSize() {
  const Mesh& mesh = *document_.mesh();
  volume_ = enclosedVolume(mesh);
  const double mean = mesh.mean_link_length, offered = offeredSize();
  {
    const QSignalBlocker quiet(size_);
    size_->setDecimals(std::clamp(3 - int(std::floor(std::log10(mean))), 0, 9));
    size_->setRange(mean / widest, mean * widest);
    size_->setSingleStep(mean / 20);
    size_->setValue(offered);
  }
  describe();
  ask(QStringLiteral("Fill %1 with tetrahedra").arg(document_.name()) +
          (offered > mean ? QStringLiteral(". The edges offered are coarser than the surface: linear FEM takes at most "
                                           "%L1 elements")
                                .arg(max_fem_elements)
                          : QString()),
      size_);
}

/// Returns the mean link length of the surface, or longer edges if linear FEM could not take so many elements.
double Filling::offeredSize() const {
  const double mean = document_.mesh()->mean_link_length;
  const double inside = aimedShare * double(max_fem_elements) - double(document_.mesh()->element_count());
  if (elementsAt(mean) <= aimedShare * double(max_fem_elements) || inside <= 0) {
    return mean;
  }
  return std::min(widest * mean, std::cbrt(points_per_cube * volume_ / inside));
}

/// Returns the estimated number of elements for an edge length.
double Filling::elementsAt(double size) const {
  return double(document_.mesh()->element_count()) + points_per_cube * volume_ / (size * size * size);
}

void Filling::describe() {
  const double size = size_->value();
  const QSignalBlocker quiet(slider_);
  slider_->setValue(
      int(std::lround(sliderSteps * std::log(size / document_.mesh()->mean_link_length) / std::log(widest))));
  const double elements = elementsAt(size);
  showResult(QStringLiteral("about %L1 elements").arg(qlonglong(roughly(elements))) +
                 (elements > double(max_fem_elements)
                      ? QStringLiteral(", too many for linear FEM (at most %L1)").arg(max_fem_elements)
                      : QString()),
             elements < maxElements);
}

void Filling::start() {
  const QString name = document_.name();
  jobs_.start(
      Jobs::Kind::compute, QStringLiteral("Filling %1").arg(name),
      [this, name, surface = document_.mesh(), size = size_->value()](const Progress& progress) -> Jobs::Finish {
        const MeshPointer filled = chainmail::fill(*surface, size, progress.part(0, 0.9));
        prepareLevels(filled, progress.part(0.9, 1));
        return [this, name, filled] {
          edits::reworkMesh(document_, filled, name + QStringLiteral(", filled"), QStringLiteral("fill %1").arg(name));
        };
      });
}

}  // namespace chainmail
