#pragma once

#include <QComboBox>
#include <QDockWidget>
#include <QLabel>
#include <QMenu>
#include <QSlider>
#include <QTimer>

#include "common/jobs.h"
#include "document/document.h"
#include "io/film.h"

class QAction;
class QProgressBar;
class QToolButton;

namespace chainmail {

/// What was done to the object, on a slider: gone back and forth in, played move by move, saved as a script or as a
/// film.
class ReplayDock : public QDockWidget {
  Q_OBJECT

 public:
  /// `scene` is what films show; `jobs` reads and writes moves.
  ReplayDock(Document& document, QWidget& scene, Jobs& jobs);

  /// The actions of the dock, for the menu bar.
  QMenu& menu() { return *menu_; }

  /// Both in the background.
  void openMoves(const QString& path);
  void saveMoves(const QString& path);
  /// Films all moves: into a folder, as pictures, or into a file, as video.
  void saveFilm(const QString& path);

 signals:
  void failed(const QString& sentence);
  void saved(const QString& path);

 private:
  void makeActions();
  QAction* add(const char* name, const QString& text, const char* icon, const QKeySequence& key, const QString& help,
               std::function<void()> act);
  void arrange();
  QWidget* makeTransport();
  QWidget* makeFilmBar();
  void listenToFilm();
  void scheduleShow();
  void showTape();
  QString describe() const;
  /// The place a move further, or a move back; a move ends with its pass.
  std::size_t nextMove() const;
  std::size_t previousMove() const;
  void goTo(std::size_t position);
  void setPlaying(bool on);
  void playOn();
  void askForMoves();
  void askWhereMoves();
  void askWhereFilm(bool video);

  Document& document_;
  Jobs& jobs_;
  Film film_;
  QMenu* menu_;
  QAction *first_, *back_, *play_, *forward_, *last_, *save_, *pictures_, *video_;
  QSlider* slider_;
  QLabel* place_;
  QComboBox* speed_;
  QWidget* filmBar_;
  QProgressBar* filmed_;
  QTimer playing_;
  QTimer refresh_;                     // the tape grows by the move: it is shown at a rate that can be read
  std::optional<std::size_t> wanted_;  // where the slider is to bring the object, once the solvers have time
};

}  // namespace chainmail
