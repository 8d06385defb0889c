#pragma once

#include <memory>

#include "files/session/session_fields.h"
#include "files/text/text.h"
#include "mesh/texture.h"

namespace chainmail {

/// The picture, or the densities, of a session's mesh, as the value of its member `texture`. Throws Cancelled.
void write_session_texture(TextBlocks& out, const Texture& texture, const Progress& progress);

/// The same back, from the mesh's object; none where it has no such member. Throws Error, and Cancelled.
std::shared_ptr<const Texture> read_session_texture(const SessionFields& fields, const nlohmann::json& mesh,
                                                    const Progress& progress);

}  // namespace chainmail
