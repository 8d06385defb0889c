#pragma once

#include <QMenu>
#include <QObject>

#include "common/jobs.h"
#include "document/document.h"

namespace chainmail {

class SheetBar;

/// Opens pictures as sheets, and saves warped pictures, in the background.
class Sheets : public QObject {
  Q_OBJECT

 public:
  Sheets(QWidget& window, Document& document, Jobs& jobs);

  /// Returns the bar that asks for the number of elements.
  SheetBar& bar() { return *bar_; }
  void fill(QMenu& menu);
  /// Asks for the number of elements, then opens the picture: as one undo step, or as the first object of the window.
  void openPath(const QString& path, bool first = false);
  void open(const QString& path, int across, bool first = false);
  /// Saves the picture, warped as in a panel, as PNG or JPEG.
  void saveWarpedPath(int panel, const QString& path);

 signals:
  void failed(const QString& sentence);
  void opened(const QString& path);
  void saved(const QString& path);

 private:
  void save(int panel);
  void adapt();

  QWidget& window_;
  Document& document_;
  Jobs& jobs_;
  SheetBar* bar_;
  QString asked_;  // path of the picture in the bar
  bool first_ = false;
  QMenu* menu_ = nullptr;
  QAction* ownFrame_ = nullptr;
};

}  // namespace chainmail
