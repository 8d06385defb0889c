#include "panels/colour_choices.h"

#include <QHBoxLayout>
#include <QJsonDocument>
#include <QLabel>
#include <QSettings>
#include <QSignalBlocker>
#include <QWidgetAction>
#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "common/actions.h"
#include "common/text.h"

namespace chainmail {
namespace {

using Kind = ColourRange::Kind;

constexpr int decimals = 4;
constexpr int menuMargin = 24;  // pixels, about that of the texts of a menu

struct KindName {
  Kind kind;
  const char* name;
};
constexpr std::array kindNames{KindName{Kind::automatic, "automatic"}, KindName{Kind::fixed, "fixed"},
                               KindName{Kind::logarithmic, "logarithmic"}};

QString nameOf(Kind kind) { return QLatin1String(std::ranges::find(kindNames, kind, &KindName::kind)->name); }

QString keyOf(ColourMode mode) { return QStringLiteral("colourRange/") + text(info(mode).name); }

QJsonObject jsonOf(const ColourRange& range) {
  QJsonObject json{{QStringLiteral("kind"), nameOf(range.kind)}};
  if (range.kind == Kind::fixed) {
    json[QStringLiteral("lowest")] = range.lowest;
    json[QStringLiteral("highest")] = range.highest;
  }
  return json;
}

/// Returns the range in the JSON; none if it is not a valid one.
std::optional<ColourRange> rangeOf(const QJsonObject& json) {
  const QString kind = json[QStringLiteral("kind")].toString();
  const auto found =
      std::ranges::find_if(kindNames, [&](const KindName& one) { return kind == QLatin1String(one.name); });
  if (found == kindNames.end()) {
    return std::nullopt;
  }
  ColourRange range;
  range.kind = found->kind;
  if (range.kind == Kind::fixed) {
    range.lowest = json[QStringLiteral("lowest")].toDouble(std::nan(""));
    range.highest = json[QStringLiteral("highest")].toDouble(std::nan(""));
  }
  return range.valid() ? std::optional(range) : std::nullopt;
}

}  // namespace

ColourSelector::ColourSelector(Colouring& colouring) : colouring_(colouring) {
  setObjectName(QStringLiteral("colourBy"));
  setAccessibleName(QStringLiteral("Colour by"));
  for (const ColourModeInfo& info : colourModes()) {
    addItem(text(info.label), int(info.mode));
  }
  connect(this, &QComboBox::activated, this, [this] {
    colouring_.setMode(ColourMode(currentData().toInt()));
    clearFocus();  // so that shortcuts work again
  });
  connect(&colouring, &Colouring::modeChanged, this, &ColourSelector::showMode);
  showMode();
}

void ColourSelector::fill(Actions& actions) {
  std::vector<ActionRow> rows;
  for (const ColourModeInfo& one : colourModes()) {
    rows.emplace_back(
        QStringLiteral("colourBy-") + text(one.name), text(one.label), "", "",
        one.title.empty() ? QStringLiteral("Draws each object in the colour of its panel")
                          : QStringLiteral("Colours the objects by: %1 (%2)").arg(text(one.title), text(one.unit)),
        [this, mode = one.mode] { colouring_.setMode(mode); },
        IsOn([this, mode = one.mode] { return colouring_.mode() == mode; }));
  }
  actions.add("View", {{"colours", "&Colour by", "colour"}});
  actions.add("colours", rows);
}

void ColourSelector::showMode() {
  const int index = findData(int(colouring_.mode()));
  // While nothing is selected, the box shows its placeholder.
  setPlaceholderText(overlay_.section(QStringLiteral(" ("), 0, 0));  // without the unit
  setCurrentIndex(overlay_.isEmpty() ? index : -1);
  setToolTip(overlay_.isEmpty()
                 ? QStringLiteral("The quantity that the colours of all panels show")
                 : QStringLiteral("%1: the colours of a dock that is open. When it is closed, they show: %2")
                       .arg(overlay_, text(info(colouring_.mode()).label)));
}

void ColourSelector::showOverlay(const QString& title) {
  overlay_ = title;
  showMode();
}

ColourRangeMenu::ColourRangeMenu(Colouring& colouring, QObject* parent)
    : QObject(parent),
      colouring_(colouring),
      fields_(new QWidgetAction(this)),
      lowest_(makeField(QStringLiteral("Lowest value"), "colourRangeLowest")),
      highest_(makeField(QStringLiteral("Highest value"), "colourRangeHighest")) {
  arrangeFields();
  connect(&colouring, &Colouring::modeChanged, this, &ColourRangeMenu::showRange);
  restore();
  showRange();
}

void ColourRangeMenu::fill(Actions& actions) {
  const auto row = [this](Kind kind, const char* id, const char* name, const char* tip) {
    return ActionRow(
        id, name, "", "", tip, [this, kind] { chooseKind(kind); },
        IsOn([this, kind] { return colouring_.range().kind == kind; }), When([this, kind] {
          return colouring_.mode() != ColourMode::plain &&
                 (kind != Kind::logarithmic || !isDiverging(colouring_.mode()));
        }));
  };
  actions.add("View", {{"colourRange", "Colo&ur range", "colour"}});
  actions.add("colourRange",
              {row(Kind::automatic, "colourRange-automatic", "&Automatic", "From the lowest to the highest value now"),
               row(Kind::logarithmic, "colourRange-logarithmic", "&Logarithmic",
                   "As automatic, with equal ratios of values equally far apart, so that small values differ too"),
               row(Kind::fixed, "colourRange-fixed", "&Fixed",
                   "Between the two numbers below, so that a colour means the same value at any time")});
  actions.add("colourRange",
              ActionRow("colourRangeFields", "Ends of the fixed range", "", "", "Fixes the range between these values",
                        [this] { chooseKind(Kind::fixed); }),  // by keys
              fields_);
}

void ColourRangeMenu::arrangeFields() {
  auto* fields = new QWidget;
  auto* row = new QHBoxLayout(fields);
  row->setContentsMargins(menuMargin, 0, menuMargin / 2, 2);
  row->addWidget(new QLabel(QStringLiteral("from")));
  row->addWidget(lowest_);
  row->addWidget(new QLabel(QStringLiteral("to")));
  row->addWidget(highest_);
  fields_->setDefaultWidget(fields);
}

NumberField* ColourRangeMenu::makeField(const QString& label, const char* name) {
  auto* field = new NumberField(label);
  field->setObjectName(QLatin1String(name));
  field->setAccessibleName(label);
  field->setToolTip(QStringLiteral("%1 of the fixed range, which has the colour at the end of the legend").arg(label));
  field->setDecimals(decimals);
  field->setRange(-ColourRange::limit, ColourRange::limit);
  field->setKeyboardTracking(false);
  field->setStepType(QAbstractSpinBox::AdaptiveDecimalStepType);
  connect(field, &QDoubleSpinBox::valueChanged, this, [this] {
    choose({Kind::fixed, lowest_->value(), highest_->value()});
  });
  return field;
}

/// Begins a fixed range with the values that the colours show now.
void ColourRangeMenu::chooseKind(Kind kind) {
  ColourRange range = colouring_.range();
  if (kind == Kind::fixed && range.kind != Kind::fixed && colouring_.scale(0).known()) {
    const ColourScale scale = colouring_.scale(0);
    range.lowest = std::clamp(double(scale.lowest), -ColourRange::limit, ColourRange::limit / 2);
    range.highest = std::clamp(double(scale.highest), range.lowest + ColourRange::smallestGap, ColourRange::limit);
  }
  range.kind = kind;
  choose(range);
}

void ColourRangeMenu::choose(const ColourRange& range) {
  if (range.valid()) {
    colouring_.setRange(range);
    QSettings().setValue(keyOf(colouring_.mode()),
                         QString::fromUtf8(QJsonDocument(jsonOf(range)).toJson(QJsonDocument::Compact)));
  }
  showRange();
}

/// Shows the range of the current mode.
void ColourRangeMenu::showRange() {
  const ColourRange& range = colouring_.range();
  const QSignalBlocker noLowest(lowest_), noHighest(highest_);
  // A number that would turn the range around is refused by its field.
  lowest_->setRange(-ColourRange::limit, range.highest - ColourRange::smallestGap);
  highest_->setRange(range.lowest + ColourRange::smallestGap, ColourRange::limit);
  lowest_->setValue(range.lowest);
  highest_->setValue(range.highest);
  lowest_->setEnabled(range.kind == Kind::fixed);
  highest_->setEnabled(range.kind == Kind::fixed);
}

/// Reads the stored ranges of all modes. A file of settings may have been edited: ranges that are not valid are
/// ignored.
void ColourRangeMenu::restore() {
  for (const ColourModeInfo& mode : colourModes()) {
    const QByteArray stored = QSettings().value(keyOf(mode.mode)).toString().toUtf8();
    if (const auto range = rangeOf(QJsonDocument::fromJson(stored).object())) {
      colouring_.setRange(mode.mode, *range);
    }
  }
}

QJsonObject ColourRangeMenu::toJson() const { return jsonOf(colouring_.range()); }

void ColourRangeMenu::take(const QJsonObject& json) {
  if (const auto range = rangeOf(json)) {
    colouring_.setRange(*range);
    showRange();
  }
}

}  // namespace chainmail
