#pragma once

#include <memory>
#include <string>

#include "document/document.h"
#include "files/session/lesson.h"

namespace chainmail {

/// Writes the lesson of a document: captions over its recorded moves. Each change is one undo step. What a reader of
/// sessions refuses is not taken over: texts that are empty or too long.
class LessonWriter {
 public:
  explicit LessonWriter(Document& document) : document_(document) {}

  /// Makes the object a lesson with one step, at the present position in the recorded moves. `look` has the names of
  /// the window and the candidate of the pass.
  void begin(LessonStep look);
  /// Adds a step at the present position, after the present step. Refused, with a sentence, if the recorded moves are
  /// not those of the lesson any more.
  void addStep(LessonStep look);
  /// Removes the present step. The lesson ends with its last step.
  void removeStep();
  /// Exchanges the caption of the present step with that of the step before (-1) or after (1), which becomes the
  /// present one.
  void moveStep(int by);
  void setLessonTitle(const std::string& title);
  void setTitle(const std::string& title);
  void setText(const std::string& text);

 private:
  std::shared_ptr<const Session> sessionNow() const;
  void put(const std::shared_ptr<const Session>& session, Lesson captions, std::size_t step, const QString& text,
           int gesture = 0);
  void setCaption(std::string LessonStep::*which, const std::string& text, std::size_t longest, int gesture);

  Document& document_;
};

}  // namespace chainmail
