#include "document/propagation.h"

#include <algorithm>

#include "solver/algorithms.h"

namespace chainmail {
namespace {

constexpr int fetchMilliseconds = 100;
constexpr int tickMilliseconds = 16;
constexpr std::uint64_t largestWhileDragged = 20'000;  // steps
// Fetching passes takes at most 1/10 of the time.
constexpr int fetchShare = 10;

}  // namespace

PassPlayer::PassPlayer(std::unique_ptr<RecordedPass> pass, const Statistics& statistics)
    : pass_(std::move(pass)),
      history_(stepCount() <= listedSteps ? waiting_history(*pass_) : WaitingHistory()),
      updatedAt_(pass_->mesh->element_count(), never) {
  for (const ElementId pin : pass_->conditions->pins) {
    updatedAt_[pin] = 0;
  }
  for (const ElementId element : pass_->handle) {
    updatedAt_[element] = 0;
  }
  for (std::uint32_t row = 0; row < pass_->trace.size(); ++row) {
    updatedAt_[pass_->trace[row].element] = row + 1;
  }
  frame_.mesh = pass_->mesh;
  frame_.space = FrameSpace(*pass_->mesh);
  frame_.positions = pass_->before;
  for (float& coordinate : frame_.positions) {
    coordinate /= float(frame_.space.unit());
  }
  frame_.changed.assign(ElementBlocks(pass_->mesh->element_count()).block_count(), 1);
  frame_.statistics = statistics;
  frame_.series = new_series();
  frame_.number = 1;
  for (std::size_t i = 0; i < pass_->handle.size(); ++i) {
    move(pass_->handle[i], pass_->handle_after(i));
  }
  setStep(stepCount());
}

void PassPlayer::setStep(std::size_t step) {
  step = std::min(step, stepCount());
  ++frame_.number;
  for (; step_ < step; ++step_) {
    move(pass_->trace[step_].element, pass_->position_after(step_));
  }
  for (; step_ > step; --step_) {
    const ElementId element = pass_->trace[step_ - 1].element;
    move(element, pass_->position_before(element));
  }
}

void PassPlayer::move(ElementId element, std::span<const float> to) {
  std::ranges::transform(to, frame_.positions.begin() + std::ptrdiff_t(element * to.size()),
                         [unit = float(frame_.space.unit())](float coordinate) { return coordinate / unit; });
  frame_.changed[element / Frame::block_elements] = frame_.number;
}

Propagation::Propagation(Document& document) : document_(document), players_(Document::maxPanels) {
  fetch_.setSingleShot(true);
  connect(&fetch_, &QTimer::timeout, this, &Propagation::takePasses);
  clock_.setInterval(tickMilliseconds);
  connect(&clock_, &QTimer::timeout, this, &Propagation::playOn);
  connect(&document.solvers(), &PanelSolvers::frameReady, this, &Propagation::awaitPass);
  connect(&document.highlight(), &Highlight::changed, this, [this] {
    if (document_.highlight().marks().grabbed) {
      setShowsNewest(true);
    }
    awaitPass();
  });
  connect(&document.undoStack(), &QUndoStack::indexChanged, this, [this] { setShowsNewest(true); });
  connect(&document, &Document::meshChanged, this, &Propagation::forget);
  connect(&document, &Document::panelLeaves, this, &Propagation::forget);
  connect(&document, &Document::panelsChanged, this, &Propagation::forget);
  connect(&document, &Document::algorithmChanged, this, [this](int panel) {
    setShowsNewest(true);
    players_[std::size_t(panel)].reset();
    emit changed();
  });
}

Propagation::~Propagation() {
  players_.clear();
  players_.resize(Document::maxPanels);
  emit changed();  // widgets that show the passes are deleted later
}

void Propagation::setOpen(bool open) {
  if (open != open_ && !held_) {
    open_ = open;
    document_.solvers().recordPasses(open);
    forget();
  }
}

void Propagation::setShown(bool shown) {
  if (shown == shown_ || held_) {
    return;
  }
  shown_ = shown;
  clock_.stop();
  if (!showsNewest_) {
    for (int panel = 0; panel < document_.panels(); ++panel) {
      show(panel);
    }
  }
  awaitPass();
  emit changed();
}

void Propagation::forget() {
  letGo();
  showsNewest_ = true;
  chosen_ = std::min(chosen_, Document::minPanels - 1);  // other panels may be removed
  for (auto& player : players_) {
    player.reset();
  }
  emit changed();
}

void Propagation::setShowsNewest(bool newest) {
  if (!open_ || newest == showsNewest_ || (!newest && !hasPass())) {
    return;
  }
  showsNewest_ = newest;
  if (newest) {
    letGo();
    awaitPass();
  } else {
    for (int panel = 0; panel < document_.panels(); ++panel) {
      show(panel);
    }
  }
  emit changed();
}

/// Stops the playback, so that the panels show their newest frames again.
void Propagation::letGo() {
  clock_.stop();
  for (int panel = 0; panel < document_.panels(); ++panel) {
    if (auto& player = players_[std::size_t(panel)]) {
      player->setStep(player->stepCount());
    }
    document_.solvers().showInstead(panel, nullptr);
  }
}

void Propagation::awaitPass() {
  if (isShown() && (showsNewest_ || lacksPass()) && !fetch_.isActive()) {
    fetch_.start(fetchMilliseconds);
  }
}

/// True while a drag makes passes so large that fetching them would slow the drag down.
bool Propagation::tooLargeNow() const {
  for (int panel = 0; panel < document_.panels() && document_.highlight().marks().grabbed; ++panel) {
    const Frame* frame = document_.solvers().frame(panel);
    if (frame != nullptr && frame->statistics.last_pass.checked > largestWhileDragged) {
      return true;
    }
  }
  return false;
}

void Propagation::takePasses() {
  if (!isShown() || tooLargeNow()) {
    return;
  }
  const std::size_t step = position();
  QElapsedTimer clock;
  clock.start();
  bool any = false;
  for (int panel = 0; panel < document_.panels(); ++panel) {
    auto& player = players_[std::size_t(panel)];
    if (player && !showsNewest_) {
      continue;
    }
    const Frame* frame = document_.solvers().frame(panel);
    auto pass = document_.solvers().lastPass(panel, player ? player->pass().number : 0);
    // Elastic methods solve for all elements at once: they have no steps.
    const bool stepped = pass && info(pass->algorithm).has_steps();
    if (stepped && frame != nullptr && pass->mesh == frame->mesh && pass->algorithm == document_.algorithm(panel)) {
      player = std::make_unique<PassPlayer>(std::move(pass), frame->statistics);
      any = true;
      if (!showsNewest_ && together_) {
        player->setStep(step);
        show(panel);
      }
    }
  }
  if (any) {
    fetch_.setInterval(std::max(fetchMilliseconds, fetchShare * int(clock.elapsed())));
    emit changed();
  }
}

bool Propagation::hasPass() const {
  return std::any_of(players_.begin(), players_.end(), [](auto& player) { return player != nullptr; });
}

/// True if the first pass of a panel is not there yet. The steps of another panel may have been shown before it came.
bool Propagation::lacksPass() const {
  for (int panel = 0; panel < document_.panels(); ++panel) {
    if (!players_[std::size_t(panel)] && info(document_.algorithm(panel)).has_steps()) {
      return true;
    }
  }
  return false;
}

std::size_t Propagation::stepCount() const {
  std::size_t count = 0;
  for (const auto& player : players_) {
    count = std::max(count, player ? player->stepCount() : 0);
  }
  return count;
}

void Propagation::setTogether(bool together) {
  together_ = together;
  emit changed();
}

void Propagation::choose(int panel) {
  if (panel != chosen_) {
    chosen_ = panel;
    emit changed();
  }
}

void Propagation::setStep(int panel, std::size_t step) {
  if (!open_ || !hasPass()) {
    return;
  }
  showsNewest_ = false;
  chosen_ = panel;
  for (int one = 0; one < document_.panels(); ++one) {
    if (auto& player = players_[std::size_t(one)]; player && (together_ || one == panel)) {
      player->setStep(step);
    }
    show(one);
  }
  emit changed();
}

void Propagation::show(int panel) {
  const auto& player = players_[std::size_t(panel)];
  document_.solvers().showInstead(panel, player && isShown() ? &player->frame() : nullptr);
}

/// Returns the step from which the buttons continue.
std::size_t Propagation::position() const {
  std::size_t position = 0;
  for (int panel = 0; panel < document_.panels(); ++panel) {
    const auto& player = players_[std::size_t(panel)];
    if (player && (together_ || panel == chosen_)) {
      position = std::max(position, player->step());
    }
  }
  return position;
}

bool Propagation::atEnd() const {
  const auto& player = players_[std::size_t(chosen_)];
  return position() >= (together_ ? stepCount() : player ? player->stepCount() : 0);
}

void Propagation::stepBy(std::ptrdiff_t steps) {
  const auto from = std::ptrdiff_t(position());
  goTo(std::size_t(std::max<std::ptrdiff_t>(0, from + steps)));
}

void Propagation::setPlays(bool plays) {
  if (!plays || !hasPass()) {
    clock_.stop();
  } else if (!clock_.isActive()) {
    if (atEnd()) {
      goTo(0);
    }
    due_ = 0;
    sinceStep_.start();
    clock_.start();
  }
  emit changed();
}

/// Makes the steps that are due after the elapsed time.
void Propagation::playOn() {
  due_ += double(sinceStep_.restart()) / 1000 * speed_;
  if (due_ < 1) {
    return;
  }
  const auto steps = std::ptrdiff_t(due_);
  due_ -= double(steps);
  stepBy(steps);
  if (atEnd()) {
    setPlays(false);
  }
}

}  // namespace chainmail
