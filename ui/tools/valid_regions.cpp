#include "tools/valid_regions.h"

#include <QAction>
#include <QMenu>

#include "common/colours.h"
#include "drawing/region_shapes.h"
#include "tools/region_lens.h"

namespace chainmail {
namespace {

// Largest numbers of elements and regions. More boxes would hide each other and take time.
constexpr std::size_t elementsShown = 8;
constexpr std::size_t regionsOfEach = 200;
constexpr double planeOpacity = 0.2, spaceOpacity = 0.12;  // of each face, of which two or more lie on each other
constexpr float insideWidth = 1.5F, outsideWidth = 2.5F;   // pixels
constexpr float crossSize = 7, ringSize = 12;              // pixels

}  // namespace

ValidRegions::ValidRegions(const Document& document)
    : document_(document), shown_(new QAction(QStringLiteral("&Valid regions"), this)) {
  shown_->setObjectName(QStringLiteral("showValidRegions"));
  shown_->setCheckable(true);
  shown_->setShortcut(Qt::Key_V);
  shown_->setStatusTip(
      QStringLiteral("Shows where the neighbours of the element under the cursor may lie. Solid box with ring: the "
                     "neighbour is inside. Dashed box with cross: it is outside"));
  connect(shown_, &QAction::toggled, this, &ValidRegions::changed);
  const auto follow = [this] {
    if (shown_->isChecked()) {
      emit changed();
    }
  };
  connect(&document.highlight(), &Highlight::changed, this, follow);
  connect(&document.selection(), &Selection::changed, this, follow);
  connect(&document, &Document::softnessChanged, this, follow);
}

void ValidRegions::fill(QMenu& menu) {
  shown_->setParent(&menu);  // so that a search for all actions of the window finds it
  menu.addAction(shown_);
}

std::vector<ElementId> ValidRegions::elements() const {
  if (!shown_->isChecked()) {
    return {};
  }
  if (const auto& element = document_.highlight().marks().element) {
    return {*element};
  }
  const auto& selected = document_.selection().elements();
  return selected.size() <= elementsShown ? selected : std::vector<ElementId>();
}

QString ValidRegions::note(int /*panel*/) const {
  if (!shown_->isChecked()) {
    return {};
  }
  const auto all = elements();
  if (all.empty()) {
    return document_.selection().elements().size() > elementsShown
               ? QStringLiteral("valid regions: shown for up to %1 selected elements").arg(elementsShown)
               : QStringLiteral("valid regions: point at an element");
  }
  const bool tooMany = std::any_of(all.begin(), all.end(), [this](ElementId e) {
    return e < document_.mesh()->element_count() && document_.mesh()->neighbours_of(e).size() > regionsOfEach;
  });
  return tooMany ? QStringLiteral("valid regions: shown for the first %1 neighbours").arg(regionsOfEach) : QString();
}

void ValidRegions::draw(const Canvas& canvas) {
  for (const ElementId element : elements()) {
    if (element >= canvas.frame.mesh->element_count()) {
      continue;  // it belongs to the previous mesh
    }
    const auto regions = neighbour_regions(*canvas.frame.mesh, *document_.wholeSoftness(), document_.cuts(),
                                           canvas.frame.view(), element, regionsOfEach);
    for (const auto& region : regions) {
      draw(canvas, region);
    }
    const RegionLens lens(canvas, element, regions);
    if (document_.highlight().marks().element && lens.isUseful()) {
      lens.draw();
      for (const auto& region : regions) {
        draw(canvas, lens.magnified(region));
      }
    }
  }
}

/// Draws a region. Not only the colour shows whether the neighbour is inside, but also the line style and a mark. A
/// line joins a neighbour that is outside to the nearest point inside.
void ValidRegions::draw(const Canvas& canvas, const NeighbourRegion& region) const {
  const QColor colour = region.inside ? colours::inside : colours::outside;
  const RegionShape shape(region, canvas.frame.space, canvas.scene.toView, canvas.frame.mesh->space_dimension,
                          canvas.unitsPerPixel);
  QColor faint = colour;
  faint.setAlphaF(float(canvas.frame.mesh->space_dimension < 3 ? planeOpacity : spaceOpacity));
  canvas.painter.drawInSpace(canvas.scene, shape.faces(), ObjectDrawing::Shape::triangles, faint);
  canvas.painter.drawInSpace(canvas.scene, region.inside ? shape.edges() : shape.dashedEdges(),
                             ObjectDrawing::Shape::segments, colour, region.inside ? insideWidth : outsideWidth);
  if (!region.inside) {
    canvas.painter.drawInSpace(canvas.scene, shape.wayIn(), ObjectDrawing::Shape::segments, colour, outsideWidth);
    canvas.painter.drawInSpace(canvas.scene, shape.cross(crossSize), ObjectDrawing::Shape::segments, colour,
                               outsideWidth);
  } else {
    canvas.painter.drawElements(canvas.scene, std::span(&region.neighbour, 1), colour, ringSize,
                                ObjectDrawing::Mark::ring);
  }
}

}  // namespace chainmail
