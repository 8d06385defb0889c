#include "docks/stiffness_dock.h"

#include <QHBoxLayout>
#include <QLabel>

#include "common/dock_scroll.h"
#include "common/text.h"
#include "docks/selected_links.h"
#include "document/edits.h"

namespace chainmail {

StiffnessDock::StiffnessDock(Document& document)
    : document_(document),
      column_(new QVBoxLayout),
      presets_(new PresetRow(document)),
      frame_(new QComboBox),
      frameNote_(new QLabel),
      energy_(new QComboBox) {
  presets_->setSizePolicy(QSizePolicy::Preferred, QSizePolicy::Fixed);
  column_->addWidget(presets_);
  for (std::size_t i = 0; i < softness_numbers.size(); ++i) {
    if (i == region_numbers) {
      column_->addWidget(new SelectedLinks(document));
      addFrame();
      addEnergy();
    }
    addRow(softness_numbers[i]);
  }
  setColumn(*this, *column_);
  for (const auto change : {&Document::softnessChanged, &Document::meshChanged, &Document::relaxationChanged}) {
    connect(&document, change, this, &StiffnessDock::showSoftness);
  }
  showSoftness();
}

void StiffnessDock::addRow(const SoftnessNumber& number) {
  auto* row = rows_.emplace_back(new ParameterRow(*number.parameter));
  column_->addWidget(row);
  connect(row, &ParameterRow::changed, this, [this, row, member = number.value](double value, int gesture) {
    LinkSoftness softness = document_.softness();
    softness.*member = value;
    edits::setSoftness(document_, softness, row->label().toLower(), gesture);
  });
}

/// The axes of valid regions. A given rotation comes from a session or from moves: it is listed while it applies.
void StiffnessDock::addFrame() {
  frame_->setObjectName(QStringLiteral("frame"));
  frame_->setAccessibleName(QStringLiteral("Regions along"));
  frame_->setFocusPolicy(Qt::StrongFocus);
  frame_->addItem(QStringLiteral("World's axes"), int(AxesKind::axes));
  frame_->addItem(QStringLiteral("Object's axes"), int(AxesKind::object));
  const QString help = QStringLiteral(
      "Axes along which valid regions lie.\nWorld's axes: x, y and z\nObject's axes: the principal axes of the object "
      "at rest, so that a turned object deforms as it does unturned");
  frame_->setToolTip(help);
  auto* label = new QLabel(QStringLiteral("Regions along"));
  label->setBuddy(frame_);
  label->setToolTip(help);
  auto* row = new QHBoxLayout;
  row->addWidget(label);
  row->addWidget(frame_, 1);
  column_->addLayout(row);
  frameNote_->setObjectName(QStringLiteral("frameNote"));
  frameNote_->setWordWrap(true);
  frameNote_->setText(
      QStringLiteral("The object extends equally in several directions, so not all of its axes exist. Those nearest to "
                     "the world's axes are used."));
  column_->addWidget(frameNote_);
  connect(frame_, &QComboBox::activated, this,
          [this] { edits::setRegionAxes(document_, AxesKind(frame_->currentData().toInt())); });
}

void StiffnessDock::showFrame() {
  const RegionAxes& axes = document_.wholeSoftness()->axes;
  const int given = frame_->findData(int(AxesKind::given));
  if (axes.kind() == AxesKind::given && given < 0) {
    frame_->addItem(QStringLiteral("Given axes"), int(AxesKind::given));
  } else if (axes.kind() != AxesKind::given && given >= 0) {
    frame_->removeItem(given);
  }
  frame_->setCurrentIndex(frame_->findData(int(axes.kind())));
  frame_->setEnabled(document_.mesh()->space_dimension > 1);
  if (axes.kind() != AxesKind::object) {
    frameNote_->hide();
    notedMesh_.reset();
  } else if (notedMesh_ != document_.mesh()) {  // takes time in proportion to the object
    notedMesh_ = document_.mesh();
    frameNote_->setVisible(!principal_axes(*notedMesh_).are_unique);
  }
}

/// The kind of energy applies to the whole object.
void StiffnessDock::addEnergy() {
  energy_->setObjectName(QStringLiteral("energy"));
  energy_->setAccessibleName(QStringLiteral("Energy"));
  energy_->setFocusPolicy(Qt::StrongFocus);  // the wheel scrolls the dock, without changing the field
  QString help = QStringLiteral("Elastic energy that relaxation lowers.");
  for (const EnergyKindInfo& one : energy_kinds()) {
    energy_->addItem(text(one.label), int(one.kind));
    energy_->setItemData(energy_->count() - 1, text(one.help), Qt::ToolTipRole);
    help += QStringLiteral("\n%1: %2").arg(text(one.label), text(one.help));
  }
  energy_->setToolTip(help);
  auto* label = new QLabel(QStringLiteral("Energy"));
  label->setBuddy(energy_);
  label->setToolTip(help);
  auto* row = new QHBoxLayout;
  row->addWidget(label);
  row->addWidget(energy_, 1);
  column_->addLayout(row);
  connect(energy_, &QComboBox::activated, this,
          [this] { edits::setEnergy(document_, EnergyKind(energy_->currentData().toInt())); });
}

void StiffnessDock::showSoftness() {
  showFrame();
  energy_->setCurrentIndex(energy_->findData(int(document_.wholeSoftness()->energy)));
  for (std::size_t i = 0; i < rows_.size(); ++i) {
    const double value = document_.softness().*softness_numbers[i].value;
    rows_[i]->show(value);
    rows_[i]->setEnabled(i < region_numbers || usesLinkEnergy(document_));
  }
}

}  // namespace chainmail
