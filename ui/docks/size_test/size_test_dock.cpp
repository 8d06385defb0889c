#include "docks/size_test/size_test_dock.h"

#include <QBoxLayout>
#include <QClipboard>
#include <QGuiApplication>
#include <QLabel>
#include <QTimer>

#include "common/ask_where.h"
#include "common/dock_scroll.h"
#include "common/icons.h"
#include "common/table_text.h"
#include "files/text/outputs.h"
#include "mesh/error.h"

namespace chainmail {
namespace {

constexpr int sizeControlsWidth = 230;
constexpr int sizeHeight = 280;
constexpr int sizeProgressSteps = 1000;
constexpr int sizeProgressMilliseconds = 150;
constexpr int retireMilliseconds = 20;

/// Gives the dock its height: a dock at the bottom is as tall as the size hint of its content.
class SizeTestContent : public QWidget {
 public:
  QSize sizeHint() const override { return {QWidget::sizeHint().width(), sizeHeight}; }
};

}  // namespace

SizeTestDock::SizeTestDock(QMainWindow& window, const Document& document, QWidget& area, Contestants inSight)
    : window_(window),
      document_(document),
      area_(area),
      inSight_(std::move(inSight)),
      choices_(new SizeTestChoices),
      results_(new SizeTestResults),
      run_(new QPushButton(icon("grow"), QStringLiteral("Size test"))),
      cancel_(new QPushButton(QStringLiteral("Cancel"))),
      copy_(new QPushButton(icon("copy"), QStringLiteral("Copy table"))),
      save_(new QPushButton(icon("save"), QStringLiteral("Save…"))),
      progress_(new QProgressBar),
      escape_(new QShortcut(Qt::Key_Escape, &window)) {
  auto* note = new QLabel(QStringLiteral("The window runs on the same machine, so these times are not exact."));
  note->setToolTip(QStringLiteral("For exact times, run 'chainmail ramp' on an idle machine"));
  note->setEnabled(false);
  auto* below = new QHBoxLayout;
  below->addWidget(note, 1);
  below->addWidget(copy_);
  below->addWidget(save_);
  auto* right = new QVBoxLayout;
  right->setSpacing(3);
  right->addWidget(results_, 1);
  right->addLayout(below);
  auto* content = new SizeTestContent;
  auto* row = new QHBoxLayout(content);
  row->setContentsMargins(6, 4, 6, 2);
  row->addWidget(makeControls());
  row->addLayout(right, 1);
  setWidget(new DockScroll(content));
  // Closing the dock cancels the test.
  connect(toggleViewAction(), &QAction::toggled, this, [this](bool shown) { shown ? void() : cancel(); });
  // An empty table shows the current panels.
  connect(this, &QDockWidget::visibilityChanged, this, [this](bool seen) { seen ? followPanels() : void(); });
  for (const auto& changed : {&Document::panelsChanged, &Document::meshChanged}) {
    connect(&document, changed, this, &SizeTestDock::followPanels,
            Qt::QueuedConnection);  // after the panels have changed
  }
  connect(&document, &Document::algorithmChanged, this, &SizeTestDock::followPanels);
  connect(escape_, &QShortcut::activated, this, &SizeTestDock::cancel);
  followPanels();
  showState();
}

void SizeTestDock::followPanels() {
  if (!running() && results_->rows().empty()) {
    results_->begin(inSight_(), choices_->options().budget);
    results_->setGrowing(false);
  }
  offerRun();
}

void SizeTestDock::offerRun() {
  const bool any = !inSight_().empty();
  run_->setEnabled(!running() && any);
  run_->setToolTip(any ? run_->accessibleName()
                       : QStringLiteral("Only ChainMail algorithms can be tested: choose one in a visible panel"));
}

SizeTestDock::~SizeTestDock() = default;

QWidget* SizeTestDock::makeControls() {
  const auto name = [](QWidget* widget, const char* object, const QString& help) {
    widget->setObjectName(QLatin1String(object));
    widget->setAccessibleName(help);
    widget->setToolTip(help);
  };
  name(run_, "sizeTestRun",
       QStringLiteral("Grows and drags a grid in the visible panels, until each one is slower than real time"));
  name(cancel_, "sizeTestCancel",
       QStringLiteral("Cancels the test (Esc); the results stay, and your object is shown again"));
  name(progress_, "sizeTestProgress", QStringLiteral("Share of the sizes that are done, and the present size"));
  name(copy_, "sizeTestCopy", QStringLiteral("Copies the table, with tabs between columns"));
  name(save_, "sizeTestSave",
       QStringLiteral("Saves the table as CSV with all digits, one row for each size and panel"));
  progress_->setRange(0, sizeProgressSteps);
  connect(run_, &QPushButton::clicked, this, &SizeTestDock::start);
  connect(cancel_, &QPushButton::clicked, this, &SizeTestDock::cancel);
  connect(copy_, &QPushButton::clicked, this,
          [this] { QGuiApplication::clipboard()->setText(textOf(results_->table())); });
  connect(save_, &QPushButton::clicked, this, &SizeTestDock::saveTable);
  auto* controls = new QWidget;
  controls->setFixedWidth(sizeControlsWidth);
  auto* column = new QVBoxLayout(controls);
  column->setContentsMargins(0, 0, 0, 0);
  column->setSpacing(4);
  column->addWidget(choices_);
  column->addStretch(1);
  auto* buttons = new QHBoxLayout;
  buttons->addWidget(run_);
  buttons->addWidget(cancel_);
  column->addLayout(buttons);
  column->addWidget(progress_);
  return controls;
}

void SizeTestDock::start() {
  const auto contestants = inSight_();
  if (running() || contestants.empty()) {
    return;
  }
  SizeTestOptions options = choices_->options();
  options.softness = {document_.softness(), {}, document_.wholeSoftness()->energy};
  results_->begin(contestants, options.budget);
  stage_ = new SizeTestStage(options, contestants);
  listen(*stage_);
  auto* layout = qobject_cast<QBoxLayout*>(area_.parentWidget()->layout());
  layout->insertWidget(layout->indexOf(&area_), stage_, 1);
  area_.hide();
  stage_->show();
  rest_ = std::make_unique<WindowRest>(window_, *this, QStringList{QStringLiteral("quit")});
  showState();
  stage_->start();
}

void SizeTestDock::listen(const SizeTestStage& stage) {
  connect(&stage, &SizeTestStage::measured, results_, &SizeTestResults::add);
  connect(&stage, &SizeTestStage::progressed, this, &SizeTestDock::showProgress);
  connect(&stage, &SizeTestStage::ended, this, &SizeTestDock::leave);
  connect(&stage, &SizeTestStage::failed, this, [this](const QString& sentence) {
    leave();
    emit failed(sentence);
  });
}

void SizeTestDock::cancel() {
  if (running()) {
    stage_->halt();
    leave();
  }
}

/// Shows the user's panels at once. The stage is deleted when its solvers are idle.
void SizeTestDock::leave() {
  SizeTestStage* stage = std::exchange(stage_, nullptr).data();
  disconnect(stage, nullptr, this, nullptr);
  disconnect(stage, nullptr, results_, nullptr);
  stage->hide();
  area_.show();
  rest_.reset();
  results_->setGrowing(false);
  showState();
  retire(stage);
}

/// Deletes the stage as soon as its solvers are idle. Does not wait, because a pass may take long.
void SizeTestDock::retire(SizeTestStage* stage) {
  QTimer::singleShot(retireMilliseconds, stage,
                     [this, stage] { stage->idle() ? stage->deleteLater() : retire(stage); });
}

void SizeTestDock::showState() {
  choices_->setEnabled(!running());
  offerRun();
  cancel_->setEnabled(running());
  escape_->setEnabled(running());
  const bool empty = results_->rows().empty();
  copy_->setEnabled(!empty);
  save_->setEnabled(!empty && !running());
  progress_->setEnabled(running());
  if (!running()) {
    fillBar(0, QStringLiteral("ready"));
  }
}

void SizeTestDock::showProgress(double share, const QString& text) {
  // Painting the window disturbs the times that are measured.
  if (sinceShown_.isValid() && sinceShown_.elapsed() < sizeProgressMilliseconds) {
    return;
  }
  sinceShown_.start();
  copy_->setEnabled(!results_->rows().empty());
  fillBar(int(sizeProgressSteps * share), text);
}

void SizeTestDock::fillBar(int value, const QString& text) {
  // setValue() would repaint the bar at once, and the whole window with it.
  progress_->setUpdatesEnabled(false);
  progress_->setValue(value);
  progress_->setFormat(text);
  progress_->setUpdatesEnabled(true);
}

void SizeTestDock::saveTable() {
  const QString path = askWhere(*this, QStringLiteral("Save the table"),
                                {QStringLiteral("Comma-separated values (*.csv)")}, QStringLiteral("size-test"));
  if (!path.isEmpty()) {
    saveTablePath(path);
  }
}

void SizeTestDock::saveTablePath(const QString& path) {
  try {
    write_file(std::filesystem::path(path.toStdU16String()),
               [this](std::ostream& out) { writeCsv(out, results_->rows()); });
    emit saved(path);
  } catch (const Error& error) {
    emit failed(QString::fromStdString(error.what()));
  }
}

}  // namespace chainmail
