#include "docks/size_test/size_test_stage.h"

#include <QGridLayout>
#include <algorithm>

#include "drawing/prepared_levels.h"
#include "mesh/generate.h"

namespace chainmail {
namespace {

MeshRecipe gridOf(std::uint32_t width) { return {MeshKind::grid, {width, width, 1}, 1, {}}; }

std::vector<Algorithm> algorithmsOf(const std::vector<SizeTestContestant>& contestants) {
  std::vector<Algorithm> algorithms;
  algorithms.reserve(contestants.size());
  for (const SizeTestContestant& contestant : contestants) {
    algorithms.push_back(contestant.algorithm);
  }
  return algorithms;
}

}  // namespace

SizeTestStage::SizeTestStage(const SizeTestOptions& options, const std::vector<SizeTestContestant>& contestants)
    : options_(options), race_(widthsOf(options), algorithmsOf(contestants), options.budget) {
  setObjectName(QStringLiteral("sizeTestStage"));
  auto* grid = new QGridLayout(this);  // two panels per row, as in the window
  grid->setContentsMargins(0, 0, 0, 0);
  grid->setSpacing(3);
  const MeshPointer none = generate(gridOf(2));
  for (const SizeTestContestant& contestant : contestants) {
    auto* panel = new SizeTestPanel(contestant, options.softness, none, levels_);
    const int index = int(panels_.size());
    panels_.push_back(panel);
    grid->addWidget(panel, index / 2, index % 2);
    grid->setColumnStretch(index % 2, 1);
    connect(panel, &SizeTestPanel::moved, this, &SizeTestStage::showProgress);
    connect(panel, &SizeTestPanel::ended, this, &SizeTestStage::receiveEnd);
    connect(panel, &SizeTestPanel::failed, this, &SizeTestStage::stopFor);
  }
  connect(&jobs_, &Jobs::failed, this, &SizeTestStage::stopFor);
}

void SizeTestStage::start() { build(); }

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

/// Builds the next grid in the background, because building a large one takes longer than a frame.
void SizeTestStage::build() {
  if (race_.is_over()) {
    halt();
    emit ended();
    return;
  }
  const std::uint32_t width = race_.width();
  emit progressed(race_.share(), QStringLiteral("%1, building").arg(sizeText(width)));
  jobs_.start(Jobs::Kind::load, QStringLiteral("Building %1").arg(sizeText(width)),
              [this, width](const Progress& progress) -> Jobs::Finish {
                const MeshPointer mesh = generate(gridOf(width), progress.part(0, 0.8));
                prepareLevels(mesh, progress.part(0.8, 1));
                return [this, mesh] {
                  mesh_ = mesh;
                  attempt();
                };
              });
}

std::vector<SizeTestPanel*> SizeTestStage::attempting() const {
  std::vector<SizeTestPanel*> panels;
  for (const std::size_t contestant : race_.attempting()) {
    panels.push_back(panels_[contestant]);
  }
  return panels;
}

QString SizeTestStage::sizeInWords() const {
  return sizeText(race_.width()) + (race_.attempt() == 0 ? QString() : QStringLiteral(", second attempt"));
}

void SizeTestStage::attempt() {
  const std::uint64_t seed = report::ramp_seed(options_.seed, race_.width(), race_.attempt());
  const auto drags = report::scripted_drags(*mesh_, seed, options_.drags + 1, options_.moves);
  for (SizeTestPanel* panel : attempting()) {
    panel->say(sizeInWords());
    panel->begin(mesh_, drags);
  }
}

void SizeTestStage::receiveEnd() {
  if (!halted_ && std::ranges::none_of(attempting(), &SizeTestPanel::running)) {
    judge();
  }
}

void SizeTestStage::judge() {
  std::vector<report::RampPasses> passes;
  for (const SizeTestPanel* panel : attempting()) {
    passes.push_back(panel->passes());
  }
  const auto results = race_.finish_attempt(*mesh_, passes);
  if (results.empty()) {
    attempt();
    return;
  }
  for (const auto& [contestant, row] : results) {
    SizeTestPanel* panel = panels_[contestant];
    if (!row.in_real_time) {
      panel->say(QStringLiteral("real time lost at %1").arg(sizeText(row.width)));
    }
    emit measured({panel->contestant().panel, row, panel->painted()});
  }
  build();
}

void SizeTestStage::showProgress() {
  double share = 1;
  for (const SizeTestPanel* panel : attempting()) {
    share = std::min(share, panel->running() ? panel->share() : 1);
  }
  emit progressed(race_.share() + (race_.attempt() == 0 ? share : 1) / double(race_.sizes()), sizeInWords());
}

}  // namespace chainmail
