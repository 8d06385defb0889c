#pragma once

#include <QMenu>
#include <QObject>

#include "common/jobs.h"
#include "document/document.h"

namespace chainmail {

class SheetBar;

/// Pictures as sheets: opened, and saved as they are warped, in the background.
class Sheets : public QObject {
  Q_OBJECT

 public:
  Sheets(QWidget& window, Document& document, Jobs& jobs);

  /// Where it is asked how many elements a sheet has.
  SheetBar& bar() { return *bar_; }
  void fill(QMenu& menu);
  /// Asks how fine, and opens it then: as one step of undo, or as the window's first object.
  void openPath(const QString& path, bool first = false);
  void open(const QString& path, int across, bool first = false);
  /// Saves the picture as a panel's object has warped it, a PNG or a JPEG.
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
  QString asked_;  // the picture that the bar asks about
  bool first_ = false;
  QMenu* menu_ = nullptr;
  QAction* ownFrame_ = nullptr;
};

}  // namespace chainmail
