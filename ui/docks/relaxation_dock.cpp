#include "docks/relaxation_dock.h"

#include <QHBoxLayout>
#include <QVBoxLayout>
#include <cmath>

#include "common/dock_scroll.h"
#include "common/text.h"
#include "document/edits.h"
#include "report/table/format.h"

namespace chainmail {
namespace {

constexpr int residualMilliseconds = 100;  // interval between updates of the residual
constexpr int toMaterial = -1;             // in place of a scheme, in the list

}  // namespace

RelaxationDock::RelaxationDock(Document& document)
    : document_(document),
      on_(new QCheckBox(QStringLiteral("Relax in idle time"))),
      scheme_(new QComboBox),
      local_(new QCheckBox(QStringLiteral("Fine only where needed"))),
      step_(new ParameterRow(parameters::relax_step)),
      residual_(new QLabel) {
  on_->setObjectName(QStringLiteral("relaxationOn"));
  on_->setToolTip(
      QStringLiteral("Moves elements toward their rest shape in the time that passes leave, "
                     "within their valid regions"));
  auto* content = new QWidget;
  auto* column = new QVBoxLayout(content);
  column->setContentsMargins(6, 4, 6, 4);
  fillSchemes();
  auto* row = new QHBoxLayout;
  row->addWidget(on_, 1);
  row->addWidget(new QLabel(QStringLiteral("by")));
  row->addWidget(scheme_);
  column->addLayout(row);
  column->addWidget(local_);
  column->addWidget(step_);
  column->addWidget(residual_);
  local_->setObjectName(QStringLiteral("relaxationLocal"));
  local_->setToolTip(QStringLiteral(
      "While the handle moves, solves for fewer positions in objects of 20,000 cells or more with open regions:\n"
      "fine near the handle and cuts, coarse elsewhere. What is inside follows when the handle rests."));
  residual_->setObjectName(QStringLiteral("residual"));
  residual_->setSizePolicy(QSizePolicy::Ignored, QSizePolicy::Preferred);
  residual_->setToolTip(QStringLiteral(
      "Estimated distance of each panel from the equilibrium, in the norm of the energy, relative to its "
      "root:\n1 far away, 0.001 close, 0 at the equilibrium. The object has settled below 0.0001."));
  refresh_.setSingleShot(true);
  refresh_.setInterval(residualMilliseconds);
  content->setSizePolicy(QSizePolicy::Preferred, QSizePolicy::Fixed);  // leaves the height to other docks
  setWidget(new DockScroll(content));
  connect(on_, &QCheckBox::toggled, this, [this] { edits::setRelaxation(document_, chosen()); });
  connect(local_, &QCheckBox::toggled, this, [this] { edits::setRelaxation(document_, chosen()); });
  connect(scheme_, &QComboBox::currentIndexChanged, this, [this] {
    scheme_->currentData() == toMaterial ? edits::relaxToMaterial(document_)
                                         : edits::setRelaxation(document_, chosen());
    showRelaxation();  // the equilibrium may be that of the material already
  });
  connect(&document, &Document::softnessChanged, this, &RelaxationDock::showRelaxation);
  connect(step_, &ParameterRow::changed, this,
          [this](double /*value*/, int gesture) { edits::setRelaxation(document_, chosen(), gesture); });
  connect(&document, &Document::relaxationChanged, this, &RelaxationDock::showRelaxation);
  connect(&refresh_, &QTimer::timeout, this, &RelaxationDock::showResidual);
  const auto refreshSoon = [this] {
    if (!refresh_.isActive()) {
      refresh_.start();
    }
  };
  connect(&document.solvers(), &PanelSolvers::frameReady, this, refreshSoon);
  connect(&document, &Document::panelsChanged, this, refreshSoon);
  showRelaxation();
}

void RelaxationDock::fillSchemes() {
  scheme_->setObjectName(QStringLiteral("relaxationScheme"));
  scheme_->setAccessibleName(QStringLiteral("Relaxation scheme"));
  QStringList help;
  for (const RelaxationSchemeInfo& one : relaxation_schemes) {
    scheme_->addItem(text(one.label), int(one.scheme));
    help << QStringLiteral("%1: %2.").arg(text(one.label), text(one.summary));
    scheme_->setItemData(scheme_->count() - 1, help.back(), Qt::ToolTipRole);
  }
  help << QStringLiteral(
      "material: the equilibrium of the material, with regions that hardly bind. Sets softness, energy and scheme.");
  scheme_->addItem(QStringLiteral("material"), toMaterial);
  scheme_->setItemData(scheme_->count() - 1, help.back(), Qt::ToolTipRole);
  scheme_->setToolTip(help.join(QLatin1Char('\n')));
}

commands::SetRelaxation RelaxationDock::chosen() const {
  const int scheme = scheme_->currentData().toInt();
  return {on_->isChecked(), step_->value(),
          scheme == toMaterial ? RelaxationScheme::equilibrium : RelaxationScheme(scheme), false, local_->isChecked()};
}

void RelaxationDock::showRelaxation() {
  const QSignalBlocker blockOn(on_), blockScheme(scheme_), blockLocal(local_);
  const auto& relaxation = document_.relaxation();
  on_->setChecked(relaxation.on);
  scheme_->setCurrentIndex(
      scheme_->findData(edits::isRelaxedToMaterial(document_) ? toMaterial : int(relaxation.scheme)));
  local_->setChecked(relaxation.local);
  step_->show(relaxation.step);
  const bool sweeps = info(relaxation.scheme).sweeps;
  step_->disable(sweeps ? QString() : QStringLiteral("The equilibrium has no step: it moves the whole object at once"));
  residual_->setVisible(!sweeps);
  local_->setVisible(!sweeps);
  showResidual();
}

void RelaxationDock::showResidual() {
  // Two in a line: the figures change while dragging, and the dock must not.
  QString residuals = QStringLiteral("Residual (relative):");
  for (int panel = 0; panel < document_.panels(); ++panel) {
    const Frame* frame = document_.solvers().frame(panel);
    const auto residual = frame != nullptr ? frame->statistics.residual : std::nullopt;
    const QString figure = !residual                  ? QStringLiteral("–")
                           : std::isfinite(*residual) ? QString::fromStdString(report::figure(*residual))
                                                      : shownNumber(*residual, 'g', 3);
    residuals += QStringLiteral("%1%2 %3").arg(panel % 2 == 0 ? QStringLiteral("\n") : QStringLiteral(", "),
                                               panelName(panel), figure);
  }
  residual_->setText(residuals);
}

}  // namespace chainmail
