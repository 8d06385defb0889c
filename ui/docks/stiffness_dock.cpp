#include "docks/stiffness_dock.h"

#include "common/dock_scroll.h"
#include "docks/selected_links.h"

namespace chainmail {

StiffnessDock::StiffnessDock(Document& document)
    : document_(document),
      column_(new QVBoxLayout),
      presets_(new PresetRow(document)),
      compression_(new ParameterRow(parameters::compression)),
      stretch_(new ParameterRow(parameters::stretch)),
      shear_(new ParameterRow(parameters::shear)) {
  presets_->setSizePolicy(QSizePolicy::Preferred, QSizePolicy::Fixed);
  column_->addWidget(presets_);
  addRow(compression_, &LinkSoftness::compression);
  addRow(stretch_, &LinkSoftness::stretch);
  addRow(shear_, &LinkSoftness::shear);
  column_->addWidget(new SelectedLinks(document));
  setColumn(*this, *column_);
  connect(&document, &Document::softnessChanged, this, &StiffnessDock::showSoftness);
  showSoftness();
}

void StiffnessDock::addRow(ParameterRow* row, double LinkSoftness::*member) {
  column_->addWidget(row);
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
