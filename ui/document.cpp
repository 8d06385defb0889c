#include "document.h"

#include <algorithm>

#include "edits.h"

namespace chainmail {
namespace {

constexpr int samplingMilliseconds = 16;
// Some steps keep all positions, 16 MB a panel at a million elements.
constexpr int undoSteps = 30;

}  // namespace

Document::Document(MeshPointer mesh, const QString& name) : mesh_(std::move(mesh)), name_(name), cuts_(mesh_) {
  std::vector<SolverThread*> all;
  for (int panel = 0; panel < panels; ++panel) {
    solvers_[panel] = std::make_unique<SolverThread>(mesh_, algorithms_[panel], [this, panel] {
      if (!announced_[panel].exchange(true)) {
        QMetaObject::invokeMethod(
            this, [this, panel] { receiveFrame(panel); }, Qt::QueuedConnection);
      }
    });
    frames_[panel] = &solvers_[panel]->latest_frame();
    all.push_back(solvers_[panel].get());
  }
  log_ = std::make_unique<CommandLog>(all);
  undoStack_.setUndoLimit(undoSteps);
  sampler_.setTimerType(Qt::PreciseTimer);
  sampler_.setInterval(samplingMilliseconds);
  connect(&sampler_, &QTimer::timeout, this, [this] {
    if (!log_->waits()) {
      sampler_.stop();
    }
    log_->sample();
  });
}

Document::~Document() {
  undoStack_.blockSignals(true);  // who listened is half gone
  undoStack_.clear();
}

bool Document::idle() const {
  return !log_->waits() && std::all_of(solvers_.begin(), solvers_.end(), [](auto& one) { return one->idle(); });
}

void Document::receiveFrame(int panel) {
  announced_[panel] = false;
  frames_[panel] = &solvers_[panel]->latest_frame();
  if (const std::string error = solvers_[panel]->take_error(); !error.empty()) {
    emit refused(QString::fromStdString(error));
  }
  emit frameReady(panel);
}

void Document::grab(ElementId element) { post(commands::Grab{element}); }

void Document::drag(const Point& target) { post(commands::Drag{target}); }

void Document::post(const Command& command) {
  log_->post(command);
  // The first sampled command of a while goes at once, later ones 60 times a second.
  if (log_->waits() && !sampler_.isActive()) {
    log_->sample();
    sampler_.start();
  }
}

void Document::release() { post(commands::Release{}); }

void Document::setSoftness(const LinkSoftness& softness, const QString& text, int gesture) {
  if (softness != softness_.global) {
    undoStack_.push(new SoftnessEdit(*this, softness, text, gesture));
  }
}

void Document::cut(const std::vector<LinkId>& links) {
  if (!links.empty()) {
    undoStack_.push(new CutEdit(*this, links));
  }
}

void Document::resetObject() { undoStack_.push(new ResetEdit(*this)); }

void Document::replaceMesh(const MeshPointer& mesh, const QString& name, const QString& text) {
  undoStack_.push(new MeshEdit(*this, mesh, name, text));
}

void Document::setAlgorithm(int panel, Algorithm algorithm) {
  if (algorithms_[panel] != algorithm) {
    algorithms_[panel] = algorithm;
    solvers_[panel]->post(commands::SetAlgorithm{algorithm});
    emit algorithmChanged(panel);
  }
}

void Document::setRelaxation(bool on, double step) {
  if (on != relaxation_.on || step != relaxation_.step) {
    relaxation_.on = on;
    relaxation_.step = step;
    post(relaxation_);
    emit relaxationChanged();
  }
}

void Document::setHighlight(const Highlight& highlight) {
  if (highlight != highlight_) {
    highlight_ = highlight;
    emit highlightChanged();
  }
}

void Document::applyCuts(const std::vector<LinkId>& links, bool cut) {
  for (const LinkId link : links) {
    cut ? cuts_.cut(link) : cuts_.uncut(link);
  }
  post(cut ? Command(commands::Cut{links}) : Command(commands::Uncut{links}));
  emit cutsChanged();
}

void Document::applySoftness(const LinkSoftness& softness) {
  softness_.global = softness;
  post(commands::SetSoftness{softness_});
  emit softnessChanged();
}

}  // namespace chainmail
