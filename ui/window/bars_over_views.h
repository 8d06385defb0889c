#pragma once

#include <QPointer>
#include <QWidget>

class QVBoxLayout;

namespace chainmail {

class Panel;
class PanelArea;

/// Bars that come and go, one above the other, over the lower edge of the lowest views. They hide no sentence of a
/// panel, and what is below them does not move, so that the next click hits what it was aimed at.
class BarsOverViews : public QWidget {
  Q_OBJECT

 public:
  /// `area` has a parent, which becomes the parent of the bars too.
  explicit BarsOverViews(PanelArea& area);
  /// Adds a bar below the others. It keeps its own visibility.
  void add(QWidget& bar);

 protected:
  bool event(QEvent* event) override;
  bool eventFilter(QObject* watched, QEvent* event) override;

 private:
  void place();

  QPointer<PanelArea> area_;  // its panels may still move while it is deleted
  QVBoxLayout* column_;
};

}  // namespace chainmail
