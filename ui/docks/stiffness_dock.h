#pragma once

#include <QComboBox>
#include <QDockWidget>
#include <QGroupBox>
#include <QLabel>
#include <QPushButton>
#include <QVBoxLayout>
#include <algorithm>
#include <vector>

#include "common/number_field.h"
#include "docks/preset_row.h"
#include "document/document.h"

namespace chainmail {

/// Softness of the selected links only: sets or resets its numbers as one undo step.
class SelectedLinks : public QGroupBox {
  Q_OBJECT

 public:
  explicit SelectedLinks(Document& document);

 private:
  /// The values that all selected links share.
  struct Common {
    LinkSoftness softness;                                                          // of the first link
    std::vector<bool> isCommon = std::vector<bool>(softness_numbers.size(), true);  // of each number
    bool own = false;  // true if a link has its own softness

    bool all() const { return std::ranges::find(isCommon, false) == isCommon.end(); }
  };

  void arrange();
  void refresh();
  Common common() const;
  QString describe(const Common& common) const;

  Document& document_;
  QLabel* description_;
  QWidget* rows_;
  std::vector<ParameterRow*> numbers_;  // in the order of softness_numbers
  QPushButton* set_;
  QPushButton* back_;
};

/// Softness of all links and of the selected ones: its numbers, each with a reset button, and presets; below, the axes
/// of valid regions, the kind of energy and its numbers.
class StiffnessDock : public QDockWidget {
  Q_OBJECT

 public:
  StiffnessDock(Document& document, Actions& actions);
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
  MeshPointer measuredMesh_;  // the object of axesAreUnique_
  bool axesAreUnique_ = true;
  QComboBox* energy_;
};

}  // namespace chainmail
