#pragma once

#include <QDockWidget>
#include <QVBoxLayout>

#include "document.h"
#include "parameter_row.h"
#include "preset_row.h"

namespace chainmail {

/// Compression, stretch and shear of all links, live, undoable, each with its way back, and all three as presets;
/// below, of the selected links.
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
