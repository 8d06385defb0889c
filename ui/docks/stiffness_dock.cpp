#include "docks/stiffness_dock.h"

#include <QHBoxLayout>

#include "common/dock_scroll.h"
#include "common/text.h"
#include "docks/member_rows.h"
#include "document/edits.h"
#include "equilibrium/link_energy.h"

namespace chainmail {
namespace {

const QString selectedPrefix = QStringLiteral("selected-");

/// Returns true if the numbers of the links' energy count: with isotropic energy they do not, and with the energy of
/// the material they do for sweeps only, which know links only.
bool usesLinkEnergy(const Document& document) {
  switch (energy_in(*document.mesh(), document.wholeSoftness()->energy)) {
    case EnergyKind::isotropic:
      return false;
    case EnergyKind::material:
      return info(document.relaxation().scheme).sweeps;
    default:
      return true;
  }
}

}  // namespace

SelectedLinks::SelectedLinks(Document& document)
    : QGroupBox(QStringLiteral("Selected links")),
      document_(document),
      description_(new QLabel),
      rows_(new QWidget),
      set_(new QPushButton(QStringLiteral("Set"))),
      back_(new QPushButton(QStringLiteral("Reset to global"))) {
  setObjectName(QStringLiteral("selectedLinks"));
  arrange();
  connect(set_, &QPushButton::clicked, this, [this] {
    LinkSoftness softness;
    for (std::size_t i = 0; i < numbers_.size(); ++i) {
      softness.*softness_numbers[i].value = numbers_[i]->value();
    }
    edits::setSoftnessOf(document_, document_.selection().links(), softness);
  });
  connect(back_, &QPushButton::clicked, this,
          [this] { edits::setSoftnessOf(document_, document_.selection().links(), std::nullopt); });
  connect(&document.selection(), &Selection::changed, this, &SelectedLinks::refresh);
  connect(&document, &Document::softnessChanged, this, &SelectedLinks::refresh);
  connect(&document, &Document::relaxationChanged, this, &SelectedLinks::refresh);
  refresh();
}

void SelectedLinks::arrange() {
  description_->setTextFormat(Qt::RichText);
  description_->setObjectName(QStringLiteral("selectedDescription"));
  description_->setWordWrap(true);
  set_->setObjectName(QStringLiteral("setSelected"));
  set_->setToolTip(QStringLiteral("Gives the selected links this softness, as one undo step"));
  back_->setObjectName(QStringLiteral("selectedToGlobal"));
  back_->setToolTip(QStringLiteral("Resets the selected links to the softness of all links"));
  auto* column = new QVBoxLayout(this);
  column->setContentsMargins(8, 4, 8, 6);
  column->setSpacing(4);
  column->addWidget(description_);
  column->addWidget(rows_);
  auto* rows = new QVBoxLayout(rows_);
  rows->setContentsMargins(0, 0, 0, 0);
  rows->setSpacing(4);
  for (const SoftnessNumber& number : softness_numbers) {
    rows->addWidget(numbers_.emplace_back(new ParameterRow(*number.parameter, selectedPrefix)));
  }
  auto* buttons = new QHBoxLayout;
  buttons->addWidget(set_);
  buttons->addWidget(back_);
  rows->addLayout(buttons);
  setMinimumWidth(minimumSizeHint().width());  // the width of the dock must not depend on the selection
}

void SelectedLinks::refresh() {
  const Common all = common();
  const LinkSoftness& global = document_.softness();
  const bool some = !document_.selection().links().empty();
  description_->setText(describe(all));
  rows_->setVisible(some);  // otherwise other widgets use the space
  rows_->setEnabled(some);
  set_->setEnabled(some);
  back_->setEnabled(all.own);
  // If the values differ, the global value is the start value.
  for (std::size_t i = 0; i < numbers_.size(); ++i) {
    const auto value = softness_numbers[i].value;
    numbers_[i]->show(all.isCommon[i] ? all.softness.*value : global.*value);
    numbers_[i]->setEnabled(i < region_numbers || usesLinkEnergy(document_));
  }
}

SelectedLinks::Common SelectedLinks::common() const {
  const Softness& softness = *document_.wholeSoftness();
  const auto& links = document_.selection().links();
  Common result{softness.global};
  for (std::size_t i = 0; i < links.size(); ++i) {
    const LinkSoftness& here = softness.of(links[i]);
    result.softness = i == 0 ? here : result.softness;
    result.own = result.own || softness.links.contains(links[i]);
    for (std::size_t k = 0; k < softness_numbers.size(); ++k) {
      const auto value = softness_numbers[k].value;
      result.isCommon[k] = result.isCommon[k] && here.*value == result.softness.*value;
    }
  }
  return result;
}

QString SelectedLinks::describe(const Common& all) const {
  const Selection& selection = document_.selection();
  if (selection.empty()) {
    return QStringLiteral("Nothing selected: use Select (S).");
  }
  // Non-breaking spaces: a short line breaks between elements and links.
  const auto some = [](std::size_t count, const char* one) {
    return QStringLiteral("<b>%L1</b>\u00a0%2%3")
        .arg(count)
        .arg(QLatin1String(one), count == 1 ? QString() : QStringLiteral("s"));
  };
  QString description =
      some(selection.elements().size(), "element") + QStringLiteral(", ") + some(selection.links().size(), "link");
  if (selection.links().empty()) {
    description += QStringLiteral("<br>No link: select both ends of a link.");
  } else if (!all.all()) {
    description += QStringLiteral("<br>Their softness differs.");
  }
  return description;
}

StiffnessDock::StiffnessDock(Document& document, Actions& actions)
    : document_(document),
      column_(new QVBoxLayout),
      presets_(new PresetRow(document, actions)),
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
  column_->addWidget(namedRow(QStringLiteral("Regions along"), help, {frame_}));
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
  const bool alongObject = axes.kind() == AxesKind::object;
  if (alongObject && measuredMesh_ != document_.mesh()) {  // takes time in proportion to the object
    measuredMesh_ = document_.mesh();
    axesAreUnique_ = principal_axes(*measuredMesh_).are_unique;
  }
  frameNote_->setVisible(alongObject && !axesAreUnique_);
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
  column_->addWidget(namedRow(QStringLiteral("Energy"), help, {energy_}));
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
