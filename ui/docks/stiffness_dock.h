#pragma once

#include <QDockWidget>
#include <QVBoxLayout>

#include "common/parameter_row.h"
#include "docks/preset_row.h"
#include "document/document.h"

namespace chainmail {

/// Softness of all links: compression, stretch and shear, each with a reset button, and presets; below, softness of the
/// selected links.
class StiffnessDock : public QDockWidget {
  Q_OBJECT

 public:
  explicit StiffnessDock(Document& document);
  PresetRow& presets() { return *presets_; }

 private:
  void showSoftness();
  void addRow(ParameterRow* row, double LinkSoftness::*member);

  Document& document_;
  QVBoxLayout* column_;
  PresetRow* presets_;
  ParameterRow* compression_;
  ParameterRow* stretch_;
  ParameterRow* shear_;
};

}  // namespace chainmail
