#pragma once

#include <QMenu>
#include <QObject>

#include "common/jobs.h"
#include "document/document.h"
#include "document/edits.h"
#include "files/mesh/input_file.h"

namespace chainmail {

class Actions;
class MeshRepair;
class Sessions;
class Volumes;

/// The File menu: open, recent files, save. Reads and writes sessions, meshes and pictures in the background. An error
/// changes nothing.
class FileActions : public QObject {
  Q_OBJECT

 public:
  FileActions(QWidget& window, Document& document, Jobs& jobs, Sessions& sessions);

  void fill(Actions& actions);
  Volumes& volumes() { return *volumes_; }
  MeshRepair& repair() { return *repair_; }
  void open();
  /// Saves the session to its file. Asks for one if there is none yet, and before it overwrites what another program
  /// has written to it.
  void saveSession();
  /// Asks for a file, and saves the session to it. Returns false if the user cancels.
  bool saveSessionAs();
  /// Opens a file in the background, once, and passes it to the reader of its kind. The first object of a window is not
  /// an undo step. `asks`: asks for the options of a volume.
  void openPath(const QString& path, edits::Opening opening = edits::Opening::next, bool asks = true);
  /// Opens a sample with default options, without asking.
  void openSample(const QString& path) { openPath(path, edits::Opening::next, false); }
  void save();
  /// Saves the object at rest, without cut links, in the format of the extension.
  void savePath(const QString& path);
  /// Saves the positions that a panel shows, in a format that stores positions.
  void saveShapePath(int panel, const QString& path);

 signals:
  void failed(const QString& sentence);
  /// Emitted when `sentence` of failed() is no longer true.
  void recovered(const QString& sentence);
  /// Emitted with a sentence that describes the opened object.
  void noted(const QString& sentence);
  void saved(const QString& path);

 private:
  void saveShape(int panel);
  Jobs::Finish readPicture(RegularFile file, const QString& path, edits::Opening opening, const Progress& progress);
  Jobs::Finish readMesh(InputFile input, const QString& path, edits::Opening opening, const Progress& progress);
  void write(const QString& path, const std::shared_ptr<const Frame>& shape);
  void fillRecent();
  void remember(const QString& path);
  QString startFolder() const;

  QWidget& window_;
  Document& document_;
  Jobs& jobs_;
  Sessions& sessions_;
  Volumes* volumes_;
  MeshRepair* repair_;
  QMenu* recent_ = nullptr;
};

}  // namespace chainmail
