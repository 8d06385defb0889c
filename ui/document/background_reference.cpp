#include "document/background_reference.h"

#include <algorithm>
#include <cmath>

#include "document/element_facts.h"
#include "measure/physical_error.h"
#include "mesh/error.h"
#include "solver/algorithms.h"

namespace chainmail {
namespace {

constexpr int restMilliseconds = 300;
constexpr int progressMilliseconds = 200;
// Fraction of the mean link length. An element that is nearer than this to its rest position counts as at rest, because
// of rounding.
constexpr double atRest = 1e-5;

/// Returns the displacements of elements from rest in a frame (mesh units), without those that are only rounding.
std::vector<double> displacementsOf(const Frame& frame, const std::vector<ElementId>& elements) {
  const Mesh& mesh = *frame.mesh;
  std::vector<double> displacements = displacements_of(mesh, frame.view(), elements);
  for (double& away : displacements) {
    away = std::abs(away) > atRest * mesh.mean_link_length ? away : 0;
  }
  return displacements;
}

bool alike(const ElasticProblem& one, const ElasticProblem& other) {
  return one.mesh == other.mesh && one.pins == other.pins && one.pinned == other.pinned &&
         one.options == other.options && one.cuts.links() == other.cuts.links();
}

}  // namespace

/// Keeps the prepared solver of a problem. Used by one thread at a time.
class BackgroundReference::Worker {
 public:
  Answer answer(const Task& task, const Progress& progress) {
    const ElasticProblem& problem = task.problem;
    if (!solver_ || !alike(*problem_, problem)) {
      solver_.reset();
      problem_ = problem;
      solver_ = std::make_unique<ReferenceSolver>(problem, progress.part(0, 0.3));
    }
    Answer answer;
    answer.mesh = problem.mesh;
    answer.solution = task.target ? solver_->at(task.handle.front(), *task.target, progress.part(0.3, 1))
                                  : solver_->at(task.handle, task.displacements, progress.part(0.3, 1));
    answer.rms = rms_displacement(*answer.mesh, answer.solution);
    answer.nothing = error_of_nothing_moving(*answer.mesh, answer.solution).relative;
    return answer;
  }

