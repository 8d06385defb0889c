#pragma once

#include <QComboBox>
#include <QDockWidget>
#include <QLabel>
#include <QPushButton>
#include <QSpinBox>
#include <array>

#include "common/jobs.h"
#include "common/parameter_row.h"
#include "document/document.h"
#include "mesh/generate.h"

namespace chainmail {

/// The object that the workbench opens with, and that the dock offers first.
inline MeshRecipe sampleRecipe() {
  MeshRecipe recipe;
  recipe.kind = MeshKind::cloth;
  recipe.size = {24, 16, 1};
  return recipe;
}
/// How a generated object is called.
QString recipeName(const MeshRecipe& recipe);

/// What object is there: build one by kind and size, open or save one, take a sample.
class MeshDock : public QDockWidget {
  Q_OBJECT

 public:
  MeshDock(Document& document, Jobs& jobs);

 signals:
  void openRequested();
  void saveRequested();
  /// One of the gallery's files.
  void sampleRequested(const QString& path);

 private:
  const MeshKindInfo& kind() const { return mesh_kinds()[std::size_t(kind_->currentIndex())]; }
  QLayout* makeSizes();
  void arrange();
  void adaptToKind();
  MeshRecipe recipe() const;
  void build();
  void describe();

  Document& document_;
  Jobs& jobs_;
  QComboBox* kind_;
  std::array<QSpinBox*, 3> sizes_{};
  ParameterRow* spacing_;
  QComboBox* space_;
  QPushButton* build_;
  QLabel* description_;
};

}  // namespace chainmail
