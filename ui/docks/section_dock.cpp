#include "docks/section_dock.h"

#include <QCloseEvent>
#include <QHBoxLayout>
#include <QSignalBlocker>
#include <QToolButton>
#include <cmath>
#include <utility>

#include "common/actions.h"
#include "common/dock_scroll.h"
#include "common/number_field.h"

namespace chainmail {
namespace {

constexpr int sectionSteps = 1000;
constexpr int maxDecimals = 9;

QString noDepth() { return QStringLiteral("Not available: this object is in 2D and has no inside"); }

/// Returns the number of decimals that show one step of the slider.
int decimalsFor(double extent) {
  return extent > 0 ? std::clamp(int(std::ceil(std::log10(sectionSteps / extent))), 0, maxDecimals) : 2;
}

}  // namespace

SectionDock::SectionDock(const Document& document, Actions& actions)
    : document_(document),
      actions_(actions),
      axis_(new QComboBox),
      slider_(new QSlider(Qt::Horizontal)),
      spin_(new NumberField(QStringLiteral("Position"))),
      flipBox_(new QCheckBox(QStringLiteral("Other s&ide"))) {
  addActions();
  arrange();
  connect(&document, &Document::meshChanged, this, &SectionDock::adaptToMesh);
  adaptToMesh();
}

void SectionDock::addActions() {
  actions_.add(
      "show", {{},
               {"section", "Section &plane", "section", "Shift+S",
                "Hides the part of the object in front of a plane and shows its inside", [this](bool on) { setOn(on); },
                IsOn([this] { return on_; }), When([this] { return isSpatial() ? QString() : noDepth(); })},
               {"flipSection", "&Other side of section", "", "",
                "Hides the lower side of the plane instead of the upper", [this](bool on) { flipBox_->setChecked(on); },
                IsOn([this] { return flipBox_->isChecked(); }), When([this] { return whyOff(); })}});
  connect(this, &SectionDock::changed, &actions_, &Actions::refresh);
  connect(flipBox_, &QCheckBox::toggled, this, &SectionDock::changed);
}

bool SectionDock::isSpatial() const { return document_.mesh()->space_dimension == 3; }

/// Returns why the fields are not available; empty if they are.
QString SectionDock::whyOff() const {
  return !isSpatial() ? noDepth() : on_ ? QString() : QStringLiteral("Not available: the section is off");
}

void SectionDock::arrange() {
  auto* onButton = new QToolButton;
  onButton->setDefaultAction(&actions_["section"]);
  onButton->setToolButtonStyle(Qt::ToolButtonTextBesideIcon);
  axis_->addItems({QStringLiteral("across x"), QStringLiteral("across y"), QStringLiteral("across z")});
  axis_->setObjectName(QStringLiteral("sectionAxis"));
  axis_->setAccessibleName(QStringLiteral("Axis perpendicular to the plane"));
  slider_->setObjectName(QStringLiteral("sectionSlider"));
  slider_->setAccessibleName(QStringLiteral("Position of the plane along its axis"));
  slider_->setRange(0, sectionSteps);
  spin_->setObjectName(QStringLiteral("sectionPlace"));
  spin_->setAccessibleName(QStringLiteral("Position of the plane (mesh units)"));
  spin_->setKeyboardTracking(false);
  flipBox_->setObjectName(QStringLiteral("sectionFlip"));
  auto* content = new QWidget;
  auto* row = new QHBoxLayout(content);
  row->setContentsMargins(8, 4, 8, 6);
  row->addWidget(onButton);
  row->addWidget(axis_);
  row->addWidget(slider_, 1);
  row->addWidget(spin_);
  row->addWidget(flipBox_);
  setWidget(new DockScroll(content));
  connect(toggleViewAction(), &QAction::triggered, this, [this](bool shown) {
    if (shown && isSpatial()) {
      setOn(true);
    }
  });
  connect(axis_, &QComboBox::currentIndexChanged, this, &SectionDock::adaptToAxis);
  connect(slider_, &QSlider::valueChanged, this, [this](int step) {
    share_ = double(step) / sectionSteps;
    showPosition();
  });
  connect(spin_, &QDoubleSpinBox::valueChanged, this, [this](double position) {
    const auto& box = document_.mesh()->box;
    const int k = axis_->currentIndex();
    share_ = box[1][k] > box[0][k] ? (position - box[0][k]) / (box[1][k] - box[0][k]) : 0;
    showPosition();
  });
  connect(spin_, &QDoubleSpinBox::editingFinished, spin_, &QWidget::clearFocus);  // shortcuts work again
}

void SectionDock::setOn(bool on) {
  if (std::exchange(on_, on) == on) {
    return;
  }
  setVisible(on);
  if (on) {
    raise();
  }
  adaptToMesh();
}

void SectionDock::closeEvent(QCloseEvent* event) {
  setOn(false);
  QDockWidget::closeEvent(event);
}

void SectionDock::adaptToMesh() {
  const QString why = whyOff();
  const auto adapt = [&](QWidget* field, const QString& tip) {
    field->setEnabled(why.isEmpty());
    field->setToolTip(why.isEmpty() ? tip : why);
  };
  adapt(axis_, axis_->accessibleName());
  adapt(slider_, QStringLiteral("Position of the plane, from one end of the object at rest to the other"));
  adapt(spin_, QStringLiteral("Position of the plane in the object at rest (mesh units)"));
  adapt(flipBox_, QStringLiteral("Hides the lower side of the plane instead of the upper"));
  adaptToAxis();
}

void SectionDock::adaptToAxis() {
  const auto& box = document_.mesh()->box;
  const int k = axis_->currentIndex();
  const QSignalBlocker blocker(spin_);
  spin_->setDecimals(decimalsFor(box[1][k] - box[0][k]));
  spin_->setRange(box[0][k], box[1][k]);
  spin_->setSingleStep((box[1][k] - box[0][k]) / 100);
  showPosition();
}

void SectionDock::showPosition() {
  const QSignalBlocker slider(slider_), spin(spin_);
  slider_->setValue(int(std::lround(share_ * sectionSteps)));
  spin_->setValue(at());
  emit changed();
}

double SectionDock::at() const {
  const auto& box = document_.mesh()->box;
  const int k = axis_->currentIndex();
  return box[0][k] + share_ * (box[1][k] - box[0][k]);
}

std::optional<SectionPlane> SectionDock::plane() const {
  if (!on_ || !isSpatial()) {
    return std::nullopt;
  }
  return SectionPlane{axis_->currentIndex(), at(), flipBox_->isChecked()};
}

QJsonObject SectionDock::toJson() const {
  return {{QStringLiteral("on"), on_},
          {QStringLiteral("axis"), axis_->currentIndex()},
          {QStringLiteral("share"), share_},
          {QStringLiteral("flipped"), flipBox_->isChecked()}};
}

void SectionDock::take(const QJsonObject& json) {
  axis_->setCurrentIndex(std::clamp(json[QStringLiteral("axis")].toInt(axis_->currentIndex()), 0, 2));
  share_ = std::clamp(json[QStringLiteral("share")].toDouble(share_), 0.0, 1.0);
  flipBox_->setChecked(json[QStringLiteral("flipped")].toBool(flipBox_->isChecked()));
  setOn(json[QStringLiteral("on")].toBool(on_));
  adaptToAxis();
}

}  // namespace chainmail
