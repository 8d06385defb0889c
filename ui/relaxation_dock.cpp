#include "relaxation_dock.h"

#include <QVBoxLayout>

namespace chainmail {

RelaxationDock::RelaxationDock(Document& document)
    : QDockWidget(QStringLiteral("Relaxation")),
      document_(document),
      on_(new QCheckBox(QStringLiteral("Relax in idle time"))),
      step_(new ParameterRow(parameters::relax_step)) {
  setObjectName(QStringLiteral("relaxationDock"));
  on_->setObjectName(QStringLiteral("relaxationOn"));
  on_->setToolTip(
      QStringLiteral("While the hand rests, elements move toward the mean of their neighbours, "
                     "never out of a valid region"));
  auto* content = new QWidget;
  auto* column = new QVBoxLayout(content);
  column->addWidget(on_);
  column->addWidget(step_);
  column->addStretch();
  setWidget(content);
  const auto send = [this] { document_.setRelaxation(on_->isChecked(), step_->value()); };
  connect(on_, &QCheckBox::toggled, this, send);
  connect(step_, &ParameterRow::changed, this, send);
  connect(&document, &Document::relaxationChanged, this, [this] {
    const QSignalBlocker block(on_);
    on_->setChecked(document_.relaxationOn());
    step_->show(document_.relaxationStep());
  });
}

}  // namespace chainmail
