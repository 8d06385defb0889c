#include "docks/size_test/size_test_stage.h"

#include <QGridLayout>
#include <algorithm>

#include "mesh/generate.h"

namespace chainmail {
namespace {

MeshRecipe gridOf(std::uint32_t width) { return {MeshKind::grid, {width, width, 1}, 1, {}}; }

QString sizeOf(std::uint32_t width) { return QStringLiteral("%1×%1").arg(width); }

}  // namespace

SizeTestStage::SizeTestStage(const SizeTestOptions& options, const std::vector<SizeTestContestant>& contestants)
    : options_(options), widths_(widthsOf(options)) {
  setObjectName(QStringLiteral("sizeTestStage"));
  auto* grid = new QGridLayout(this);  // two in a row, as the panels
  grid->setContentsMargins(0, 0, 0, 0);
  grid->setSpacing(3);
  const MeshPointer none = generate(gridOf(2));
  for (const SizeTestContestant& contestant : contestants) {
    auto* panel = new SizeTestPanel(contestant, options.softness, none, levels_);
    const int place = int(panels_.size());
    panels_.push_back(panel);
    grid->addWidget(panel, place / 2, place % 2);
    grid->setColumnStretch(place % 2, 1);
    connect(panel, &SizeTestPanel::moved, this, &SizeTestStage::showProgress);
    connect(panel, &SizeTestPanel::ended, this, &SizeTestStage::receiveEnd);
    connect(panel, &SizeTestPanel::failed, this, &SizeTestStage::stopFor);
  }
  racing_ = panels_;
  connect(&jobs_, &Jobs::failed, this, &SizeTestStage::stopFor);
}

void SizeTestStage::start() {
  size_ = 0;
  build();
}

void SizeTestStage::halt() {
  halted_ = true;
  jobs_.cancel();
  for (SizeTestPanel* panel : panels_) {
    panel->halt();
  }
}

bool SizeTestStage::idle() const {
  return std::ranges::all_of(panels_, [](const SizeTestPanel* panel) { return panel->idle(); });
}

void SizeTestStage::stopFor(const QString& sentence) {
  if (!halted_) {
    halt();
    emit failed(sentence);
  }
}

/// In the background: a large grid takes longer than a frame.
void SizeTestStage::build() {
  if (size_ == widths_.size() || racing_.empty()) {
    halt();
    emit ended();
    return;
  }
  const std::uint32_t width = widths_[size_];
  emit progressed(double(size_) / double(widths_.size()), QStringLiteral("%1, building").arg(sizeOf(width)));
  jobs_.start(Jobs::Kind::load, QStringLiteral("Building %1").arg(sizeOf(width)),
              [this, width](const Progress& progress) -> Jobs::Finish {
                const MeshPointer mesh = generate(gridOf(width), progress);
                return [this, mesh, whole = wholeLevel(mesh)] {
                  mesh_ = mesh;
                  levels_->await(whole);
                  rows_.clear();
                  attempt(0, racing_);
                };
              });
}

void SizeTestStage::attempt(int number, const std::vector<SizeTestPanel*>& panels) {
  attempt_ = number;
  running_ = panels;
  const std::uint64_t seed = report::ramp_seed(options_.seed, widths_[size_], number);
  const auto drags = report::hand_drags(*mesh_, seed, options_.drags + 1, options_.moves);
  for (SizeTestPanel* panel : panels) {
    panel->say(sizeOf(widths_[size_]) + (number == 0 ? QString() : QStringLiteral(", once more")));
    panel->begin(mesh_, drags);
  }
}

void SizeTestStage::receiveEnd() {
  if (!halted_ && std::ranges::none_of(running_, &SizeTestPanel::running)) {
    judge();
  }
}

void SizeTestStage::judge() {
  std::vector<SizeTestPanel*> missed;
  for (SizeTestPanel* panel : running_) {
    const SizeTestContestant& one = panel->contestant();
    SizeTestRow row{one.panel,
                    report::ramp_row(*mesh_, widths_[size_], one.algorithm, panel->passes(), options_.budget),
                    panel->painted()};
    row.figures.repeated = attempt_ > 0;
    if (!row.figures.in_real_time && attempt_ == 0) {
      missed.push_back(panel);
      continue;
    }
    rows_.push_back(row);
    if (!row.figures.in_real_time) {
      panel->say(QStringLiteral("real time lost at %1").arg(sizeOf(widths_[size_])));
      std::erase(racing_, panel);
    }
  }
  missed.empty() ? goOn() : attempt(1, missed);
}

void SizeTestStage::goOn() {
  std::ranges::sort(rows_, {}, &SizeTestRow::panel);
  for (const SizeTestRow& row : rows_) {
    emit measured(row);
  }
  ++size_;
  build();
}

void SizeTestStage::showProgress() {
  double share = 1;
  for (const SizeTestPanel* panel : running_) {
    share = std::min(share, panel->running() ? panel->share() : 1);
  }
  emit progressed((double(size_) + (attempt_ == 0 ? share : 1)) / double(widths_.size()),
                  sizeOf(widths_[size_]) + (attempt_ == 0 ? QString() : QStringLiteral(", once more")));
}

}  // namespace chainmail
