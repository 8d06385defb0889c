#pragma once

#include <nlohmann/json.hpp>

#include "report/run/compare.h"
#include "report/run/machine.h"

namespace chainmail {

/// What reports of all kinds have, as JSON.
nlohmann::ordered_json to_json(const TimeSpread& ms);
nlohmann::ordered_json to_json(const report::CompareOptions& options);
nlohmann::ordered_json to_json(const report::Origin& origin);
/// A name from outside may not be UTF-8: what is not becomes the replacement character.
void write_report(std::ostream& out, const nlohmann::ordered_json& json);

}  // namespace chainmail
