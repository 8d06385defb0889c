#pragma once

#include <QDockWidget>
#include <QVBoxLayout>

#include "document.h"
#include "parameter_row.h"

namespace chainmail {

/// Compression, stretch and shear of all links, live, undoable, each with its way back; below, of the selected ones.
class StiffnessDock : public QDockWidget {
  Q_OBJECT

 public:
  explicit StiffnessDock(Document& document);

 private:
  void showSoftness();
  void addRow(ParameterRow* row, double LinkSoftness::*member);

  Document& document_;
  QVBoxLayout* column_;
  ParameterRow* compression_;
  ParameterRow* stretch_;
  ParameterRow* shear_;
};

}  // namespace chainmail
