#include "stiffness_dock.h"

#include <QPushButton>
#include <QVBoxLayout>

namespace chainmail {

StiffnessDock::StiffnessDock(Document& document)
    : QDockWidget(QStringLiteral("Stiffness")),
      document_(document),
      compression_(new ParameterRow(parameters::compression)),
      stretch_(new ParameterRow(parameters::stretch)),
      shear_(new ParameterRow(parameters::shear)) {
  setObjectName(QStringLiteral("stiffnessDock"));
  auto* content = new QWidget;
  auto* column = new QVBoxLayout(content);
  content->setMinimumWidth(dockWidth);
  setWidget(content);
  addRow(compression_, &LinkSoftness::compression);
  addRow(stretch_, &LinkSoftness::stretch);
  addRow(shear_, &LinkSoftness::shear);
  column->setSpacing(10);
  column->addStretch();
  connect(&document, &Document::softnessChanged, this, &StiffnessDock::showSoftness);
  showSoftness();
}

void StiffnessDock::addRow(ParameterRow* row, double LinkSoftness::*member) {
  widget()->layout()->addWidget(row);
  connect(row, &ParameterRow::changed, this, [this, row, member](double value, int gesture) {
    LinkSoftness softness = document_.softness();
    softness.*member = value;
    document_.setSoftness(softness, row->label().toLower(), gesture);
  });
}

void StiffnessDock::showSoftness() {
  compression_->show(document_.softness().compression);
  stretch_->show(document_.softness().stretch);
  shear_->show(document_.softness().shear);
}

}  // namespace chainmail
