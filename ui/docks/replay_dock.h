#pragma once

#include <QComboBox>
#include <QDockWidget>
#include <QLabel>
#include <QSlider>
#include <QTimer>

#include "common/jobs.h"
#include "document/document.h"
#include "io/film.h"

namespace chainmail {

class Actions;

/// Shows all commands since the object was opened on a slider. Steps back and forth, plays them move by move, and saves
/// them as JSON or video.
class ReplayDock : public QDockWidget {
  Q_OBJECT

 public:
  /// Films show `scene`; `jobs` reads and writes recorded moves.
  ReplayDock(Document& document, QWidget& scene, Jobs& jobs, Actions& actions);

  /// Open and save recorded moves in the background.
  void openMoves(const QString& path);
  void saveMoves(const QString& path);
  /// Films all moves as a video.
  void saveFilm(const QString& path);

 signals:
  void failed(const QString& sentence);
  void saved(const QString& path);

 private:
  void addActions();
  void arrange();
  QWidget* makeTransport();
  void scheduleShow();
  void showMoves();
  QString describe() const;
  bool hasMoves() const;
  /// True if there are recorded commands before, or after, the position.
  bool behind() const;
  bool ahead() const;
  /// Return the position in the recorded commands after the next move, and before the last one. A move ends with its
  /// pass.
  std::size_t nextMove() const;
  std::size_t previousMove() const;
  void goTo(std::size_t position);
  void setPlaying(bool on);
  void playOn();
  void askForMoves();
  void askWhereMoves();
  void askWhereFilm();

  Document& document_;
  Jobs& jobs_;
  Film film_;
  Actions& actions_;
  QSlider* slider_;
  QLabel* position_;
  QComboBox* speed_;
  QTimer playing_;
  MeshPointer played_;                 // Document::unsplitMesh() of the moves
  QTimer refresh_;                     // limits the rate of updates while commands are recorded
  std::optional<std::size_t> wanted_;  // position to go to once the solvers are idle
};

}  // namespace chainmail
