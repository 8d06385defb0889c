#include "tools/filling.h"

#include <Eigen/Geometry>
#include <QSignalBlocker>
#include <algorithm>
#include <cmath>
#include <map>

#include "common/actions.h"
#include "common/number_field.h"
#include "common/text.h"
#include "document/edits.h"
#include "drawing/mesh_levels.h"
#include "files/mesh/fill.h"
#include "files/repair/simplify.h"
#include "solver/algorithms.h"

namespace chainmail {
namespace {

// Range of the edge length on a logarithmic slider: from 1/3 to 3 times the mean link length of the surface. Much
// shorter edges would take minutes.
constexpr double widest = 3;
constexpr int sliderSteps = 200;  // on either side of the middle

// Largest number of elements. More would take minutes, and would be too many for dragging.
constexpr double maxElements = 2e6;

// Share of the limit of linear FEM that is offered, because the number of elements is an estimate.
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

/// Largest number of elements of a solid that linear FEM takes.
double femLimit() { return double(max_solid_elements(Algorithm::linear_fem).value_or(element_limit)); }

/// Returns 'BEM (5,000), ARAP, XPBD (100,000)': the methods whose limits are (not) below a number of elements.
QString methodsWithLimits(double elements, bool exceeded) {
  std::map<std::uint64_t, QStringList> byLimit;
  for (const AlgorithmInfo& one : elastic_algorithms()) {
    const auto most = max_solid_elements(one.algorithm);
    if (most && (elements > double(*most)) == exceeded) {
      byLimit[*most] << text(one.label);
    }
  }
  QStringList all;
  for (const auto& [most, names] : byLimit) {
    all << QStringLiteral("%1 (%L2)").arg(names.join(QStringLiteral(", "))).arg(most);
  }
  return all.join(QStringLiteral(", "));
}

bool isSurfaceInSpace(const Mesh& mesh) { return mesh.object_dimension == 2 && mesh.space_dimension == 3; }

}  // namespace

Filling::Filling(Document& document, Jobs& jobs)
    : AskBar(QStringLiteral("fill"), QStringLiteral("&Fill"),
             QStringLiteral("Replaces the surface with a volume of tetrahedra, as one undo step")),
      document_(document),
      jobs_(jobs),
      size_(new NumberField(QStringLiteral("Edge length"))),
      slider_(new QSlider(Qt::Horizontal)) {
  makeFields();
  connect(slider_, &QSlider::valueChanged, this, [this](int place) {
    size_->setValue(document_.mesh()->mean_link_length * std::pow(widest, double(place) / sliderSteps));
  });
  connect(size_, &QDoubleSpinBox::valueChanged, this, &Filling::describe);
  connect(this, &AskBar::agreed, this, &Filling::start);
  connect(&document_, &Document::meshChanged, this, &Filling::hide);
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

void Filling::fill(Actions& actions) {
  actions.add("Object", {{"fillSurface", "&Fill with tetrahedra…", "", "",
                          "Makes a volume of this surface, which must be closed; asks for the edge length",
                          [this] { askSize(); }, When([this] {
                            return isSurfaceInSpace(*document_.mesh())
                                       ? QString()
                                       : "This object is not a surface in 3D: it cannot be filled";
                          })}});
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
  ask(QStringLiteral("Fill %1 with tetrahedra").arg(document_.name()) + advice(), size_);
}

/// Returns what to do about a surface that is too fine for linear FEM; an empty text if it is not.
QString Filling::advice() const {
  const QString limit = QStringLiteral("for linear FEM (at most %L1 elements)").arg(qulonglong(femLimit()));
  const QString command = QStringLiteral("'chainmail simplify FILE --elements %1 -o FILE'").arg(suitedElements());
  if (elementsAt(document_.mesh()->mean_link_length) <= aimedShare * femLimit()) {
    return {};
  }
  return isHopeless() ? QStringLiteral(". The surface is too fine %1: make it coarser with %2").arg(limit, command)
                      : QStringLiteral(". The edges offered are coarser than the surface, %1; %2 makes it coarser, too")
                            .arg(limit, command);
}

/// True if the longest edges are too short for linear FEM.
bool Filling::isHopeless() const { return elementsAt(size_->maximum()) > femLimit(); }

/// Returns the mean link length of the surface, or longer edges if linear FEM could not take so many elements.
double Filling::offeredSize() const {
  const double mean = document_.mesh()->mean_link_length;
  const double inside = aimedShare * femLimit() - double(document_.mesh()->element_count());
  if (elementsAt(mean) <= aimedShare * femLimit()) {
    return mean;
  }
  return inside <= 0 ? widest * mean : std::min(widest * mean, std::cbrt(points_per_cube * volume_ / inside));
}

/// Returns the number of elements of a coarser surface that linear FEM takes when it is filled with edges of the length
/// of its own: that grows with the root of the area that each element stands for.
int Filling::suitedElements() const {
  const Mesh& mesh = *document_.mesh();
  const double count = mesh.element_count(), inside = elementsAt(mesh.mean_link_length) - count;
  const auto filled = [&](double coarse) { return coarse + inside * std::pow(coarse / count, 1.5); };
  double low = 0, high = count;
  while (high - low > 1) {
    const double middle = (low + high) / 2;
    (filled(middle) < aimedShare * femLimit() ? low : high) = middle;
  }
  return int(roughly(std::max(low, double(fewest_simplified))));
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
  showResult(QStringLiteral("about %L1 elements").arg(qlonglong(roughly(elements))), elements < maxElements);
  showDetails(elements < maxElements ? limitsAt(elements) : refusalAt(size));
}

/// Returns which methods take a number of elements, with their limits. ChainMail has none.
QString Filling::limitsAt(double elements) {
  const QString enough = methodsWithLimits(elements, false), few = methodsWithLimits(elements, true);
  return (enough.isEmpty() ? QStringLiteral("Only methods without a limit take so many, such as ChainMail")
                           : QStringLiteral("Few enough for %1").arg(enough)) +
         (few.isEmpty() ? QString() : QStringLiteral(". Too many for %1").arg(few));
}

/// Returns why an edge length is refused, and what to do.
QString Filling::refusalAt(double size) const {
  const bool longerHelp = size < size_->maximum() && elementsAt(size_->maximum()) < maxElements;
  return QStringLiteral("More than %L1 elements would take minutes and could not be dragged: %2")
      .arg(qlonglong(maxElements))
      .arg(longerHelp ? QStringLiteral("choose longer edges")
                      : QStringLiteral("make the surface coarser with chainmail simplify"));
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
