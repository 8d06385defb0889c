#include "docks/selected_links.h"

#include <QHBoxLayout>
#include <QVBoxLayout>

#include "document/edits.h"
#include "equilibrium/link_energy.h"

namespace chainmail {
namespace {

const QString selectedPrefix = QStringLiteral("selected-");

}  // namespace

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

}  // namespace chainmail
