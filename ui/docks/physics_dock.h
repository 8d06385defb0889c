#pragma once

#include <QComboBox>
#include <QDockWidget>
#include <QLabel>
#include <QSpinBox>
#include <QVBoxLayout>
#include <array>

#include "common/number_field.h"
#include "document/document.h"

namespace chainmail {

class Actions;

/// Parameters of elastic methods and free-form deformation: material, lattice of control points, and pins.
class PhysicsDock : public QDockWidget {
  Q_OBJECT

 public:
  PhysicsDock(Document& document, const Actions& actions);

 private:
  void addRow(ParameterRow* row, double Material::*member);
  void addLaw();
  void addThickness();
  void addIterations();
  void addCalibration();
  QLayout* makeLattice();
  QLayout* makePins(const Actions& actions);
  void setLattice();
  void showElastic();
  void showPins();
  void adaptToMesh();

  Document& document_;
  QVBoxLayout* column_;
  ParameterRow* young_;
  ParameterRow* poisson_;
  QComboBox* law_;
  ParameterRow* gentLimit_;
  ParameterRow* fungExponent_;
  ParameterRow* thickness_;
  ParameterRow* iterations_;
  std::array<QSpinBox*, 3> lattice_{};
  QLabel* pins_;
};

}  // namespace chainmail
