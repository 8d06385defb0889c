#pragma once

#include <QComboBox>
#include <QDockWidget>
#include <QLabel>
#include <QVBoxLayout>
#include <vector>

#include "common/number_field.h"
#include "docks/preset_row.h"
#include "document/document.h"

namespace chainmail {

/// Softness of all links and of the selected ones: its numbers, each with a reset button, and presets; below, the axes
/// of valid regions, the kind of energy and its numbers.
class StiffnessDock : public QDockWidget {
  Q_OBJECT

 public:
  explicit StiffnessDock(Document& document);
  PresetRow& presets() { return *presets_; }

 private:
  void showSoftness();
  void addRow(const SoftnessNumber& number);
  void addFrame();
  void addEnergy();
  void showFrame();

  Document& document_;
  QVBoxLayout* column_;
  PresetRow* presets_;
  std::vector<ParameterRow*> rows_;  // in the order of softness_numbers
  QComboBox* frame_;
  QLabel* frameNote_;
  MeshPointer notedMesh_;  // of which the note is
  QComboBox* energy_;
};

}  // namespace chainmail
