#pragma once

#include <QCheckBox>
#include <QComboBox>
#include <QDockWidget>

#include "common/parameter_row.h"
#include "document/document.h"

namespace chainmail {

/// Relaxation in idle time: on or off, its scheme and its step.
class RelaxationDock : public QDockWidget {
  Q_OBJECT

 public:
  explicit RelaxationDock(Document& document);

 private:
  void fillSchemes();
  commands::SetRelaxation chosen() const;
  void showRelaxation();

  Document& document_;
  QCheckBox* on_;
  QComboBox* scheme_;
  ParameterRow* step_;
};

}  // namespace chainmail