 private:
  std::optional<ElasticProblem> problem_;
  std::unique_ptr<ReferenceSolver> solver_;
};

BackgroundReference::BackgroundReference(const Document& document) : document_(document) {
  delay_.setSingleShot(true);
  delay_.setInterval(restMilliseconds);
  progress_.setInterval(progressMilliseconds);
  connect(&delay_, &QTimer::timeout, this, &BackgroundReference::compute);
  connect(&progress_, &QTimer::timeout, this, &BackgroundReference::changed);
  connect(&jobs_, &Jobs::changed, this, [this] { jobs_.running() ? progress_.start() : progress_.stop(); });
  connect(&jobs_, &Jobs::failed, this, [this](const QString& sentence) { setState(sentence.toStdString()); });
  connect(&document.moves(), &MovePlayer::changed, this, &BackgroundReference::followHandle);
  for (const auto& signal : {&Document::pinsChanged, &Document::meshChanged, &Document::elasticChanged}) {
    connect(&document, signal, this, &BackgroundReference::outdate);
  }
  connect(&document, &Document::cutsChanged, this, &BackgroundReference::outdate);
}

void BackgroundReference::setWanted(bool wanted) {
  wanted_ = wanted;
  if (wanted) {
    outdate();
    return;
  }
  delay_.stop();
  jobs_.cancel();
  answer_.reset();
  worker_.reset();
}

/// Returns the last target of a drag, unless the object was reset after it.
std::optional<BackgroundReference::Handle> BackgroundReference::lastHandle() const {
  const MoveHistory& history = document_.moves().history();
  const commands::Drag* last = nullptr;
  for (std::size_t i = history.position(); i > 0; --i) {
    const Command& command = history.at(i - 1);
    if (const auto* drag = std::get_if<commands::Drag>(&command); drag != nullptr && last == nullptr) {
      last = drag;
    } else if (const auto* grab = std::get_if<commands::Grab>(&command); grab != nullptr && last != nullptr) {
      Handle handle{grab->elements, last->target, last->rotation, last->relative};
      std::ranges::sort(handle.elements);
      return handle;
    } else if (std::holds_alternative<commands::Reset>(command) && last == nullptr) {
      return std::nullopt;
    }
  }
  return std::nullopt;
}

void BackgroundReference::followHandle() {
  if (wanted_ && lastHandle() != handle_) {
    outdate();
  }
}

void BackgroundReference::outdate() {
  if (!wanted_) {
    return;
  }
  handle_ = lastHandle();
  answer_.reset();
  why_ = QStringLiteral("waiting for the drag to pause");
  jobs_.cancel();
  delay_.start();
  emit changed();
}

QString BackgroundReference::state() const {
  return jobs_.running()
             ? QStringLiteral("computing the reference solution… %1 %").arg(std::lround(100 * jobs_.share()))
             : why_;
}

void BackgroundReference::compute() {
  if (const std::string why = whyNot(); !why.empty()) {
    setState(why);
  } else if (auto asked = task(); asked && document_.solvers().idle(0)) {
    start(std::move(*asked));
  } else {
    setState("waiting for panel A");  // its positions are part of the task
    delay_.start();
  }
}

/// True if the handle has one element with an absolute target.
bool BackgroundReference::hasOneTarget(const Handle& handle) { return handle.elements.size() == 1 && !handle.relative; }

bool BackgroundReference::isAtRest() const {
  if (hasOneTarget(*handle_)) {
    return handle_->target == document_.mesh()->rest_position(handle_->elements.front());
  }
  const Frame* frame = document_.solvers().frame(0);
  return frame != nullptr && std::ranges::all_of(displacementsOf(*frame, handle_->elements),
                                                 [](double displacement) { return displacement == 0; });
}

std::string BackgroundReference::whyNot() const {
  if (document_.pins().empty()) {
    return "nothing pins the object";
  }
  if (!handle_) {
    return "drag an element first";
  }
  const auto& elements = handle_->elements;
  const bool one = elements.size() == 1;
  if (std::ranges::any_of(elements, [this](ElementId element) { return isPinned(document_, element); })) {
    return one ? "the element that was dragged last is pinned" : "an element that was dragged last is pinned";
  }
  if (isAtRest()) {
    return one ? "the element that was dragged last is back at rest"
               : "the handle that was dragged last is back at rest";
  }
  try {
    check(Algorithm::neo_hookean, *document_.mesh());
  } catch (const Error& error) {
    return error.problem();
  }
  return {};
}

/// Returns the task for the current object; none before the first frame. The positions of the pins come from the first
/// panel. The panels differ in them only if elements were pinned away from rest. The positions of a handle of many also
/// come from the first panel: the panels differ in the offsets of its elements, because they grab it in different
/// shapes.
std::optional<BackgroundReference::Task> BackgroundReference::task() const {
  const Frame* frame = document_.solvers().frame(0);
  if (frame == nullptr) {
    return std::nullopt;
  }
  Task task{{frame->mesh, document_.cuts(), document_.pins(), {}, document_.elastic()}, handle_->elements, {}, {}};
  task.problem.pinned = displacementsOf(*frame, task.problem.pins);
  if (hasOneTarget(*handle_)) {
    task.target = handle_->target;
  } else {
    task.displacements = displacementsOf(*frame, task.handle);
  }
  return task;
}

void BackgroundReference::start(Task task) {
  if (!worker_) {
    worker_ = std::make_shared<Worker>();
  }
  jobs_.start(Jobs::Kind::load, QStringLiteral("Reference solution"),
              [this, worker = worker_, task = std::move(task)](const Progress& progress) -> Jobs::Finish {
                Answer answer;
                try {
                  answer = worker->answer(task, progress);
                } catch (const Error& error) {
                  answer.fault = error.problem();
                }
                return [this, answer = std::make_shared<const Answer>(std::move(answer))] { take(answer); };
              });
  emit changed();
}

void BackgroundReference::take(std::shared_ptr<const Answer> answer) {
  if (!answer->fault.empty()) {
    setState(answer->fault);
    return;
  }
  answer_ = std::move(answer);
  emit changed();
}

void BackgroundReference::setState(const std::string& why) {
  why_ = QString::fromStdString(why);
  emit changed();
}

}  // namespace chainmail
