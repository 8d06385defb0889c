#include "io/film.h"

#include <QApplication>
#include <QFile>
#include <QFileInfo>
#include <QKeyEvent>
#include <QStandardPaths>
#include <QWidget>
#include <atomic>
#include <thread>

#include "common/as_path.h"
#include "files/text/outputs.h"
#include "io/pictures.h"
#include "mesh/error.h"

namespace chainmail {
namespace {

constexpr int pollMilliseconds = 4;
constexpr qint64 maxUnsent = 64 * 1024 * 1024;  // bytes that ffmpeg has not read yet

QString ffmpegPath() { return QStandardPaths::findExecutable(QStringLiteral("ffmpeg")); }

}  // namespace

/// What a film and the thread of its job share: the thread only reports progress.
struct Film::JobShare {
  std::atomic<std::size_t> done = 0;
  std::size_t pictures = 0;
  std::atomic<bool> ended = false;      // the film
  std::atomic<bool> cancelled = false;  // the job
};

Film::Film(Document& document, QWidget& scene, Jobs& jobs) : document_(document), scene_(scene), jobs_(jobs) {
  wait_.setInterval(pollMilliseconds);
  connect(&wait_, &QTimer::timeout, this, &Film::takeNext);
  connect(&ffmpeg_, &QProcess::finished, this, [this] { endVideo(); });
  connect(&ffmpeg_, &QProcess::errorOccurred, this, [this](QProcess::ProcessError error) {
    if (running() && error == QProcess::FailedToStart) {
      fail(QStringLiteral("%1: ffmpeg could not be started; install it again").arg(path_));
    }
  });
  connect(&document.moves(), &MovePlayer::filmEnded, this, [this] {
    if (running()) {
      fail(QStringLiteral("%1: the film ended without a result, because you used the window; export it again")
               .arg(path_));
    }
  });
}

Film::~Film() {
  disconnect(&ffmpeg_, nullptr, this, nullptr);
  if (job_) {
    job_->ended = true;
  }
  ffmpeg_.kill();
  ffmpeg_.waitForFinished();
}

bool Film::canMakeVideos() { return !ffmpegPath().isEmpty(); }

void Film::begin(const QString& path) {
  path_ = path;
  folder_ = std::make_unique<QTemporaryDir>(QFileInfo(path).absolutePath() + QStringLiteral("/.film-XXXXXX"));
  if (!folder_->isValid()) {
    emit failed(QStringLiteral("%1: the folder is not writable; choose another folder").arg(path));
    return;
  }
  document_.moves().beginFilm();
  const MoveHistory& history = document_.moves().history();
  positions_ = {history.start()};
  for (std::size_t i = history.start(); i < history.length(); ++i) {
    if (std::holds_alternative<commands::Drag>(history.at(i))) {
      positions_.push_back(i + 1);
    }
  }
  if (positions_.back() != history.length()) {
    positions_.push_back(history.length());
  }
  next_ = 0;
  size_ = {};
  startJob();
  emit changed();
  document_.moves().showInFilm(positions_.front());
  qApp->installEventFilter(this);
  wait_.start();
}

/// Ends the film before something that the user does in the window: it is for the work, not for what the film shows.
bool Film::eventFilter(QObject* watched, QEvent* event) {
  const auto* widget = qobject_cast<QWidget*>(watched);
  const bool acts = event->type() == QEvent::MouseButtonPress || event->type() == QEvent::Drop ||
                    (event->type() == QEvent::KeyPress && static_cast<QKeyEvent*>(event)->key() != Qt::Key_Escape);
  if (acts && running() && widget != nullptr && widget->window() == scene_.window() &&
      widget->objectName() != QLatin1String("jobCancel")) {
    document_.moves().endFilm();
  }
  return QObject::eventFilter(watched, event);
}

void Film::startJob() {
  job_ = std::make_shared<JobShare>();
  job_->pictures = positions_.size();
  jobs_.start(Jobs::Kind::compute, QStringLiteral("Exporting %1").arg(QFileInfo(path_).fileName()),
              [share = job_](const Progress& progress) -> Jobs::Finish {
                try {
                  for (; !share->ended; std::this_thread::sleep_for(std::chrono::milliseconds(pollMilliseconds))) {
                    progress.report(double(share->done) / double(share->pictures));
                  }
                } catch (...) {
                  share->cancelled = true;
                  throw;
                }
                return {};
              });
}

/// Takes a picture when the panels show the move, then starts the next move.
void Film::takeNext() {
  if (job_->cancelled) {
    end();
    return;
  }
  if (!document_.solvers().settled() || ffmpeg_.bytesToWrite() > maxUnsent) {
    return;
  }
  take();
  if (!running()) {
    return;
  }
  job_->done = next_;
  if (next_ < positions_.size()) {
    document_.moves().showInFilm(positions_[next_]);
  } else {
    wait_.stop();
    ffmpeg_.closeWriteChannel();  // ffmpeg ends after the last picture
  }
}

void Film::take() {
  QImage picture = pictureOf(scene_);
  if (size_.isEmpty()) {
    size_ = QSize(picture.width() & ~1, picture.height() & ~1);  // most codecs need even sizes
    startVideo(size_);
  }
  picture = picture.convertToFormat(QImage::Format_RGB32).copy(QRect(QPoint(), size_));
  ++next_;
  ffmpeg_.write(reinterpret_cast<const char*>(picture.constBits()), picture.sizeInBytes());
}

void Film::startVideo(QSize size) {
  const QString made = folder_->filePath(QFileInfo(path_).fileName());
  ffmpeg_.setStandardOutputFile(QProcess::nullDevice());
  ffmpeg_.setStandardErrorFile(folder_->filePath(QStringLiteral("log")));
  ffmpeg_.start(ffmpegPath(), {QStringLiteral("-y"), QStringLiteral("-f"), QStringLiteral("rawvideo"),
                               QStringLiteral("-pixel_format"), QStringLiteral("bgr0"), QStringLiteral("-video_size"),
                               QStringLiteral("%1x%2").arg(size.width()).arg(size.height()),
                               QStringLiteral("-framerate"), QString::number(picturesPerSecond), QStringLiteral("-i"),
                               QStringLiteral("-"), QStringLiteral("-pix_fmt"), QStringLiteral("yuv420p"), made});
}

void Film::endVideo() {
  if (!running()) {
    return;
  }
  if (next_ == positions_.size() && ffmpeg_.exitStatus() == QProcess::NormalExit && ffmpeg_.exitCode() == 0) {
    save();
    return;
  }
  QFile log(folder_->filePath(QStringLiteral("log")));
  const QString said = log.open(QIODevice::ReadOnly) ? QString::fromUtf8(log.readAll()).trimmed() : QString();
  fail(QStringLiteral("%1: ffmpeg could not write the video (%2); use a file name that ends in .mp4")
           .arg(path_, said.section(QLatin1Char('\n'), -1)));
}

void Film::save() {
  try {
    Outputs outputs;
    outputs.take(asPath(path_), asPath(folder_->filePath(QFileInfo(path_).fileName())));
    outputs.commit();
  } catch (...) {
    fail(QString::fromStdString(failure_sentence(path_.toStdString())));
    return;
  }
  end();
  emit saved(path_);
}

void Film::fail(const QString& sentence) {
  end();
  emit failed(sentence);
}

/// Ends the film, and shows the work again.
void Film::end() {
  std::exchange(job_, nullptr)->ended = true;
  qApp->removeEventFilter(this);
  wait_.stop();
  ffmpeg_.kill();
  ffmpeg_.waitForFinished();
  folder_.reset();
  document_.moves().endFilm();
  emit changed();
}

}  // namespace chainmail
