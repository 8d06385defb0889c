#pragma once

#include <QCheckBox>
#include <QComboBox>
#include <QDockWidget>
#include <QLabel>
#include <QTimer>

#include "common/number_field.h"
#include "document/document.h"

namespace chainmail {

/// Relaxation in idle time: on or off, its scheme, its step, and how far the panels are from the equilibrium.
class RelaxationDock : public QDockWidget {
  Q_OBJECT

 public:
  explicit RelaxationDock(Document& document);

 private:
  void fillSchemes();
  commands::SetRelaxation chosen() const;
  void showRelaxation();
  void showResidual();

  Document& document_;
  QCheckBox* on_;
  QComboBox* scheme_;
  QCheckBox* local_;
  ParameterRow* step_;
  QLabel* residual_;
  QTimer refresh_;
};

}  // namespace chainmail
