#include "io/film.h"

#include <QBuffer>
#include <QDir>
#include <QFile>
#include <QFileInfo>
#include <QStandardPaths>
#include <QWidget>
#include <numeric>

#include "common/as_path.h"
#include "common/write_bytes.h"
#include "files/text/outputs.h"
#include "files/text/text.h"
#include "io/pictures.h"
#include "mesh/error.h"
#include "mesh/failure.h"

namespace chainmail {
namespace {

constexpr int pollMilliseconds = 4;
constexpr int labelMilliseconds = 150;          // until the heads of the panels name the candidate
constexpr int maxWaiting = 4;                   // pictures not encoded yet
constexpr qint64 maxUnsent = 64 * 1024 * 1024;  // bytes that ffmpeg has not read yet

QString ffmpegPath() { return QStandardPaths::findExecutable(QStringLiteral("ffmpeg")); }

QString pictureName(std::size_t number) {
  return QStringLiteral("move-%1.png").arg(qulonglong(number), 6, 10, QLatin1Char('0'));
}

/// Writes a picture, and waits until the disk has it. Throws Error.
void writePicture(const QImage& picture, const QString& path) {
  QBuffer buffer;
  buffer.open(QIODevice::WriteOnly);
  writeBytes(path, picture.save(&buffer, "PNG") ? buffer.data() : QByteArray());
}

}  // namespace

Film::Film(Document& document, Propagation& propagation, QWidget& scene)
    : document_(document), propagation_(propagation), scene_(scene) {
  wait_.setInterval(pollMilliseconds);
  connect(&wait_, &QTimer::timeout, this, &Film::takeNext);
  connect(&ffmpeg_, &QProcess::finished, this, [this] { endVideo(); });
  connect(&ffmpeg_, &QProcess::errorOccurred, this, [this](QProcess::ProcessError error) {
    if (running_ && error == QProcess::FailedToStart) {
      fail(QStringLiteral("%1: ffmpeg could not be started; save pictures instead").arg(path_));
    }
  });
}

Film::~Film() {
  disconnect(&ffmpeg_, nullptr, this, nullptr);
  stopWriters();
}

bool Film::canMakeVideos() { return !ffmpegPath().isEmpty(); }

std::size_t Film::picturesIn(const QString& folder) {
  std::size_t count = 0;
  for (;; ++count) {
    const QFileInfo picture(QDir(folder).filePath(pictureName(count + 1)));
    if (!picture.isFile() || picture.isSymLink()) {
      return count;
    }
  }
}

void Film::begin(const QString& path) {
  const MoveHistory& history = document_.moves().history();
  ofPass_ = false;
  perSecond_ = picturesPerSecond;
  positions_ = {history.start()};
  for (std::size_t i = history.start(); i < history.length(); ++i) {
    if (std::holds_alternative<commands::Drag>(history.at(i))) {
      positions_.push_back(i + 1);
    }
  }
  if (positions_.back() != history.length()) {
    positions_.push_back(history.length());
  }
  start(path);
}

void Film::beginPass(const QString& path) {
  if (!propagation_.isShown() || !propagation_.hasPass()) {
    emit failed(QStringLiteral("There is no pass to save: open the Propagation dock (O) and drag an element"));
    return;
  }
  ofPass_ = true;
  perSecond_ = propagation_.speed();
  propagation_.setPlays(false);
  positions_.resize(propagation_.stepCount() + 1);
  std::iota(positions_.begin(), positions_.end(), std::size_t{0});
  start(path);
}

void Film::start(const QString& path) {
  path_ = path;
  video_ = !QFileInfo(path).isDir();
  earlier_ = video_ ? 0 : picturesIn(path);
  folder_ = std::make_unique<QTemporaryDir>((video_ ? QFileInfo(path).absolutePath() : path) +
                                            QStringLiteral("/.film-XXXXXX"));
  if (!folder_->isValid()) {
    emit failed(QStringLiteral("%1: the folder is not writable; choose another folder").arg(path));
    return;
  }
  next_ = 0;
  size_ = {};
  unwritten_ = stopped_ = false;
  before_ = document_.moves().history().position();
  running_ = true;
  emit changed();
  showNext();
  wait_.start();
}

void Film::showNext() {
  sinceShown_.start();
  ofPass_ ? propagation_.goTo(positions_[next_]) : document_.moves().goTo(positions_[next_]);
}

/// Takes a picture when the panels show the move, then starts the next move.
void Film::takeNext() {
  const bool behind = video_ ? ffmpeg_.bytesToWrite() > maxUnsent : waiting_ >= maxWaiting;
  if (ofPass_ && propagation_.showsNewest()) {
    fail(QStringLiteral("%1: the object has left the pass before the film was complete; save it again").arg(path_));
    return;
  }
  if (!document_.solvers().settled() || behind || (ofPass_ && sinceShown_.elapsed() < labelMilliseconds)) {
    return;
  }
  take();
  if (!running_) {
    return;
  }
  emit progressed(int(next_), int(positions_.size()));
  if (next_ < positions_.size()) {
    showNext();
  } else {
    wait_.stop();
    finish();
  }
}

void Film::take() {
  QImage picture = pictureOf(scene_, width_ > 0 ? width_ / (scene_.width() * scene_.devicePixelRatioF()) : 1);
  if (size_.isEmpty()) {
    size_ = QSize(picture.width() & ~1, picture.height() & ~1);  // most codecs need even sizes
    if (video_) {
      startVideo(size_);
    }
  }
  picture = picture.convertToFormat(QImage::Format_RGB32).copy(QRect(QPoint(), size_));
  ++next_;
  video_ ? sendPicture(picture) : savePicture(picture);
}

void Film::savePicture(const QImage& picture) {
  ++waiting_;
  try {
    encoder_.add([this, picture, path = folder_->filePath(pictureName(next_))] {
      encode(picture, path);
      --waiting_;
    });
  } catch (...) {  // the system starts no thread
    --waiting_;
    fail(QString::fromStdString(failure_sentence(path_.toStdString())));
  }
}

void Film::encode(const QImage& picture, const QString& path) {
  try {
    if (!stopped_) {
      writePicture(picture, path);
    }
  } catch (...) {
    unwritten_ = true;
  }
}

void Film::startVideo(QSize size) {
  const QString made = folder_->filePath(QFileInfo(path_).fileName());
  ffmpeg_.setStandardOutputFile(QProcess::nullDevice());
  ffmpeg_.setStandardErrorFile(folder_->filePath(QStringLiteral("log")));
  ffmpeg_.start(ffmpegPath(), {QStringLiteral("-y"), QStringLiteral("-f"), QStringLiteral("rawvideo"),
                               QStringLiteral("-pixel_format"), QStringLiteral("bgr0"), QStringLiteral("-video_size"),
                               QStringLiteral("%1x%2").arg(size.width()).arg(size.height()),
                               QStringLiteral("-framerate"), QString::number(perSecond_), QStringLiteral("-i"),
                               QStringLiteral("-"), QStringLiteral("-pix_fmt"), QStringLiteral("yuv420p"), made});
}

void Film::sendPicture(const QImage& picture) {
  ffmpeg_.write(reinterpret_cast<const char*>(picture.constBits()), picture.sizeInBytes());
}

void Film::finish() {
  if (video_) {
    ffmpeg_.closeWriteChannel();  // ffmpeg ends after the last picture
  } else {
    encoder_.finish();
    finishPictures();
  }
}

/// Ends the film with this last step.
template <class Step>
void Film::put(Step step) {
  try {
    step();
  } catch (...) {
    fail(QString::fromStdString(failure_sentence(path_.toStdString())));
    return;
  }
  end();
  emit saved(path_);
}

/// Moves all pictures into the folder, where they replace those of an earlier film, or none of them.
void Film::finishPictures() {
  if (unwritten_) {
    fail(QStringLiteral("%1: a picture could not be written; check the free disk space").arg(path_));
    return;
  }
  put([&] {
    Outputs outputs;
    for (std::size_t number = 1; number <= positions_.size(); ++number) {
      const QString name = pictureName(number);
      outputs.take(asPath(QDir(path_).filePath(name)), asPath(folder_->filePath(name)));
    }
    outputs.commit();
    removePictures(positions_.size() + 1, std::min(earlier_, picturesIn(path_)));
  });
}

/// Removes the last pictures of an earlier, longer film: they would look like the end of this one.
void Film::removePictures(std::size_t from, std::size_t to) const {
  for (std::size_t number = from; number <= to; ++number) {
    const QString path = QDir(path_).filePath(pictureName(number));
    if (!QFile::remove(path)) {
      throw Error(shown(asPath(path)), "the film is saved, but this picture of an earlier film cannot be removed",
                  "remove it and those after it");
    }
  }
}

void Film::endVideo() {
  if (!running_) {
    return;
  }
  if (next_ == positions_.size() && ffmpeg_.exitStatus() == QProcess::NormalExit && ffmpeg_.exitCode() == 0) {
    put([&] {
      Outputs outputs;
      outputs.take(asPath(path_), asPath(folder_->filePath(QFileInfo(path_).fileName())));
      outputs.commit();
    });
    return;
  }
  QFile log(folder_->filePath(QStringLiteral("log")));
  const QString said = log.open(QIODevice::ReadOnly) ? QString::fromUtf8(log.readAll()).trimmed() : QString();
  fail(QStringLiteral("%1: ffmpeg could not write the video (%2); use a file name that ends in .mp4")
           .arg(path_, said.section(QLatin1Char('\n'), -1)));
}

/// Stops ffmpeg and the encoders; waits only for the picture that is being encoded.
void Film::stopWriters() {
  ffmpeg_.kill();
  ffmpeg_.waitForFinished();
  stopped_ = true;
  encoder_.finish();
}

void Film::cancel() {
  if (running_) {
    end();
  }
}

void Film::fail(const QString& sentence) {
  end();
  emit failed(sentence);
}

/// Ends the film and goes back to the position in the recorded commands from before the film.
void Film::end() {
  running_ = false;
  wait_.stop();
  stopWriters();
  folder_.reset();
  if (ofPass_) {
    propagation_.setShowsNewest(true);
  } else {
    document_.moves().goTo(before_);
  }
  emit changed();
}

}  // namespace chainmail
