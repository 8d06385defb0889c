#pragma once

#include <QDoubleSpinBox>
#include <QMenu>
#include <QSlider>

#include "common/ask_bar.h"
#include "common/jobs.h"
#include "document/document.h"

namespace chainmail {

/// Fills a closed surface with tetrahedra: asks for their edge length, and works in the background.
class Filling : public AskBar {
  Q_OBJECT

 public:
  Filling(Document& document, Jobs& jobs);

  void fill(QMenu& menu);

 private:
  void askSize();
  void makeFields();
  void describe();
  QString advice() const;
  bool isHopeless() const;
  static QString limitsAt(double elements);
  QString refusalAt(double size) const;
  int suitedElements() const;
  double offeredSize() const;
  double elementsAt(double size) const;
  void adapt();
  void start();

  Document& document_;
  Jobs& jobs_;
  QDoubleSpinBox* size_;
  QSlider* slider_;
  QAction* action_ = nullptr;
  double volume_ = 0;  // enclosed by the surface (mesh units cubed)
};

}  // namespace chainmail
