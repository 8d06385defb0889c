#pragma once

#include <QGroupBox>
#include <QLabel>
#include <QPushButton>

#include "common/parameter_row.h"
#include "document/document.h"

namespace chainmail {

/// Compression, stretch and shear of the selected links alone: set in one step of undo, or taken away again.
class SelectedLinks : public QGroupBox {
  Q_OBJECT

 public:
  explicit SelectedLinks(Document& document);

 private:
  /// What the selected links have in common.
  struct Common {
    LinkSoftness softness;  // of the first
    bool compression = true, stretch = true, shear = true;
    bool own = false;  // some link has a softness of its own
  };

  void arrange();
  void refresh();
  Common common() const;
  QString describe(const Common& common) const;

  Document& document_;
  QLabel* description_;
  QWidget* rows_;
  ParameterRow* compression_;
  ParameterRow* stretch_;
  ParameterRow* shear_;
  QPushButton* set_;
  QPushButton* back_;
};

}  // namespace chainmail
