#include "docks/physics_dock.h"

#include <QHBoxLayout>
#include <QToolButton>
#include <QVBoxLayout>
#include <algorithm>

#include "common/actions.h"
#include "common/dock_scroll.h"
#include "common/icons.h"
#include "document/edits.h"
#include "elastic/surface_cells.h"

namespace chainmail {
namespace {

/// Says how to find the softness that comes closest to the material.
QWidget* makeCalibration() {
  auto* calibrate =
      new QLabel(QStringLiteral("To find the softness closest to this material, run\n"
                                "chainmail calibrate FILE --pins LAYER --poisson RATIO -o softness.json"));
  calibrate->setObjectName(QStringLiteral("calibrate"));
  calibrate->setWordWrap(true);
  calibrate->setTextInteractionFlags(Qt::TextSelectableByMouse);
  calibrate->setToolTip(QStringLiteral("A command of the terminal. Help > Manual, page Physics, describes it"));
  return calibrate;
}

}  // namespace

PhysicsDock::PhysicsDock(Document& document, const Actions& actions)
    : document_(document),
      pins_(new QLabel),
      rows_([&document]() -> const ElasticOptions& { return document.elastic(); },
            [&document](const ElasticOptions& options, const QString& label, int gesture) {
              edits::setElastic(document, options, label, gesture);
            }) {
  auto* column = new QVBoxLayout;
  rows_.addTo(*column);
  column->addLayout(makePins(actions));
  column->addWidget(makeCalibration());
  setColumn(*this, *column);
  connect(&document, &Document::elasticChanged, this, &PhysicsDock::showElastic);
  connect(&document, &Document::pinsChanged, this, &PhysicsDock::showPins);
  for (const auto show : {&PhysicsDock::showElastic, &PhysicsDock::showPins}) {
    connect(&document, &Document::meshChanged, this, show);
    (this->*show)();
  }
}

QLayout* PhysicsDock::makePins(const Actions& actions) {
  pins_->setTextFormat(Qt::RichText);
  pins_->setObjectName(QStringLiteral("physicsPins"));
  pins_->setWordWrap(true);
  auto* pin = new QToolButton;
  pin->setObjectName(QStringLiteral("physicsPin"));
  pin->setText(QStringLiteral("Pin"));
  pin->setIcon(icon("pin"));
  pin->setToolButtonStyle(Qt::ToolButtonTextBesideIcon);
  pin->setToolTip(QStringLiteral("Pins a layer of the object or its boundary. The Pin tool (P) pins single elements"));
  pin->setMenu(&actions.menu("pinLayers"));
  pin->setPopupMode(QToolButton::InstantPopup);
  auto* row = new QHBoxLayout;
  row->addWidget(pins_, 1);
  row->addWidget(pin);
  return row;
}

/// Hides what the law, the shape or the space of the object has no use for.
void PhysicsDock::showElastic() {
  const Mesh& mesh = *document_.mesh();
  const auto ofLaw = number_of(document_.elastic().law.kind);
  rows_.show(
      [&](const MemberInfo& member) {
        return is_of_surfaces(member) ? is_surface_in_space(mesh) : !is_of_law(member) || member.number == ofLaw;
      },
      [&](std::size_t axis) {
        return std::ranges::count(std::span(mesh.axes).first(std::size_t(mesh.space_dimension)), int(axis)) > 0;
      });
}

void PhysicsDock::showPins() {
  pins_->setText(document_.pins().empty() ? QStringLiteral("Nothing is pinned: FEM and BEM have no solution.")
                                          : QStringLiteral("<b>%L1</b> of %L2 elements pinned")
                                                .arg(document_.pins().size())
                                                .arg(document_.mesh()->element_count()));
}

}  // namespace chainmail
