#include "docks/section_dock.h"

#include <QAction>
#include <QCloseEvent>
#include <QHBoxLayout>
#include <QSignalBlocker>
#include <QToolButton>
#include <cmath>

#include "common/dock_scroll.h"
#include "common/icons.h"
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

SectionDock::SectionDock(const Document& document)
    : document_(document),
      on_(new QAction(icon("section"), QStringLiteral("Section &plane"), this)),
      flip_(new QAction(QStringLiteral("&Other side of section"), this)),
      axis_(new QComboBox),
      slider_(new QSlider(Qt::Horizontal)),
      spin_(new NumberField(QStringLiteral("Position"))),
      flipBox_(new QCheckBox(QStringLiteral("Other s&ide"))) {
  makeActions();
  arrange();
  connect(&document, &Document::meshChanged, this, &SectionDock::adaptToMesh);
  adaptToMesh();
}

void SectionDock::makeActions() {
  on_->setObjectName(QStringLiteral("section"));
  on_->setCheckable(true);
  on_->setShortcut(Qt::SHIFT | Qt::Key_S);
  on_->setStatusTip(QStringLiteral("Hides the part of the object in front of a plane and shows its inside"));
  connect(on_, &QAction::toggled, this, &SectionDock::setOn);
  flip_->setObjectName(QStringLiteral("flipSection"));
  flip_->setCheckable(true);
  flip_->setStatusTip(QStringLiteral("Hides the lower side of the plane instead of the upper"));
  connect(flip_, &QAction::toggled, flipBox_, &QCheckBox::setChecked);
  connect(flipBox_, &QCheckBox::toggled, flip_, &QAction::setChecked);
  connect(flip_, &QAction::toggled, this, &SectionDock::changed);
}

void SectionDock::arrange() {
  auto* onButton = new QToolButton;
  onButton->setDefaultAction(on_);
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
    if (shown && on_->isEnabled()) {
      on_->setChecked(true);
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

void SectionDock::fill(QMenu& menu) {
  menu.addSeparator();
  menu.addAction(on_);
  menu.addAction(flip_);
}

void SectionDock::setOn(bool on) {
  setVisible(on);
  if (on) {
    raise();
  }
  adaptToMesh();
}

void SectionDock::closeEvent(QCloseEvent* event) {
  on_->setChecked(false);
  QDockWidget::closeEvent(event);
}

void SectionDock::adaptToMesh() {
  const bool spatial = document_.mesh()->space_dimension == 3;
  on_->setEnabled(spatial);
  on_->setToolTip(spatial ? on_->statusTip() : noDepth());
  flip_->setEnabled(spatial && on_->isChecked());
  const auto adapt = [&](QWidget* field, const QString& tip) {
    field->setEnabled(flip_->isEnabled());
    field->setToolTip(field->isEnabled() ? tip
                      : spatial          ? QStringLiteral("Not available: the section is off")
                                         : noDepth());
  };
  adapt(axis_, axis_->accessibleName());
  adapt(slider_, QStringLiteral("Position of the plane, from one end of the object at rest to the other"));
  adapt(spin_, QStringLiteral("Position of the plane in the object at rest (mesh units)"));
  adapt(flipBox_, flip_->statusTip());
  flip_->setToolTip(flipBox_->toolTip());
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
  if (!on_->isChecked() || !on_->isEnabled()) {
    return std::nullopt;
  }
  return SectionPlane{axis_->currentIndex(), at(), flip_->isChecked()};
}

QJsonObject SectionDock::toJson() const {
  return {{QStringLiteral("on"), on_->isChecked()},
          {QStringLiteral("axis"), axis_->currentIndex()},
          {QStringLiteral("share"), share_},
          {QStringLiteral("flipped"), flip_->isChecked()}};
}

void SectionDock::take(const QJsonObject& json) {
  axis_->setCurrentIndex(std::clamp(json[QStringLiteral("axis")].toInt(axis_->currentIndex()), 0, 2));
  share_ = std::clamp(json[QStringLiteral("share")].toDouble(share_), 0.0, 1.0);
  flip_->setChecked(json[QStringLiteral("flipped")].toBool(flip_->isChecked()));
  on_->setChecked(json[QStringLiteral("on")].toBool(on_->isChecked()));
  adaptToAxis();
}

}  // namespace chainmail
