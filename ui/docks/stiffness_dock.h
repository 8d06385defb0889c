#pragma once

#include <QComboBox>
#include <QDockWidget>
#include <QVBoxLayout>
#include <vector>

#include "common/parameter_row.h"
#include "docks/preset_row.h"
#include "document/document.h"

namespace chainmail {

/// Softness of all links: its numbers, each with a reset button, the kind of energy, and presets; below, softness of
/// the selected links.
class StiffnessDock : public QDockWidget {
  Q_OBJECT

 public:
  explicit StiffnessDock(Document& document);
  PresetRow& presets() { return *presets_; }

 private:
  void showSoftness();
  void addRow(const SoftnessNumber& number);
  void addEnergy();

  Document& document_;
  QVBoxLayout* column_;
  PresetRow* presets_;
  std::vector<ParameterRow*> rows_;  // in the order of softness_numbers
  QComboBox* energy_;
};

}  // namespace chainmail
