#pragma once

#include <QImage>
#include <QObject>
#include <QProcess>
#include <QTemporaryDir>
#include <QThreadPool>
#include <QTimer>
#include <atomic>
#include <memory>
#include <vector>

#include "document/document.h"

namespace chainmail {

/// Plays all moves on the tape and takes a picture of the panels after each: numbered PNG files in a folder, or, where
/// ffmpeg is found, a video. The window stays at work; what is not complete does not stay.
class Film : public QObject {
  Q_OBJECT

 public:
  static constexpr int picturesASecond = 60;

  Film(Document& document, QWidget& scene);
  ~Film() override;

  static bool canMakeVideos();

  bool running() const { return running_; }
  /// A path that is a folder receives pictures; any other becomes a video of the kind that its ending names.
  void begin(const QString& path);
  void cancel();

 signals:
  /// It has begun, or is over.
  void changed();
  void progressed(int done, int pictures);
  void saved(const QString& path);
  void failed(const QString& sentence);

 private:
  void goOn();
  void take();
  void savePicture(const QImage& picture);
  void startVideo(QSize size);
  void sendPicture(const QImage& picture);
  void finish();
  void finishPictures();
  void endVideo();
  void fail(const QString& sentence);
  void stopWriters();
  void end();

  Document& document_;
  QWidget& scene_;
  QTimer wait_;
  bool running_ = false;
  bool video_ = false;
  QString path_;
  std::vector<std::size_t> places_;  // on the tape, of each picture
  std::size_t next_ = 0;
  QSize size_;
  std::size_t before_ = 0;                 // where the object stood
  std::unique_ptr<QTemporaryDir> folder_;  // where it is made
  QThreadPool encoders_;
  std::atomic<int> waiting_ = 0;         // pictures that are not encoded yet
  std::atomic<bool> unwritten_ = false;  // a picture could not be written
  QProcess ffmpeg_;
};

}  // namespace chainmail
