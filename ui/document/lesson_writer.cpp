#include "document/lesson_writer.h"

#include <limits>
#include <utility>

#include "document/edits.h"
#include "document/lesson_steps.h"
#include "files/session/session.h"
#include "files/text/limits.h"

namespace chainmail {
namespace {

// Changes of one text become one undo step. Other gestures are small numbers, or the largest ones.
constexpr int lessonTitleGesture = std::numeric_limits<int>::max() - 10;
constexpr int titleGesture = lessonTitleGesture - 1, textGesture = lessonTitleGesture - 2;

constexpr const char* firstCaption = "Write here what the reader should see.";

bool canBeRead(const std::string& text, std::size_t longest) { return !text.empty() && text.size() <= longest; }

}  // namespace

/// Returns a session with the recorded moves and the algorithms of the panels, which play them from rest.
std::shared_ptr<const Session> LessonWriter::sessionNow() const {
  auto session = std::make_shared<Session>();
  session->name = document_.name().toStdString();
  session->mesh = document_.mesh();
  session->elastic = document_.elastic();
  session->moves = document_.moves().history().commands();
  for (int panel = 0; panel < document_.panels(); ++panel) {
    session->panels.push_back({document_.algorithm(panel), Precision::single_precision, {}});
  }
  return session;
}

void LessonWriter::put(const std::shared_ptr<const Session>& session, Lesson captions, std::size_t step,
                       const QString& text, int gesture) {
  edits::setLesson(document_, {session, std::make_shared<const Lesson>(std::move(captions)), step}, text, gesture);
}

void LessonWriter::begin(LessonStep look) {
  document_.handle().end();
  document_.moves().noteRelaxation();
  look.title = "Step 1";
  look.text = firstCaption;
  look.until = document_.moves().history().position();
  std::string title = document_.name().toStdString();
  if (!canBeRead(title, limits::name_bytes)) {
    title = "Lesson";
  }
  put(sessionNow(), {title, {std::move(look)}}, 0, QStringLiteral("new lesson"));
  document_.moves().noteLessonRecorded();
}

void LessonWriter::addStep(LessonStep look) {
  document_.handle().end();
  const OpenLesson lesson = document_.lesson();
  if (!document_.moves().recordsLesson()) {
    emit document_.refused(QStringLiteral(
        "The recorded moves are not those of the lesson any more: go to a step of the lesson and continue "
        "from its last step, or make a new lesson here"));
    return;
  }
  if (lesson.captions->steps.size() >= limits::lesson_steps) {
    emit document_.refused(
        QStringLiteral("The lesson has %L1 steps, the most that a file may have").arg(lesson.captions->steps.size()));
    return;
  }
  document_.moves().noteRelaxation();
  auto session = std::make_shared<Session>(*lesson.session);
  session->moves = document_.moves().history().commands();
  session->mesh = document_.mesh();
  look.title = "Step " + std::to_string(lesson.captions->steps.size() + 1);
  look.text = firstCaption;
  look.until = document_.moves().history().position();
  for (int panel = 0; panel < document_.panels(); ++panel) {
    look.algorithms.push_back(document_.algorithm(panel));
  }
  Lesson captions = *lesson.captions;
  const std::size_t at = insertStep(captions, std::move(look), lesson.step);
  put(session, std::move(captions), at, QStringLiteral("add step"));
  document_.moves().noteLessonRecorded();
}

void LessonWriter::removeStep() {
  const OpenLesson& lesson = document_.lesson();
  Lesson captions = *lesson.captions;
  if (captions.steps.size() == 1) {
    edits::setLesson(document_, {}, QStringLiteral("remove lesson"));
    return;
  }
  chainmail::removeStep(captions, lesson.step);
  put(lesson.session, std::move(captions), lesson.step > 0 ? lesson.step - 1 : 0, QStringLiteral("remove step"));
}

void LessonWriter::moveStep(int by) {
  const OpenLesson& lesson = document_.lesson();
  const auto other = std::ptrdiff_t(lesson.step) + by;
  if (other < 0 || other >= std::ssize(lesson.captions->steps)) {
    return;
  }
  Lesson captions = *lesson.captions;
  exchangeCaptions(captions, lesson.step, std::size_t(other));
  put(lesson.session, std::move(captions), std::size_t(other), QStringLiteral("move step"));
}

void LessonWriter::setLessonTitle(const std::string& title) {
  const OpenLesson& lesson = document_.lesson();
  if (canBeRead(title, limits::name_bytes) && title != lesson.captions->title) {
    put(lesson.session, {title, lesson.captions->steps}, lesson.step, QStringLiteral("title of the lesson"),
        lessonTitleGesture);
  }
}

void LessonWriter::setTitle(const std::string& title) {
  setCaption(&LessonStep::title, title, limits::name_bytes, titleGesture);
}

void LessonWriter::setText(const std::string& text) {
  setCaption(&LessonStep::text, text, limits::caption_bytes, textGesture);
}

void LessonWriter::setCaption(std::string LessonStep::*which, const std::string& text, std::size_t longest,
                              int gesture) {
  const OpenLesson& lesson = document_.lesson();
  Lesson captions = *lesson.captions;
  std::string& present = captions.steps[lesson.step].*which;
  if (canBeRead(text, longest) && text != present) {
    present = text;
    put(lesson.session, std::move(captions), lesson.step, QStringLiteral("caption of step %1").arg(lesson.step + 1),
        gesture);
  }
}

}  // namespace chainmail
