#pragma once

#include <QDoubleSpinBox>
#include <QSlider>

#include "common/ask_bar.h"
#include "common/jobs.h"
#include "document/document.h"

namespace chainmail {

class Actions;

/// Fills a closed surface with tetrahedra: asks for their edge length, and works in the background.
class Filling : public AskBar {
  Q_OBJECT

 public:
  Filling(Document& document, Jobs& jobs);

  void fill(Actions& actions);

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
  void start();

  Document& document_;
  Jobs& jobs_;
  QDoubleSpinBox* size_;
  QSlider* slider_;
  double volume_ = 0;  // enclosed by the surface (mesh units cubed)
};

}  // namespace chainmail
