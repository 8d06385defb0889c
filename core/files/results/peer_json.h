#pragma once

#include <filesystem>
#include <ostream>

#include "mesh/described.h"
#include "report/run/peer.h"

namespace chainmail {

/// Returns true for an elastic option that cases have: one that changes the shape of the reference.
bool is_in_cases(const MemberInfo& member);

/// Writes a case for another solver as JSON.
void write_json(std::ostream& out, const report::PeerCase& object);

/// Reads what write_json has written, or a case that someone else made. Throws Error.
report::PeerCase read_peer_case(const std::filesystem::path& path);
/// Reads the answer of another solver. Throws Error.
report::PeerAnswer read_peer_answer(const std::filesystem::path& path);

}  // namespace chainmail
