#pragma once

#include <QCheckBox>
#include <QComboBox>
#include <QDockWidget>
#include <QDoubleSpinBox>
#include <QJsonObject>
#include <QSlider>
#include <optional>

#include "document/document.h"
#include "mesh/section.h"

namespace chainmail {

class Actions;

/// The section plane: its axis, position and hidden side. The plane is defined in the object at rest and moves with the
/// material, in all panels. The dock is open while
/// the section is on; closing it turns the section off.
class SectionDock : public QDockWidget {
  Q_OBJECT

 public:
  SectionDock(const Document& document, Actions& actions);

  /// Returns the plane; empty if the section is off or the object is in 2D.
  std::optional<SectionPlane> plane() const;
  /// Returns the settings for a session.
  QJsonObject toJson() const;
  void take(const QJsonObject& json);

 signals:
  void changed();

 protected:
  void closeEvent(QCloseEvent* event) override;

 private:
  void addActions();
  void arrange();
  void adaptToMesh();
  void adaptToAxis();
  void setOn(bool on);
  void showPosition();
  double at() const;
  bool isSpatial() const;
  QString whyOff() const;

  const Document& document_;
  Actions& actions_;
  bool on_ = false;
  QComboBox* axis_;
  QSlider* slider_;
  QDoubleSpinBox* spin_;
  QCheckBox* flipBox_;
  double share_ = 0.5;  // position in the bounding box, from 0 to 1
};

}  // namespace chainmail
