#include "document/background_reference.h"

#include <algorithm>
#include <cmath>

#include "measure/physical_error.h"
#include "mesh/error.h"

namespace chainmail {
namespace {

constexpr int restMilliseconds = 300;
constexpr int progressMilliseconds = 200;
// Fraction of the mean link length. A pin that is nearer than this to its rest position counts as at rest, because of
// rounding.
constexpr double atRest = 1e-5;

bool alike(const ElasticProblem& one, const ElasticProblem& other) {
  return one.mesh == other.mesh && one.pins == other.pins && one.pinned == other.pinned &&
         one.options == other.options && one.cuts.links() == other.cuts.links();
}

}  // namespace

/// Keeps the prepared solver of a problem. Used by one thread at a time.
class BackgroundReference::Worker {
 public:
  Answer answer(const ElasticProblem& problem, const Handle& handle, const Progress& progress) {
    if (!solver_ || !alike(*problem_, problem)) {
      solver_.reset();
      problem_ = problem;
      solver_ = std::make_unique<ReferenceSolver>(problem, progress.part(0, 0.3));
    }
    Answer answer;
    answer.mesh = problem.mesh;
    answer.solution = solver_->at(handle.element, handle.target, progress.part(0.3, 1));
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
  connect(&document, &Document::tapeChanged, this, &BackgroundReference::followHandle);
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
  const Tape& tape = document_.tape();
  std::optional<Point> target;
  for (std::size_t i = tape.position(); i > 0; --i) {
    const Command& command = tape.at(i - 1);
    if (const auto* drag = std::get_if<commands::Drag>(&command); drag != nullptr && !target) {
      target = drag->target;
    } else if (const auto* grab = std::get_if<commands::Grab>(&command); grab != nullptr && target) {
      return Handle{grab->element, *target};
    } else if (std::holds_alternative<commands::Reset>(command) && !target) {
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
  } else if (auto asked = problem(); asked && document_.idle()) {
    start(std::move(*asked));
  } else {
    delay_.start();  // the solvers are still busy
  }
}

std::string BackgroundReference::whyNot() const {
  if (document_.pins().empty()) {
    return "nothing pins the object";
  }
  if (!handle_) {
    return "drag an element first";
  }
  if (document_.isPinned(handle_->element)) {
    return "the element that was dragged last is pinned";
  }
  if (handle_->target == document_.mesh()->rest_position(handle_->element)) {
    return "the element that was dragged last is back at rest";
  }
  try {
    check(ElasticMethod::neo_hookean, *document_.mesh());
  } catch (const Error& error) {
    return error.problem();
  }
  return {};
}

/// Returns the problem for the current object; none before the first frame. The positions of the pins come from the
/// first panel. The panels differ in them only if elements were pinned away from rest.
std::optional<ElasticProblem> BackgroundReference::problem() const {
  const Frame* frame = document_.frame(0);
  if (frame == nullptr) {
    return std::nullopt;
  }
  const Mesh& mesh = *frame->mesh;
  ElasticProblem problem{frame->mesh, document_.cuts(), document_.pins(), {}, document_.elastic()};
  for (const ElementId pin : problem.pins) {
    for (int k = 0; k < mesh.space_dimension; ++k) {
      const std::size_t at = std::size_t{pin} * std::size_t(mesh.space_dimension) + std::size_t(k);
      const double away = double(frame->positions[at]) - mesh.rest[at];
      problem.pinned.push_back(std::abs(away) > atRest * mesh.mean_link_length ? away : 0);
    }
  }
  return problem;
}

void BackgroundReference::start(ElasticProblem problem) {
  if (!worker_) {
    worker_ = std::make_shared<Worker>();
  }
  jobs_.start(Jobs::Kind::load, QStringLiteral("Reference solution"),
              [this, worker = worker_, handle = *handle_,
               problem = std::move(problem)](const Progress& progress) -> Jobs::Finish {
                Answer answer;
                try {
                  answer = worker->answer(problem, handle, progress);
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
