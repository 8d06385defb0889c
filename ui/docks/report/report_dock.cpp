#include "docks/report/report_dock.h"

#include <QAction>
#include <QFormLayout>
#include <QGuiApplication>
#include <QScreen>
#include <QStandardItemModel>
#include <QVBoxLayout>
#include <algorithm>

#include "common/colours.h"
#include "common/dock_scroll.h"
#include "common/number_field.h"
#include "common/plot_painting.h"
#include "common/text.h"
#include "mesh/error.h"

namespace chainmail {
namespace {

constexpr int generatedDrags = 0, lastDrag = 1;  // rows of the list of drags
constexpr int sweepsPerMove = 10;
constexpr int withEquilibrium = 3;  // row of the list of sweeps
constexpr int listMarkSize = 13;    // logical pixels

void name(QWidget* widget, const char* object, const QString& accessible, const QString& help) {
  widget->setObjectName(QLatin1String(object));
  widget->setAccessibleName(accessible);
  widget->setToolTip(help);
}

void enable(QComboBox* box, int row, bool enabled) {
  qobject_cast<QStandardItemModel*>(box->model())->item(row)->setEnabled(enabled);
}

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

ReportChoices::ReportChoices(Document& document)
    : document_(document),
      drags_(new QComboBox),
      algorithms_(new QListWidget),
      sweeps_(new QComboBox),
      precision_(new QComboBox),
      seconds_(new NumberField(QStringLiteral("Time"))) {
  fillDrags();
  fillAlgorithms();
  fillRest();
  auto* column = new QVBoxLayout(this);
  column->setContentsMargins(0, 0, 0, 0);
  auto* form = new QFormLayout;
  form->setFieldGrowthPolicy(QFormLayout::AllNonFixedFieldsGrow);
  form->setVerticalSpacing(3);
  form->addRow(QStringLiteral("Drags"), drags_);
  form->addRow(QStringLiteral("Relax"), sweeps_);
  form->addRow(QStringLiteral("Precision"), precision_);
  form->addRow(QStringLiteral("Run time"), seconds_);
  column->addWidget(algorithms_, 1);
  column->addLayout(form);
  connect(algorithms_, &QListWidget::itemChanged, this, &ReportChoices::changed);
  connect(&document, &Document::meshChanged, this, &ReportChoices::adaptToMesh);
  connect(&document.moves(), &MovePlayer::lastDragChanged, this, &ReportChoices::adaptToLastDrag);
  adaptToMesh();
  adaptToLastDrag();
}

void ReportChoices::fillDrags() {
  name(drags_, "reportDrags", QStringLiteral("Drags to compare on"),
       QStringLiteral("Three generated drags: local, of the whole body, back and forth.\n"
                      "My last drag: repeats your last drag in a panel, from rest."));
  drags_->addItems({QStringLiteral("three generated"), QStringLiteral("my last drag")});
}

void ReportChoices::fillAlgorithms() {
  name(algorithms_, "reportAlgorithms", QStringLiteral("Algorithms to compare"),
       QStringLiteral("Algorithms to compare, with their marks in the plot"));
  algorithms_->setIconSize({listMarkSize, listMarkSize});
  algorithms_->setUniformItemSizes(true);
  algorithms_->setMinimumHeight(48);
  for (const AlgorithmInfo& one : algorithms()) {
    auto* item = new QListWidgetItem(text(one.label), algorithms_);
    item->setData(Qt::UserRole, int(one.algorithm));
    item->setCheckState(Qt::Checked);
  }
  followTheme(*this, [this] {
    const QSignalBlocker block(algorithms_);  // the user has changed nothing
    for (int row = 0; row < algorithms_->count(); ++row) {
      const auto algorithm = Algorithm(algorithms_->item(row)->data(Qt::UserRole).toInt());
      algorithms_->item(row)->setIcon(
          QIcon(plotMark(algorithm, false, listMarkSize, devicePixelRatioF(), QGuiApplication::palette())));
    }
  });
}

void ReportChoices::fillRest() {
  name(sweeps_, "reportSweeps", QStringLiteral("Relaxation after each move"),
       QStringLiteral("Each algorithm without relaxation, with 10 sweeps after each move, or both.\n"
                      "Scheme and step are those of the Relaxation dock; the scheme is mean if it is the equilibrium "
                      "there.\n"
                      "With equilibrium, Natural Queue and Exact also relax to the equilibrium after each move."));
  sweeps_->addItems({QStringLiteral("off"), QStringLiteral("%1 sweeps").arg(sweepsPerMove),
                     QStringLiteral("off and %1 sweeps").arg(sweepsPerMove),
                     QStringLiteral("off, %1 sweeps and equilibrium").arg(sweepsPerMove)});
  sweeps_->setCurrentIndex(2);
  name(precision_, "reportPrecision", QStringLiteral("Precision of the contestants"),
       QStringLiteral("Number type that the algorithms use (float or double). Reference solutions always use double"));
  precision_->addItems({QStringLiteral("float"), QStringLiteral("double")});
  name(seconds_, "reportSeconds", QStringLiteral("Time in seconds"),
       QStringLiteral("Time for the repetitions of one drag by all algorithms, at least five repetitions.\n"
                      "More time gives steadier results; the errors stay the same."));
  seconds_->setRange(0.1, 60);
  seconds_->setDecimals(1);
  seconds_->setValue(2);
  seconds_->setSuffix(QStringLiteral(" s per drag"));
  seconds_->setKeyboardTracking(false);
  connect(seconds_, &QDoubleSpinBox::editingFinished, seconds_, &QWidget::clearFocus);  // shortcuts work again
}

/// Disables the algorithms that do not work on the mesh. Their tool tips give the reason.
void ReportChoices::adaptToMesh() {
  for (int row = 0; row < algorithms_->count(); ++row) {
    QListWidgetItem* item = algorithms_->item(row);
    const auto algorithm = Algorithm(item->data(Qt::UserRole).toInt());
    QString help = text(info(algorithm).source);
    try {
      check(algorithm, *document_.mesh());
      item->setFlags(item->flags() | Qt::ItemIsEnabled);
    } catch (const Error& error) {
      item->setFlags(item->flags() & ~Qt::ItemIsEnabled);
      help = QString::fromStdString(error.what());
    }
    item->setToolTip(help);
  }
}

void ReportChoices::adaptToLastDrag() {
  const bool there = !document_.moves().lastDrag().empty();
  enable(drags_, lastDrag, there);
  if (!there) {
    drags_->setCurrentIndex(generatedDrags);
  }
}

std::vector<Algorithm> ReportChoices::chosen() const {
  std::vector<Algorithm> algorithms;
  for (int row = 0; row < algorithms_->count(); ++row) {
    const QListWidgetItem* item = algorithms_->item(row);
    if (item->checkState() == Qt::Checked && (item->flags() & Qt::ItemIsEnabled) != 0) {
      algorithms.push_back(Algorithm(item->data(Qt::UserRole).toInt()));
    }
  }
  return algorithms;
}

ReportThread::Order ReportChoices::order() const {
  ReportThread::Order order;
  order.object = {document_.name().toStdString(),
                  "the object of the window, from rest",
                  document_.mesh(),
                  document_.cuts().links(),
                  document_.pins(),
                  *document_.wholeSoftness(),
                  {}};
  order.generateDrags = drags_->currentIndex() == generatedDrags;
  if (!order.generateDrags) {
    order.object.drags.push_back({"my last drag", "the last drag in the window", document_.moves().lastDrag()});
  }
  order.options.algorithms = chosen();
  order.options.sweeps = sweeps_->currentIndex() == 0   ? std::vector{0}
                         : sweeps_->currentIndex() == 1 ? std::vector{sweepsPerMove}
                                                        : std::vector{0, sweepsPerMove};
  order.options.equilibrium = sweeps_->currentIndex() == withEquilibrium;
  if (const RelaxationScheme scheme = document_.relaxation().scheme; info(scheme).sweeps) {
    order.options.scheme = scheme;
  }
  order.options.relax_step = document_.relaxation().step;
  order.options.precision = precision_->currentIndex() == 0 ? Precision::single_precision : Precision::double_precision;
  order.options.seconds = seconds_->value();
  return order;
}

ReportDock::ReportDock(Document& document)
    : choices_(new ReportChoices(document)),
      results_(new ReportResults),
      thread_(new ReportThread(this)),
      run_(new QPushButton(QStringLiteral("Run"))),
      cancel_(new QPushButton(QStringLiteral("Cancel"))),
      progress_(new QProgressBar),
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
  run_->setObjectName(QStringLiteral("reportRun"));
  run_->setAccessibleName(QStringLiteral("Run the comparison"));
  run_->setToolTip(QStringLiteral("Runs the drags on the present object with the chosen algorithms, from rest"));
  cancel_->setObjectName(QStringLiteral("reportCancel"));
  cancel_->setAccessibleName(QStringLiteral("Cancel the comparison"));
  cancel_->setToolTip(QStringLiteral("Cancels the run; the last results stay"));
  progress_->setObjectName(QStringLiteral("reportProgress"));
  progress_->setAccessibleName(QStringLiteral("Progress of the comparison"));
  progress_->setToolTip(QStringLiteral("Share of the run that is done, and the present drag"));
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
  connect(cancel_, &QPushButton::clicked, this, &ReportDock::cancel);
  connect(choices_, &ReportChoices::changed, this, &ReportDock::showState);
  connect(results_, &ReportResults::saved, this, &ReportDock::saved);
  connect(results_, &ReportResults::failed, this, &ReportDock::failed);
  connect(thread_, &ReportThread::progressed, this, &ReportDock::showProgress);
  connect(thread_, &ReportThread::finished, this, [this](const ReportThread::Result& result) {
    results_->show(result);
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
  showState();
  showProgress(0, QStringLiteral("starting"));
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
  empty_->setText(running ? QStringLiteral("Comparing the time and the error of each algorithm on this object…")
                          : QStringLiteral("Press Run to compare the time and the error of each algorithm on this "
                                           "object."));
  if (!running) {
    fillBar(0, QStringLiteral("ready"));
  }
}

void ReportDock::showProgress(double fraction, const QString& text) {
  // Painting the window disturbs the times that are measured.
  if (sinceShown_.isValid() && sinceShown_.elapsed() < reportProgressMilliseconds && text == textShown_) {
    return;
  }
  sinceShown_.start();
  textShown_ = text;
  fillBar(int(reportProgressSteps * fraction),
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
