#pragma once

#include <QFrame>
#include <QLabel>

class QHBoxLayout;
class QLineEdit;
class QPushButton;

namespace chainmail {

struct Defects;

/// A bar above the panels that names the defects of the object, with a button for each repair that applies.
class RepairBar : public QFrame {
  Q_OBJECT

 public:
  RepairBar();

  /// Shows the bar with these defects; `ifNone` is its text where there is none.
  void offer(const Defects& defects, const QString& ifNone = {});
  /// Elements as close as this are welded (mesh units).
  double weldDistance() const;
  /// Adds what Show has selected to the text.
  void showShown(const QString& what);

 signals:
  void showRequested();
  void weldRequested();
  void removeLooseRequested();
  void closeHolesRequested();
  void turnCellsRequested();
  void dismissed();

 private:
  QPushButton* addButton(const QString& text, const char* name, const QString& help, void (RepairBar::*request)());
  void addWeldDistance();
  void addClose();

  QHBoxLayout* row_;
  QLabel* text_;
  QLabel* shown_;
  QPushButton *show_, *weld_, *loose_, *holes_, *cells_;
  QLineEdit* distance_;
};

}  // namespace chainmail
