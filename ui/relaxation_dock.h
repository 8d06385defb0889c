#pragma once

#include <QCheckBox>
#include <QDockWidget>

#include "document.h"
#include "parameter_row.h"

namespace chainmail {

/// Relaxation in idle time: on or off, and its step.
class RelaxationDock : public QDockWidget {
  Q_OBJECT

 public:
  explicit RelaxationDock(Document& document);

 private:
  Document& document_;
  QCheckBox* on_;
  ParameterRow* step_;
};

}  // namespace chainmail
