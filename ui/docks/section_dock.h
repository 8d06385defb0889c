#pragma once

#include <QCheckBox>
#include <QComboBox>
#include <QDockWidget>
#include <QDoubleSpinBox>
#include <QJsonObject>
#include <QMenu>
#include <QSlider>
#include <optional>

#include "document/document.h"
#include "mesh/section.h"

namespace chainmail {

/// The section: across which axis, where, and which side is taken away. It is one of the material, for all panels: the
/// plane stands in the object at rest, and goes with it. To close the dock is to switch it off.
class SectionDock : public QDockWidget {
  Q_OBJECT

 public:
  explicit SectionDock(const Document& document);
  void fill(QMenu& menu);

  /// None where it is off, or the object has no depth.
  std::optional<SectionPlane> plane() const;
  /// As the session keeps it.
  QJsonObject toJson() const;
  void take(const QJsonObject& json);

 signals:
  void changed();

 protected:
  void closeEvent(QCloseEvent* event) override;

 private:
  void makeActions();
  void arrange();
  void adaptToMesh();
  void adaptToAxis();
  void setOn(bool on);
  void showPlace();
  double at() const;

  const Document& document_;
  QAction* on_;
  QAction* flip_;
  QComboBox* axis_;
  QSlider* slider_;
  QDoubleSpinBox* spin_;
  QCheckBox* flipBox_;
  double share_ = 0.5;  // of the way through the object's box
};

}  // namespace chainmail
