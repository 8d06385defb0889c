#pragma once

#include <QMenu>
#include <QObject>

#include "common/jobs.h"
#include "document/document.h"

class QToolBar;

namespace chainmail {

class Sessions;
class Sheets;
class Volumes;
struct OpenedMesh;

/// The File menu: open, recent files, save. Sessions, meshes and pictures are read and written in the background.
/// Nothing is lost when one of them fails.
class FileActions : public QObject {
  Q_OBJECT

 public:
  FileActions(QWidget& window, Document& document, Jobs& jobs, Sessions& sessions);

  void fill(QMenu& menu);
  /// Adds Open and Save; call it after the menu is filled.
  void fill(QToolBar& bar) const;
  Sheets& sheets() { return *sheets_; }
  Volumes& volumes() { return *volumes_; }
  void open();
  /// Saves the session where it is kept; one that is kept nowhere yet is asked for its place.
  void saveSession();
  void saveSessionAs();
  /// A session, by its ending, or a mesh, a volume or a picture, by what it holds. The first object of a window is no
  /// step of undo: there is no way back to before the start.
  void openPath(const QString& path, bool first = false);
  /// One of the samples, of which nothing is asked.
  void openSample(const QString& path);
  void save();
  /// Saves the object at rest, without its cut links, in the format that the name ends in.
  void savePath(const QString& path);
  /// Saves the shape that a panel shows, in a format that holds positions.
  void saveShapePath(int panel, const QString& path);

 signals:
  void failed(const QString& sentence);
  /// What was opened, in a sentence.
  void noted(const QString& sentence);
  void saved(const QString& path);

 private:
  void addSaveActions(QMenu& menu);
  void addShapeActions(QMenu& menu);
  void read(const QString& path, bool first, bool ask);
  void show(const OpenedMesh& opened, const QString& path, bool first);
  void write(const QString& path, const std::shared_ptr<const Frame>& shape);
  void fillRecent();
  void remember(const QString& path);
  QString startFolder() const;

  QWidget& window_;
  Document& document_;
  Jobs& jobs_;
  Sessions& sessions_;
  Sheets* sheets_;
  Volumes* volumes_;
  QAction* open_ = nullptr;
  QAction* save_ = nullptr;
  QMenu* recent_ = nullptr;
};

}  // namespace chainmail
