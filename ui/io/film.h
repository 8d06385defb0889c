#pragma once

#include <QImage>
#include <QObject>
#include <QProcess>
#include <QTemporaryDir>
#include <QTimer>
#include <memory>
#include <vector>

#include "common/jobs.h"
#include "document/document.h"

namespace chainmail {

/// Plays all recorded moves, takes a picture of the panels after each of them, and writes them as a video with ffmpeg.
/// It is a job of the window. The document gets solvers of its own for it, so that the work does not change; if the
/// user presses a key or a button, the film ends. An incomplete film is deleted.
class Film : public QObject {
  Q_OBJECT

 public:
  static constexpr int picturesPerSecond = 60;

  Film(Document& document, QWidget& scene, Jobs& jobs);
  ~Film() override;

  static bool canMakeVideos();

  bool running() const { return job_ != nullptr; }
  /// Starts a film, in the format of the extension.
  void begin(const QString& path);

 signals:
  /// Emitted when a film starts or ends.
  void changed();
  void saved(const QString& path);
  void failed(const QString& sentence);

 protected:
  bool eventFilter(QObject* watched, QEvent* event) override;

 private:
  struct JobShare;

  void startJob();
  void takeNext();
  void take();
  void startVideo(QSize size);
  void endVideo();
  void save();
  void fail(const QString& sentence);
  void end();

  Document& document_;
  QWidget& scene_;
  Jobs& jobs_;
  QTimer wait_;
  QString path_;
  std::vector<std::size_t> positions_;  // position in the recorded commands, per picture
  std::size_t next_ = 0;
  QSize size_;
  std::unique_ptr<QTemporaryDir> folder_;  // for the unfinished film
  QProcess ffmpeg_;
  std::shared_ptr<JobShare> job_;  // null while no film is made
};

}  // namespace chainmail
