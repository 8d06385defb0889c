#include "docks/relaxation_dock.h"

#include <QHBoxLayout>
#include <QVBoxLayout>

namespace chainmail {

RelaxationDock::RelaxationDock(Document& document)
    : document_(document),
      on_(new QCheckBox(QStringLiteral("Relax in idle time"))),
      scheme_(new QComboBox),
      step_(new ParameterRow(parameters::relax_step)) {
  on_->setObjectName(QStringLiteral("relaxationOn"));
  on_->setToolTip(
      QStringLiteral("Moves elements toward their rest shape while nothing is dragged, "
                     "within their valid regions"));
  auto* content = new QWidget;
  auto* column = new QVBoxLayout(content);
  fillSchemes();
  auto* row = new QHBoxLayout;
  row->addWidget(on_, 1);
  row->addWidget(new QLabel(QStringLiteral("by")));
  row->addWidget(scheme_);
  column->addLayout(row);
  column->addWidget(step_);
  content->setSizePolicy(QSizePolicy::Preferred, QSizePolicy::Maximum);  // leaves the height to other docks
  setWidget(content);
  connect(on_, &QCheckBox::toggled, this, [this] { document_.setRelaxation(chosen()); });
  connect(scheme_, &QComboBox::currentIndexChanged, this, [this] { document_.setRelaxation(chosen()); });
  connect(step_, &ParameterRow::changed, this,
          [this](double /*value*/, int gesture) { document_.setRelaxation(chosen(), gesture); });
  connect(&document, &Document::relaxationChanged, this, &RelaxationDock::showRelaxation);
}

void RelaxationDock::fillSchemes() {
  scheme_->setObjectName(QStringLiteral("relaxationScheme"));
  scheme_->setAccessibleName(QStringLiteral("Relaxation scheme"));
  const auto add = [this](const QString& label, RelaxationScheme scheme, const QString& help) {
    scheme_->addItem(label, int(scheme));
    scheme_->setItemData(scheme_->count() - 1, help, Qt::ToolTipRole);
  };
  add(QStringLiteral("mean"), RelaxationScheme::mean,
      QStringLiteral("Moves element by element toward the mean of the positions that its neighbours suggest"));
  add(QStringLiteral("link"), RelaxationScheme::link,
      QStringLiteral("Corrects link by link; both ends share the error (Schill 2001)"));
  scheme_->setToolTip(
      QStringLiteral("mean: element by element, toward the mean of the positions that its neighbours suggest.\n"
                     "link: link by link, both ends share the error (Schill 2001)."));
}

commands::SetRelaxation RelaxationDock::chosen() const {
  return {on_->isChecked(), step_->value(), RelaxationScheme(scheme_->currentData().toInt())};
}

void RelaxationDock::showRelaxation() {
  const QSignalBlocker blockOn(on_), blockScheme(scheme_);
  const auto& relaxation = document_.relaxation();
  on_->setChecked(relaxation.on);
  scheme_->setCurrentIndex(scheme_->findData(int(relaxation.scheme)));
  step_->show(relaxation.step);
}

}  // namespace chainmail
