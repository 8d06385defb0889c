#pragma once

#include <QGroupBox>
#include <QLabel>
#include <QPushButton>

#include "common/parameter_row.h"
#include "document/document.h"

namespace chainmail {

/// Compression, stretch and shear of the selected links only: sets or resets them as one undo step.
class SelectedLinks : public QGroupBox {
  Q_OBJECT

 public:
  explicit SelectedLinks(Document& document);

 private:
  /// The values that all selected links share.
  struct Common {
    LinkSoftness softness;  // of the first link
    bool compression = true, stretch = true, shear = true;
    bool own = false;  // true if a link has its own softness
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
