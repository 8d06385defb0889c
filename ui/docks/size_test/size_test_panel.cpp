#include "docks/size_test/size_test_panel.h"

#include <QHBoxLayout>
#include <QVBoxLayout>

#include "common/announce.h"
#include "common/panel_names.h"
#include "common/text.h"

namespace chainmail {
namespace {

// Slow drawing slows the drags down. After this time, `minDrags` measured drags are enough for a size.
constexpr qint64 enoughMilliseconds = 8000;
constexpr std::size_t minDrags = 2;

}  // namespace

SizeTestPanel::SizeTestPanel(const SizeTestContestant& contestant, const Softness& softness, const MeshPointer& mesh,
                             std::shared_ptr<MeshLevels> levels)
    : contestant_(contestant),
      view_(new SizeTestView(std::move(levels), contestant.colour)),
      state_(new QLabel),
      solver_(mesh, contestant.algorithm, [this] { announceOnce(announced_, this, &SizeTestPanel::receive); }) {
  solver_.post(commands::SetSoftness{softness});
  state_->setObjectName(QStringLiteral("sizeTestState%1").arg(contestant.panel));
  view_->setObjectName(QStringLiteral("sizeTestView%1").arg(contestant.panel));
  connect(view_, &SizeTestView::failed, this, &SizeTestPanel::failed);
  arrange();
}

/// Arranges the panel so that it looks like the panels that it replaces.
void SizeTestPanel::arrange() {
  auto* swatch = new QLabel;
  swatch->setFixedSize(10, 10);
  followTheme(*this, [swatch, colour = contestant_.colour] {
    swatch->setStyleSheet(QStringLiteral("background:%1; border-radius:5px").arg(QColor(colour).name()));
  });
  auto* head = new QHBoxLayout;
  head->setContentsMargins(8, 6, 8, 6);
  head->setSpacing(8);
  head->addWidget(swatch);
  auto* name = new QLabel(
      QStringLiteral("<b>%1</b>&nbsp; %2").arg(panelName(contestant_.panel), text(info(contestant_.algorithm).label)));
  name->setTextFormat(Qt::RichText);
  head->addWidget(name);
  head->addWidget(state_, 1, Qt::AlignRight);
  auto* column = new QVBoxLayout(this);
  column->setContentsMargins(0, 0, 0, 0);
  column->setSpacing(0);
  column->addLayout(head);
  column->addWidget(view_, 1);
}

void SizeTestPanel::begin(const MeshPointer& mesh, std::vector<report::ScriptedDrag> drags) {
  drags_ = std::move(drags);
  drag_ = move_ = 0;
  moving_ = false;
  running_ = true;
  passes_ = {};
  clock_.start();
  if (mesh != mesh_) {
    mesh_ = mesh;
    solver_.post(commands::ReplaceMesh{mesh});  // the drags start with the first frame of the mesh
  } else {
    next();
  }
}

double SizeTestPanel::share() const {
  return drags_.empty() ? 0
                        : double(drag_) / double(drags_.size()) +
                              (drag_ < drags_.size() ? double(move_) / double(drags_[drag_].targets.size()) : 0) /
                                  double(drags_.size());
}

void SizeTestPanel::receive() {
  announced_ = false;
  const Frame& frame = solver_.latest_frame();
  if (const std::string error = solver_.take_error(); !error.empty()) {
    halt();
    emit failed(QString::fromStdString(error));
  }
  const bool holds = running_ && frame.mesh == mesh_;
  view_->show(frame, holds ? std::optional(drags_[drag_].element) : std::nullopt);
  if (!holds || (moving_ && frame.statistics.passes == passesSeen_)) {
    return;
  }
  passesSeen_ = frame.statistics.passes;
  if (moving_) {
    record(frame.statistics);
  }
  next();
}

void SizeTestPanel::record(const Statistics& statistics) {
  if (drag_ > 0) {  // the first drag is the warm-up, which allocates the memory
    passes_.ms.push_back(statistics.last_pass_ms);
    passes_.moved += statistics.last_pass.moved;
  }
  emit moved();
}

void SizeTestPanel::next() {
  if (move_ == drags_[drag_].targets.size()) {
    solver_.post(commands::Release{});
    move_ = 0;
    const bool enough = ++drag_ > minDrags && clock_.elapsed() > enoughMilliseconds;
    if (enough || drag_ == drags_.size()) {
      halt();
      painted_ = view_->meter().framesPerSecond();
      emit ended();
      return;
    }
  }
  const report::ScriptedDrag& drag = drags_[drag_];
  if (move_ == 0) {
    solver_.post(commands::Reset{});
    solver_.post(commands::Grab{drag.element});
  }
  solver_.post(commands::Drag{drag.targets[move_++]});
  moving_ = true;
}

}  // namespace chainmail
