#include "docks/report/report_dock.h"

#include <QAction>
#include <QScreen>
#include <QVBoxLayout>
#include <algorithm>
#include <cmath>

#include "common/describe.h"
#include "common/dock_scroll.h"

namespace chainmail {
namespace {

constexpr int reportControlsWidth = 230;
constexpr int smallestReportHeight = 300;
constexpr double shareOfWindow = 0.6;  // height of the dock in the window, so that plot and table are readable at once
constexpr double shareAlone = 0.8;     // the same as a window of its own
constexpr int besideControls = 24;     // margins and spacing (pixels)
constexpr int reportProgressSteps = 1000;
constexpr int reportProgressMilliseconds = 150;

/// Gives the dock its height: a dock at the bottom is as tall as the size hint of its content.
class ReportContent : public QWidget {
 public:
  QSize sizeHint() const override {
    const QWidget* main = window()->parentWidget() != nullptr ? window()->parentWidget() : window();  // it may float
    return {QWidget::sizeHint().width(), std::max(smallestReportHeight, int(shareOfWindow * main->height()))};
  }
};

}  // namespace

QString timeLeft(double share, double seconds) {
  constexpr double leastShare = 0.02, leastSeconds = 5, minute = 60, hour = 3600;
  if (share <= leastShare || seconds < leastSeconds) {
    return {};
  }
  const double left = seconds * (1 - share) / share;
  const auto words = [](double number, const char* unit) {
    return QStringLiteral("about %1 %2 left").arg(std::max(1.0, std::round(number))).arg(QLatin1String(unit));
  };
  return left < minute ? words(left, "s") : left < hour ? words(left / minute, "min") : words(left / hour, "h");
}

ReportDock::ReportDock(Document& document)
    : choices_(new ReportChoices(document)),
      results_(new ReportResults),
      thread_(new ReportThread(this)),
      run_(new QPushButton(QStringLiteral("Run"))),
      cancel_(new QPushButton(QStringLiteral("Cancel"))),
      progress_(new QProgressBar),
      left_(new QLabel),
      pages_(new QStackedWidget) {
  setAccessibleName(QStringLiteral("Report: time against error"));
  pages_->addWidget(makeEmptyPage());
  pages_->addWidget(results_);
  auto* shared = new QLabel(QStringLiteral("The window runs on the same machine, so these times are not exact."));
  shared->setObjectName(QStringLiteral("reportTimesNote"));
  shared->setToolTip(QStringLiteral("For exact times, run 'chainmail compare' on an idle machine"));
  shared->setEnabled(false);
  auto* right = new QVBoxLayout;
  right->setSpacing(3);
  right->addWidget(pages_, 1);
  right->addWidget(shared);
  auto* content = new ReportContent;
  auto* row = new QHBoxLayout(content);
  row->setContentsMargins(6, 4, 6, 2);
  row->addWidget(makeControls());
  row->addLayout(right, 1);
  setWidget(new DockScroll(content));
  listen();
  showState();
}

QWidget* ReportDock::makeControls() {
  describe(run_, "reportRun", QStringLiteral("Run the comparison"),
           QStringLiteral("Runs the drags on the present object with the chosen contestants, from rest"));
  describe(cancel_, "reportCancel", QStringLiteral("Cancel the comparison"),
           QStringLiteral("Cancels the run; the results of the finished drags stay"));
  describe(progress_, "reportProgress", QStringLiteral("Progress of the comparison"),
           QStringLiteral("Share of the run that is done, and the present drag"));
  describe(left_, "reportTimeLeft", QStringLiteral("Time that is left"), {});
  progress_->setRange(0, reportProgressSteps);
  auto* controls = new QWidget;
  controls->setFixedWidth(reportControlsWidth);
  auto* column = new QVBoxLayout(controls);
  column->setContentsMargins(0, 0, 0, 0);
  column->setSpacing(4);
  column->addWidget(choices_, 1);
  auto* buttons = new QHBoxLayout;
  buttons->addWidget(run_);
  buttons->addWidget(cancel_);
  column->addLayout(buttons);
  column->addWidget(progress_);
  column->addWidget(left_);
  return controls;
}

QWidget* ReportDock::makeEmptyPage() {
  empty_ = new QLabel;
  empty_->setObjectName(QStringLiteral("reportEmpty"));
  empty_->setAlignment(Qt::AlignCenter);
  empty_->setWordWrap(true);
  return empty_;
}

void ReportDock::listen() {
  connect(toggleViewAction(), &QAction::triggered, this, [this](bool shown) {
    if (shown) {
      openedByUser();
    }
  });
  connect(run_, &QPushButton::clicked, this, &ReportDock::start);
  connect(cancel_, &QPushButton::clicked, this, [this] {
    thread_->cancel();
    showState();
  });
  connect(choices_, &ReportChoices::changed, this, &ReportDock::showState);
  connect(results_, &ReportResults::saved, this, &ReportDock::saved);
  connect(results_, &ReportResults::failed, this, &ReportDock::failed);
  connect(thread_, &ReportThread::progressed, this, &ReportDock::showProgress);
  connect(thread_, &ReportThread::arrived, this, [this](const ReportThread::Results& results) {
    results_->show(results);
    pages_->setCurrentWidget(results_);
    fitTable();
    showState();
  });
  connect(thread_, &ReportThread::failed, this, [this](const QString& sentence) {
    showState();
    emit failed(sentence);
  });
}

/// A dock without results begins to make them: whoever opens it wants to see some.
void ReportDock::openedByUser() {
  if (isFloating() && !isPlaced_) {
    placeOverWindow();
  }
  if (pages_->currentWidget() != results_ && !thread_->running() && choices_->complete()) {
    start();
  }
}

/// Makes a window of its own so wide that no column of the table is cut, as far as the screen allows.
void ReportDock::fitTable() {
  if (isFloating()) {
    const QRect room = screen()->availableGeometry();
    const int beside = width() - results_->width();
    resize(std::min(std::max(width(), beside + results_->tableWidth()), room.width()), height());
    move(std::max(room.left(), std::min(x(), room.right() + 1 - width())), y());
  }
}

void ReportDock::placeOverWindow() {
  isPlaced_ = true;
  const QRect main = parentWidget()->frameGeometry(), room = screen()->availableGeometry();
  QRect place(QPoint(), QSize(reportControlsWidth + results_->tableWidth() + besideControls,
                              std::max(smallestReportHeight, int(shareAlone * main.height())))
                            .boundedTo(room.size()));
  place.moveCenter(main.center());
  place.moveTopLeft({std::clamp(place.left(), room.left(), room.right() + 1 - place.width()),
                     std::clamp(place.top(), room.top(), room.bottom() + 1 - place.height())});
  setGeometry(place);
}

void ReportDock::start() {
  thread_->start(choices_->order());
  sinceStart_.start();
  showState();
  showProgress(0, QStringLiteral("starting"));
}

void ReportDock::showState() {
  const bool running = thread_->running();
  run_->setEnabled(!running && choices_->complete());
  cancel_->setEnabled(running);
  choices_->setEnabled(!running);
  progress_->setEnabled(running);
  empty_->setText(running ? QStringLiteral("Comparing the time and the error of each contestant on this object…")
                          : QStringLiteral("Press Run to compare the time and the error of each contestant on this "
                                           "object."));
  if (!running) {
    fillBar(0, QStringLiteral("ready"));
    left_->clear();
  }
}

void ReportDock::showProgress(double share, const QString& text) {
  // Painting the window disturbs the times that are measured.
  if (sinceShown_.isValid() && sinceShown_.elapsed() < reportProgressMilliseconds && text == textShown_) {
    return;
  }
  sinceShown_.start();
  textShown_ = text;
  left_->setText(timeLeft(share, double(sinceStart_.elapsed()) / 1000));
  fillBar(int(reportProgressSteps * share),
          QStringLiteral("%p% ") + QString(text).replace(QLatin1Char('%'), QLatin1String(" percent")));
}

void ReportDock::fillBar(int value, const QString& format) {
  // setValue() would repaint the bar at once, and the whole window with it.
  progress_->setUpdatesEnabled(false);
  progress_->setValue(value);
  progress_->setFormat(format);
  progress_->setUpdatesEnabled(true);
}

}  // namespace chainmail
