#include "document/background_truth.h"

#include <algorithm>
#include <cmath>

#include "measure/physical_error.h"
#include "mesh/error.h"

namespace chainmail {
namespace {

constexpr int restMilliseconds = 300;
constexpr int progressMilliseconds = 200;
// Of the mean rest length: a pin that a frame shows this near to rest stands there, but for rounding.
constexpr double atRest = 1e-5;

bool alike(const ElasticProblem& one, const ElasticProblem& other) {
  return one.mesh == other.mesh && one.pins == other.pins && one.pinned == other.pinned &&
         one.options == other.options && one.cuts.links() == other.cuts.links();
}

}  // namespace

/// Keeps what was prepared for a problem. Belongs to one thread at a time.
class BackgroundTruth::Worker {
 public:
  Answer answer(const ElasticProblem& problem, const Hand& hand, const Progress& progress) {
    if (!solver_ || !alike(*problem_, problem)) {
      solver_.reset();
      problem_ = problem;
      solver_ = std::make_unique<ReferenceSolver>(problem, progress.part(0, 0.3));
    }
    Answer answer;
    answer.mesh = problem.mesh;
    answer.truth = solver_->at(hand.element, hand.target, progress.part(0.3, 1));
    answer.rms = rms_displacement(*answer.mesh, answer.truth);
    answer.nothing = error_of_nothing_moving(*answer.mesh, answer.truth).relative;
    return answer;
  }

 private:
  std::optional<ElasticProblem> problem_;
  std::unique_ptr<ReferenceSolver> solver_;
};

BackgroundTruth::BackgroundTruth(const Document& document) : document_(document) {
  delay_.setSingleShot(true);
  delay_.setInterval(restMilliseconds);
  progress_.setInterval(progressMilliseconds);
  connect(&delay_, &QTimer::timeout, this, &BackgroundTruth::ask);
  connect(&progress_, &QTimer::timeout, this, &BackgroundTruth::changed);
  connect(&jobs_, &Jobs::changed, this, [this] { jobs_.running() ? progress_.start() : progress_.stop(); });
  connect(&jobs_, &Jobs::failed, this, [this](const QString& sentence) { say(sentence.toStdString()); });
  connect(&document, &Document::tapeChanged, this, &BackgroundTruth::followHand);
  for (const auto& signal : {&Document::pinsChanged, &Document::meshChanged, &Document::elasticChanged}) {
    connect(&document, signal, this, &BackgroundTruth::outdate);
  }
  connect(&document, &Document::cutsChanged, this, &BackgroundTruth::outdate);
}

void BackgroundTruth::setWanted(bool wanted) {
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

/// What was done last to an element, unless all went back to rest since.
std::optional<BackgroundTruth::Hand> BackgroundTruth::lastHand() const {
  const Tape& tape = document_.tape();
  std::optional<Point> target;
  for (std::size_t i = tape.position(); i > 0; --i) {
    const Command& command = tape.at(i - 1);
    if (const auto* drag = std::get_if<commands::Drag>(&command); drag != nullptr && !target) {
      target = drag->target;
    } else if (const auto* grab = std::get_if<commands::Grab>(&command); grab != nullptr && target) {
      return Hand{grab->element, *target};
    } else if (std::holds_alternative<commands::Reset>(command) && !target) {
      return std::nullopt;
    }
  }
  return std::nullopt;
}

void BackgroundTruth::followHand() {
  if (wanted_ && lastHand() != hand_) {
    outdate();
  }
}

void BackgroundTruth::outdate() {
  if (!wanted_) {
    return;
  }
  hand_ = lastHand();
  answer_.reset();
  why_ = QStringLiteral("it waits for the hand to rest");
  jobs_.cancel();
  delay_.start();
  emit changed();
}

QString BackgroundTruth::state() const {
  return jobs_.running()
             ? QStringLiteral("computing the reference solution… %1 %").arg(std::lround(100 * jobs_.share()))
             : why_;
}

void BackgroundTruth::ask() {
  if (const std::string why = whyNot(); !why.empty()) {
    say(why);
  } else if (auto asked = problem(); asked && document_.idle()) {
    compute(std::move(*asked));
  } else {
    delay_.start();  // the solvers are still at it
  }
}

std::string BackgroundTruth::whyNot() const {
  if (document_.pins().empty()) {
    return "nothing pins the object";
  }
  if (!hand_) {
    return "drag an element first";
  }
  if (document_.isPinned(hand_->element)) {
    return "the element that was dragged last is pinned";
  }
  if (hand_->target == document_.mesh()->rest_position(hand_->element)) {
    return "the element that was dragged last is back at rest";
  }
  try {
    check(ElasticMethod::neo_hookean, *document_.mesh());
  } catch (const Error& error) {
    return error.problem();
  }
  return {};
}

/// The pins as the first panel shows them; they stand alike in all, unless they were pinned away from rest.
std::optional<ElasticProblem> BackgroundTruth::problem() const {
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

void BackgroundTruth::compute(ElasticProblem problem) {
  if (!worker_) {
    worker_ = std::make_shared<Worker>();
  }
  jobs_.start(
      Jobs::Kind::load, QStringLiteral("Truth"),
      [this, worker = worker_, hand = *hand_, problem = std::move(problem)](const Progress& progress) -> Jobs::Finish {
        Answer answer;
        try {
          answer = worker->answer(problem, hand, progress);
        } catch (const Error& error) {
          answer.fault = error.problem();
        }
        return [this, answer = std::make_shared<const Answer>(std::move(answer))] { take(answer); };
      });
  emit changed();
}

void BackgroundTruth::take(std::shared_ptr<const Answer> answer) {
  if (!answer->fault.empty()) {
    say(answer->fault);
    return;
  }
  answer_ = std::move(answer);
  emit changed();
}

void BackgroundTruth::say(const std::string& why) {
  why_ = QString::fromStdString(why);
  emit changed();
}

}  // namespace chainmail
