#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "files/session/lesson.h"
#include "files/session/object_json.h"

namespace chainmail {

/// Reads the member "lesson" of a session with `moves` recorded moves. Throws Error, with the step from 1, for anything
/// that lesson_json does not write.
Lesson read_lesson(const ObjectFields& fields, const nlohmann::json& object, const Mesh& mesh, std::size_t moves);

/// Returns a lesson as the member "lesson", with one step per line.
std::string lesson_json(const Lesson& lesson);

}  // namespace chainmail
