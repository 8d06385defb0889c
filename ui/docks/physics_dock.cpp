#include "docks/physics_dock.h"

#include <QHBoxLayout>
#include <QSignalBlocker>
#include <QToolButton>
#include <algorithm>
#include <cmath>

#include "common/actions.h"
#include "common/dock_scroll.h"
#include "common/icons.h"
#include "common/text.h"
#include "document/edits.h"
#include "elastic/surface_cells.h"

namespace chainmail {
PhysicsDock::PhysicsDock(Document& document, const Actions& actions)
    : document_(document),
      column_(new QVBoxLayout),
      young_(new ParameterRow(parameters::young)),
      poisson_(new ParameterRow(parameters::poisson)),
      law_(new QComboBox),
      gentLimit_(new ParameterRow(parameters::gent_limit)),
      fungExponent_(new ParameterRow(parameters::fung_exponent)),
      thickness_(new ParameterRow(parameters::thickness)),
      iterations_(new ParameterRow(parameters::iterations)),
      pins_(new QLabel) {
  addRow(young_, &Material::young);
  addRow(poisson_, &Material::poisson);
  addLaw();
  addThickness();
  column_->addLayout(makeLattice());
  addIterations();
  column_->addLayout(makePins(actions));
  addCalibration();
  setColumn(*this, *column_);
  connect(&document, &Document::elasticChanged, this, &PhysicsDock::showElastic);
  connect(&document, &Document::pinsChanged, this, &PhysicsDock::showPins);
  connect(&document, &Document::meshChanged, this, &PhysicsDock::adaptToMesh);
  showElastic();
  adaptToMesh();
}

void PhysicsDock::addRow(ParameterRow* row, double Material::*member) {
  column_->addWidget(row);
  connect(row, &ParameterRow::changed, this, [this, row, member](double value, int gesture) {
    ElasticOptions options = document_.elastic();
    options.material.*member = value;
    edits::setElastic(document_, options, row->label(), gesture);
  });
}

/// The law of the material, with its parameter.
void PhysicsDock::addLaw() {
  law_->setObjectName(QStringLiteral("law"));
  law_->setFocusPolicy(Qt::StrongFocus);  // the wheel scrolls the dock, without changing the field
  law_->setToolTip(QStringLiteral(
      "How the material stiffens as it is stretched, in relaxation to the material and in neo-Hookean FEM. Gent "
      "stiffens toward a limit, Fung exponentially"));
  for (const auto& [kind, name] :
       {std::pair(StrainLaw::Kind::neo_hookean, "Neo-Hookean"), std::pair(StrainLaw::Kind::gent, "Gent"),
        std::pair(StrainLaw::Kind::fung, "Fung")}) {
    law_->addItem(QString::fromLatin1(name), int(kind));
  }
  auto* label = new QLabel(QStringLiteral("Law"));
  label->setBuddy(law_);
  label->setToolTip(law_->toolTip());
  auto* row = new QHBoxLayout;
  row->addWidget(label);
  row->addWidget(law_, 1);
  column_->addLayout(row);
  connect(law_, &QComboBox::activated, this, [this] {
    ElasticOptions options = document_.elastic();
    options.law.kind = StrainLaw::Kind(law_->currentData().toInt());
    edits::setElastic(document_, options, QStringLiteral("law of the material"));
  });
  for (const auto& [parameter, member] :
       {std::pair(gentLimit_, &StrainLaw::gent_limit), std::pair(fungExponent_, &StrainLaw::fung_exponent)}) {
    column_->addWidget(parameter);
    connect(parameter, &ParameterRow::changed, this, [this, row = parameter, of = member](double value, int gesture) {
      ElasticOptions options = document_.elastic();
      options.law.*of = value;
      edits::setElastic(document_, options, row->label(), gesture);
    });
  }
}

void PhysicsDock::addThickness() {
  column_->addWidget(thickness_);
  connect(thickness_, &ParameterRow::changed, this, [this](double value, int gesture) {
    ElasticOptions options = document_.elastic();
    options.thickness = value;
    edits::setElastic(document_, options, thickness_->label(), gesture);
  });
}

/// Says how to find the softness that comes closest to the material.
void PhysicsDock::addCalibration() {
  auto* calibrate =
      new QLabel(QStringLiteral("To find the softness closest to this material, run\n"
                                "chainmail calibrate FILE --pins LAYER --poisson RATIO -o softness.json"));
  calibrate->setObjectName(QStringLiteral("calibrate"));
  calibrate->setWordWrap(true);
  calibrate->setTextInteractionFlags(Qt::TextSelectableByMouse);
  calibrate->setToolTip(QStringLiteral("A command of the terminal. Help > Manual, page Physics, describes it"));
  column_->addWidget(calibrate);
}

void PhysicsDock::addIterations() {
  column_->addWidget(iterations_);
  connect(iterations_, &ParameterRow::changed, this, [this](double value, int gesture) {
    ElasticOptions options = document_.elastic();
    options.iterations = std::uint32_t(std::lround(value));
    edits::setElastic(document_, options, iterations_->label(), gesture);
  });
}

QLayout* PhysicsDock::makeLattice() {
  constexpr const Parameter& parameter = parameters::lattice;
  QString help = text(parameter.help);
  help[0] = help[0].toUpper();
  auto* label = new QLabel(text(parameter.label));
  label->setToolTip(help);
  auto* row = new QHBoxLayout;
  row->addWidget(label, 1);
  for (int k = 0; k < 3; ++k) {
    auto* count = new QSpinBox;
    count->setObjectName(QStringLiteral("lattice%1").arg(QLatin1Char("XYZ"[k])));
    count->setAccessibleName(QStringLiteral("Control points along %1").arg(QLatin1Char("xyz"[k])));
    count->setToolTip(help);
    count->setRange(int(parameter.lowest), int(parameter.highest));
    count->setKeyboardTracking(false);
    connect(count, &QSpinBox::valueChanged, this, &PhysicsDock::setLattice);
    connect(count, &QSpinBox::editingFinished, count, &QWidget::clearFocus);  // shortcuts work again
    row->addWidget(count);
    lattice_[std::size_t(k)] = count;
  }
  label->setBuddy(lattice_[0]);
  return row;
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

void PhysicsDock::setLattice() {
  ElasticOptions options = document_.elastic();
  for (std::size_t k = 0; k < lattice_.size(); ++k) {
    options.lattice[k] = std::uint32_t(lattice_[k]->value());
  }
  edits::setElastic(document_, options, QStringLiteral("control points"));
}

void PhysicsDock::showElastic() {
  const ElasticOptions& options = document_.elastic();
  young_->show(options.material.young);
  poisson_->show(options.material.poisson);
  law_->setCurrentIndex(law_->findData(int(options.law.kind)));
  gentLimit_->show(options.law.gent_limit);
  gentLimit_->setVisible(options.law.kind == StrainLaw::Kind::gent);
  fungExponent_->show(options.law.fung_exponent);
  fungExponent_->setVisible(options.law.kind == StrainLaw::Kind::fung);
  thickness_->show(options.thickness);
  iterations_->show(options.iterations);
  for (std::size_t k = 0; k < lattice_.size(); ++k) {
    const QSignalBlocker block(lattice_[k]);
    lattice_[k]->setValue(int(options.lattice[k]));
  }
}

void PhysicsDock::showPins() {
  pins_->setText(document_.pins().empty() ? QStringLiteral("Nothing is pinned: FEM and BEM have no solution.")
                                          : QStringLiteral("<b>%L1</b> of %L2 elements pinned")
                                                .arg(document_.pins().size())
                                                .arg(document_.mesh()->element_count()));
}

void PhysicsDock::adaptToMesh() {
  const Mesh& mesh = *document_.mesh();
  const auto end = mesh.axes.begin() + mesh.space_dimension;
  for (int k = 0; k < 3; ++k) {
    lattice_[std::size_t(k)]->setVisible(std::find(mesh.axes.begin(), end, k) != end);
  }
  thickness_->setVisible(is_surface_in_space(mesh));
  showPins();
}

}  // namespace chainmail
