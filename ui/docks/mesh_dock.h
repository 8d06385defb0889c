#pragma once

#include <QComboBox>
#include <QDockWidget>
#include <QFrame>
#include <QLabel>
#include <QPushButton>
#include <QSpinBox>
#include <array>

#include "common/jobs.h"
#include "common/number_field.h"
#include "document/document.h"
#include "mesh/generate.h"

class QGridLayout;

namespace chainmail {

/// A popover with thumbnails of the samples; a click opens one.
class Gallery : public QFrame {
  Q_OBJECT

 public:
  /// Shows the samples in `folder`. An empty string means that there is no such folder.
  explicit Gallery(const QString& folder, QWidget* parent = nullptr);

  /// Opens below a button, or where there is room on its screen.
  void openBelow(const QWidget& button);

 signals:
  void chosen(const QString& path);

 protected:
  void showEvent(QShowEvent* event) override;

 private:
  void fill();

  QString folder_;
  QGridLayout* grid_;
};

/// Returns the recipe of the first object of the window, which is also the default in the dock.
inline MeshRecipe sampleRecipe() {
  MeshRecipe recipe;
  recipe.kind = MeshKind::cloth;
  recipe.size = {24, 16, 1};
  return recipe;
}
/// Returns the name of a generated object.
QString recipeName(const MeshRecipe& recipe);

/// Builds an object by kind and size, opens and saves objects, and shows the samples.
class MeshDock : public QDockWidget {
  Q_OBJECT

 public:
  MeshDock(Document& document, Jobs& jobs);

 signals:
  void openRequested();
  void saveRequested();
  /// Emitted when the user chooses a sample.
  void sampleRequested(const QString& path);

 private:
  const MeshKindInfo& kind() const { return mesh_kinds()[std::size_t(kind_->currentIndex())]; }
  QLayout* makeSizes();
  QWidget* makeSamples();
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
