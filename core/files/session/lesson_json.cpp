#include "files/session/lesson_json.h"

#include <algorithm>
#include <limits>

#include "files/text/limits.h"
#include "files/text/text.h"

namespace chainmail {
namespace {

using Json = nlohmann::json;
using OrderedJson = nlohmann::ordered_json;

/// Names of the window in a step.
struct WindowName {
  const char* key;
  std::string LessonStep::*name;
};
constexpr WindowName window_names[] = {{"colour", &LessonStep::colour},
                                       {"show", &LessonStep::show},
                                       {"dock", &LessonStep::dock},
                                       {"tool", &LessonStep::tool}};

/// Returns a text that is not empty.
std::string caption(const JsonFields& fields, const Json& object, const char* key,
                    std::size_t longest = limits::name_bytes) {
  std::string text = one_line(fields.text(object, key, longest));
  if (trimmed(text).empty()) {
    fields.fail(std::string("'") + key + "' is empty", "write what the reader shall see");
  }
  return text;
}

std::vector<Algorithm> read_algorithms(const ObjectFields& fields, const Json& step, const Mesh& mesh) {
  std::vector<Algorithm> result;
  for (const Json& name : fields.array(step, "algorithms")) {
    result.push_back(fields.algorithm(name));
    fields.here([&] { check(result.back(), mesh); });
  }
  if (result.size() < lesson_panels_least || result.size() > lesson_panels_most) {
    fields.fail("'algorithms' has " + std::to_string(result.size()) + " names", "give one for each of 2 to 4 panels");
  }
  return result;
}

std::size_t read_until(const JsonFields& fields, const Json& step, std::size_t before, std::size_t moves) {
  const Json& until = fields.member(step, "until");
  if (!until.is_number_unsigned() || until.get<std::uint64_t>() > moves) {
    fields.fail("'until' is " + text_of(until) + ", but the session has " + std::to_string(moves) + " recorded moves",
                "write a whole number from 0 to " + std::to_string(moves));
  }
  const auto position = until.get<std::size_t>();
  if (position < before) {
    fields.fail("'until' is " + std::to_string(position) + ", but the step before ends at " + std::to_string(before),
                "write " + std::to_string(before) + " or more");
  }
  return position;
}

LessonStep read_step(const ObjectFields& fields, const Json& json, const Mesh& mesh, std::size_t before,
                     std::size_t moves) {
  fields.check_keys(json, {"title", "text", "until", "algorithms", "candidate", "colour", "show", "dock", "tool"});
  LessonStep step;
  step.title = caption(fields, json, "title");
  step.text = caption(fields, json, "text", limits::caption_bytes);
  step.until = read_until(fields, json, before, moves);
  if (json.contains("algorithms")) {
    step.algorithms = read_algorithms(fields, json, mesh);
  }
  if (json.contains("candidate")) {
    const std::uint64_t most = std::numeric_limits<std::uint32_t>::max();
    step.candidate = static_cast<std::uint32_t>(fields.whole(json, "candidate", 0, most));
  }
  for (const auto& [key, name] : window_names) {
    if (json.contains(key)) {
      step.*name = caption(fields, json, key);
    }
  }
  return step;
}

OrderedJson as_json(const LessonStep& step) {
  OrderedJson json{{"title", step.title}, {"text", step.text}, {"until", step.until}};
  for (const Algorithm algorithm : step.algorithms) {
    json["algorithms"].push_back(info(algorithm).name);
  }
  if (step.candidate) {
    json["candidate"] = *step.candidate;
  }
  for (const auto& [key, name] : window_names) {
    if (!(step.*name).empty()) {
      json[key] = step.*name;
    }
  }
  return json;
}

std::string dumped(const OrderedJson& json) { return json.dump(-1, ' ', false, OrderedJson::error_handler_t::replace); }

}  // namespace

Lesson read_lesson(const ObjectFields& fields, const nlohmann::json& object, const Mesh& mesh, std::size_t moves) {
  fields.check_keys(object, {"title", "steps"});
  Lesson lesson;
  lesson.title = caption(fields, object, "title");
  const Json& steps = fields.array(object, "steps");
  if (steps.empty() || steps.size() > limits::lesson_steps) {
    fields.fail("it has " + std::to_string(steps.size()) + " steps",
                "give 1 to " + std::to_string(limits::lesson_steps));
  }
  for (const Json& step : steps) {
    const std::size_t before = lesson.steps.empty() ? 0 : lesson.steps.back().until;
    const ObjectFields of_step = fields.at("step " + std::to_string(lesson.steps.size() + 1));
    lesson.steps.push_back(read_step(of_step, step, mesh, before, moves));
  }
  return lesson;
}

std::string lesson_json(const Lesson& lesson) {
  std::string text = "{\"title\": " + dumped(lesson.title) + ", \"steps\": [";
  for (const LessonStep& step : lesson.steps) {
    text += (&step == &lesson.steps.front() ? "\n" : ",\n") + dumped(as_json(step));
  }
  return text + "]}";
}

}  // namespace chainmail
