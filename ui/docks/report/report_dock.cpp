#include "docks/report/report_dock.h"

#include <QLabel>
#include <QVBoxLayout>

namespace chainmail {
namespace {

constexpr int controlsWidth = 230;
constexpr int preferredHeight = 300;
constexpr int progressSteps = 1000;
constexpr int progressMilliseconds = 150;

/// A dock at the bottom is as tall as its content would like to be.
class Content : public QWidget {
 public:
  QSize sizeHint() const override { return {QWidget::sizeHint().width(), preferredHeight}; }
};

}  // namespace

ReportDock::ReportDock(Document& document)
    : QDockWidget(QStringLiteral("Report")),
      choices_(new ReportChoices(document)),
      results_(new ReportResults),
      thread_(new ReportThread(this)),
      run_(new QPushButton(QStringLiteral("Run"))),
      cancel_(new QPushButton(QStringLiteral("Cancel"))),
      progress_(new QProgressBar),
      pages_(new QStackedWidget) {
  setObjectName(QStringLiteral("reportDock"));
  setAccessibleName(QStringLiteral("Report: speed against error"));
  pages_->addWidget(makeEmptyPage());
  pages_->addWidget(results_);
  auto* shared = new QLabel(QStringLiteral("Times measured here share the machine with the window."));
  shared->setObjectName(QStringLiteral("reportTimesNote"));
  shared->setToolTip(QStringLiteral("For times to quote, run 'chainmail compare' on a quiet machine"));
  shared->setEnabled(false);
  auto* right = new QVBoxLayout;
  right->setSpacing(3);
  right->addWidget(pages_, 1);
  right->addWidget(shared);
  auto* content = new Content;
  auto* row = new QHBoxLayout(content);
  row->setContentsMargins(6, 4, 6, 2);
  row->addWidget(makeControls());
  row->addLayout(right, 1);
  setWidget(content);
  listen();
  showState();
}

QWidget* ReportDock::makeControls() {
  run_->setObjectName(QStringLiteral("reportRun"));
  run_->setAccessibleName(QStringLiteral("Run the comparison"));
  run_->setToolTip(QStringLiteral("Lets the chosen algorithms carry the drags out on the object as it is, from rest"));
  cancel_->setObjectName(QStringLiteral("reportCancel"));
  cancel_->setAccessibleName(QStringLiteral("Cancel the comparison"));
  cancel_->setToolTip(QStringLiteral("Ends the run; what was found before stays"));
  progress_->setObjectName(QStringLiteral("reportProgress"));
  progress_->setAccessibleName(QStringLiteral("Progress of the comparison"));
  progress_->setToolTip(QStringLiteral("How much of the run is done, and on which drag it is"));
  progress_->setRange(0, progressSteps);
  auto* controls = new QWidget;
  controls->setFixedWidth(controlsWidth);
  auto* column = new QVBoxLayout(controls);
  column->setContentsMargins(0, 0, 0, 0);
  column->setSpacing(4);
  column->addWidget(choices_, 1);
  auto* buttons = new QHBoxLayout;
  buttons->addWidget(run_);
  buttons->addWidget(cancel_);
  column->addLayout(buttons);
  column->addWidget(progress_);
  return controls;
}

QWidget* ReportDock::makeEmptyPage() {
  auto* empty = new QLabel(
      QStringLiteral("Press Run to see, for each algorithm, what a move of this object costs and how far off it is."));
  empty->setObjectName(QStringLiteral("reportEmpty"));
  empty->setAlignment(Qt::AlignCenter);
  empty->setWordWrap(true);
  return empty;
}

void ReportDock::listen() {
  connect(run_, &QPushButton::clicked, this, &ReportDock::start);
  connect(cancel_, &QPushButton::clicked, this, &ReportDock::cancel);
  connect(choices_, &ReportChoices::changed, this, &ReportDock::showState);
  connect(results_, &ReportResults::saved, this, &ReportDock::saved);
  connect(results_, &ReportResults::failed, this, &ReportDock::failed);
  connect(thread_, &ReportThread::progressed, this, &ReportDock::showProgress);
  connect(thread_, &ReportThread::finished, this, [this](const ReportThread::Result& result) {
    results_->show(result);
    pages_->setCurrentWidget(results_);
    showState();
  });
  connect(thread_, &ReportThread::failed, this, [this](const QString& sentence) {
    showState();
    emit failed(sentence);
  });
}

void ReportDock::start() {
  thread_->start(choices_->order());
  showState();
  showProgress(0, QStringLiteral("beginning"));
}

void ReportDock::cancel() {
  thread_->cancel();
  showState();
}

void ReportDock::showState() {
  const bool running = thread_->running();
  run_->setEnabled(!running && choices_->complete());
  cancel_->setEnabled(running);
  choices_->setEnabled(!running);
  progress_->setEnabled(running);
  if (!running) {
    fillBar(0, QStringLiteral("ready"));
  }
}

void ReportDock::showProgress(double fraction, const QString& text) {
  // Each painting of the window is taken from the machine whose times are measured.
  if (sinceShown_.isValid() && sinceShown_.elapsed() < progressMilliseconds && text == textShown_) {
    return;
  }
  sinceShown_.start();
  textShown_ = text;
  fillBar(int(progressSteps * fraction),
          QStringLiteral("%p% ") + QString(text).replace(QLatin1Char('%'), QLatin1String(" percent")));
}

void ReportDock::fillBar(int value, const QString& format) {
  // A progress bar paints itself, and with it the whole window, before setValue returns: here it waits its turn.
  progress_->setUpdatesEnabled(false);
  progress_->setValue(value);
  progress_->setFormat(format);
  progress_->setUpdatesEnabled(true);
}

}  // namespace chainmail
