#include "document.h"

#include <algorithm>

#include "edits.h"
#include "mesh/error.h"
#include "text.h"

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
  // Elements of another mesh are other elements.
  connect(this, &Document::meshChanged, this, [this] {
    recorder_.forget();
    emit lastDragChanged();
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

void Document::grab(ElementId element) {
  recorder_.grab(element);
  post(commands::Grab{element});
}

void Document::drag(const Point& target) {
  recorder_.drag(target);
  post(commands::Drag{target});
}

void Document::post(const Command& command) {
  log_->post(command);
  // The first sampled command of a while goes at once, later ones 60 times a second.
  if (log_->waits() && !sampler_.isActive()) {
    log_->sample();
    sampler_.start();
  }
}

void Document::release() {
  post(commands::Release{});
  if (recorder_.release()) {
    emit lastDragChanged();
  }
}

void Document::setSoftness(const LinkSoftness& global, const QString& text, int gesture) {
  if (global != softness_->global) {
    pushSoftness({global, softness_->links}, text, gesture);
  }
}

void Document::setSoftnessOf(const std::vector<LinkId>& links, const std::optional<LinkSoftness>& own) {
  Softness softness = *softness_;
  for (const LinkId link : links) {
    if (own) {
      softness.links.insert_or_assign(link, *own);
    } else {
      softness.links.erase(link);
    }
  }
  if (softness.links != softness_->links) {
    pushSoftness(std::move(softness), counted(QStringLiteral("stiffness of"), links.size(), QStringLiteral("link")), 0);
  }
}

void Document::resetSoftness() {
  if (*softness_ != Softness()) {
    pushSoftness({}, QStringLiteral("reset stiffness"), 0);
  }
}

void Document::pushSoftness(Softness softness, const QString& text, int gesture) {
  undoStack_.push(new SoftnessEdit(*this, std::make_shared<const Softness>(std::move(softness)), text, gesture));
}

bool Document::isPinned(ElementId element) const { return std::binary_search(pins_.begin(), pins_.end(), element); }

void Document::setPinned(const std::vector<ElementId>& elements, bool pinned) {
  if (!elements.empty()) {
    undoStack_.push(new PinEdit(*this, elements, pinned));
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
  try {
    check(algorithm, *mesh_);
  } catch (const Error& error) {
    emit refused(QString::fromStdString(error.what()));
    emit algorithmChanged(panel);  // who asked shows what still runs
    return;
  }
  if (algorithms_[panel] != algorithm) {
    algorithms_[panel] = algorithm;
    solvers_[panel]->post(commands::SetAlgorithm{algorithm});
    emit algorithmChanged(panel);
  }
}

/// The solvers have gone on by Natural Queue where an algorithm does not work on the new mesh: so do the figures.
void Document::followFallback() {
  QStringList where;
  QString from;
  for (int panel = 0; panel < panels; ++panel) {
    if (!fits(algorithms_[panel], *mesh_)) {
      from = chainmail::text(info(algorithms_[panel]).label);
      algorithms_[panel] = Algorithm::natural_queue;
      where << (panel == 0 ? QStringLiteral("left") : QStringLiteral("right"));
      emit algorithmChanged(panel);
    }
  }
  if (!where.isEmpty()) {
    emit noticed(
        QStringLiteral("%1 does not work on this mesh: the %2 panel goes on by %3")
            .arg(from, where.join(QStringLiteral(" and the ")), chainmail::text(info(Algorithm::natural_queue).label)));
  }
}

void Document::setRelaxation(const commands::SetRelaxation& relaxation) {
  if (relaxation != relaxation_) {
    relaxation_ = relaxation;
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

void Document::select(std::vector<ElementId> elements) {
  if (elements != selection_.elements) {
    selection_.links = linksAmong(*mesh_, cuts_, elements);
    selection_.elements = std::move(elements);
    emit selectionChanged();
  }
}

void Document::applyCuts(const std::vector<LinkId>& links, bool cut) {
  for (const LinkId link : links) {
    cut ? cuts_.cut(link) : cuts_.uncut(link);
  }
  post(cut ? Command(commands::Cut{links}) : Command(commands::Uncut{links}));
  emit cutsChanged();
  if (!selection_.empty()) {
    selection_.links = linksAmong(*mesh_, cuts_, selection_.elements);
    emit selectionChanged();
  }
}

void Document::applyPins(const std::vector<ElementId>& elements, bool pinned) {
  pins_ = combined(pins_, elements, pinned ? SelectionMode::add : SelectionMode::remove);
  post(pinned ? Command(commands::Pin{elements}) : Command(commands::Unpin{elements}));
  emit pinsChanged();
}

void Document::applySoftness(std::shared_ptr<const Softness> softness) {
  softness_ = std::move(softness);
  post(commands::SetSoftness{*softness_});
  emit softnessChanged();
}

}  // namespace chainmail
