#pragma once

#include <QElapsedTimer>
#include <QImage>
#include <QObject>
#include <QProcess>
#include <QTemporaryDir>
#include <QTimer>
#include <atomic>
#include <memory>
#include <vector>

#include "common/task_thread.h"
#include "document/document.h"
#include "document/propagation.h"

namespace chainmail {

/// Plays all recorded moves, or the candidates of the last pass, and takes a picture of the panels after each of them.
/// Writes numbered PNG files into a folder, or a video if ffmpeg is installed. The window stays usable. An incomplete
/// film is deleted. In a folder, the pictures of an earlier film are replaced, and those that the new one does not have
/// are removed.
class Film : public QObject {
  Q_OBJECT

 public:
  static constexpr int picturesPerSecond = 60;

  Film(Document& document, Propagation& propagation, QWidget& scene);
  ~Film() override;

  static bool canMakeVideos();
  /// Returns how many pictures a film has left in a folder: those of its numbers from 1 on, up to the first gap.
  static std::size_t picturesIn(const QString& folder);

  bool running() const { return running_; }
  /// Starts a film: pictures if the path is a folder, else a video in the format of its extension.
  void begin(const QString& path);
  /// The same of the pass that the propagation shows, with a picture before the first candidate and after each one. A
  /// video has the speed of the slow motion.
  void beginPass(const QString& path);
  /// Sets the width of the pictures in pixels; 0: as on the screen.
  void setWidth(int pixels) { width_ = pixels; }
  void cancel();

 signals:
  /// Emitted when a film starts or ends.
  void changed();
  void progressed(int done, int pictures);
  void saved(const QString& path);
  void failed(const QString& sentence);

 private:
  void start(const QString& path);
  void showNext();
  void takeNext();
  void take();
  void savePicture(const QImage& picture);
  void encode(const QImage& picture, const QString& path);
  void startVideo(QSize size);
  void sendPicture(const QImage& picture);
  void finish();
  template <class Step>
  void put(Step step);
  void finishPictures();
  void removePictures(std::size_t from, std::size_t to) const;
  void endVideo();
  void fail(const QString& sentence);
  void stopWriters();
  void end();

  Document& document_;
  Propagation& propagation_;
  QWidget& scene_;
  int width_ = 0;         // see setWidth()
  bool ofPass_ = false;   // true if the pictures are those of a pass
  double perSecond_ = 0;  // pictures of a video
  QElapsedTimer sinceShown_;
  QTimer wait_;
  bool running_ = false;
  bool video_ = false;
  QString path_;
  std::size_t earlier_ = 0;             // pictures of an earlier film in this folder at the beginning
  std::vector<std::size_t> positions_;  // position in the recorded commands, or the candidate of the pass, per picture
  std::size_t next_ = 0;
  QSize size_;
  std::size_t before_ = 0;                 // position in the recorded commands before the film
  std::unique_ptr<QTemporaryDir> folder_;  // for the unfinished film
  std::atomic<int> waiting_ = 0;           // pictures not encoded yet
  std::atomic<bool> unwritten_ = false;    // true if a picture could not be written
  std::atomic<bool> stopped_ = false;      // true if pictures that wait must not be encoded
  QProcess ffmpeg_;
  TaskThread encoder_;  // last: ends before the members that its tasks use
};

}  // namespace chainmail
