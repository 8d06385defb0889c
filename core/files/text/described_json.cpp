#include "files/text/described_json.h"

#include <cstdint>

#include "files/text/text.h"

namespace chainmail {
namespace {

using Json = nlohmann::json;
using OrderedJson = nlohmann::ordered_json;

OrderedJson json_of_item(const MemberInfo& member, double value) {
  if (is_yes_or_no(member)) {
    return value != 0;
  }
  if (!member.names.empty()) {
    return member.names[std::size_t(value)];
  }
  return member.is_whole ? OrderedJson(std::uint64_t(value)) : OrderedJson(value);
}

double item_of(const JsonFields& fields, const Json& json, const MemberInfo& member) {
  if (is_yes_or_no(member)) {
    if (!json.is_boolean()) {
      fields.fail(in_quotes(std::string(member.key)) + " is neither true nor false", "write one of them");
    }
    return json.get<bool>() ? 1 : 0;
  }
  if (!member.names.empty()) {
    return double(fields.choice(json, std::string(member.key), member.names));
  }
  if (member.is_whole && json.is_number() && !json.is_number_unsigned()) {
    fields.fail(in_quotes(std::string(member.key)) + " is not a whole number", "use " + range_of(*member.number));
  }
  return fields.number(json, *member.number);
}

}  // namespace

OrderedJson json_of(const MemberInfo& member, const std::function<double(std::size_t)>& value) {
  if (member.count == 1) {
    return json_of_item(member, value(0));
  }
  OrderedJson items = OrderedJson::array();
  for (std::size_t i = 0; i < member.count; ++i) {
    items.push_back(json_of_item(member, value(i)));
  }
  return items;
}

std::vector<double> values_of(const JsonFields& fields, const Json& json, const MemberInfo& member) {
  if (member.count == 1) {
    return {item_of(fields, json, member)};
  }
  if (!json.is_array() || json.size() != member.count) {
    fields.fail(in_quotes(std::string(member.key)) + " is not an array of " + std::to_string(member.count) + " numbers",
                "write " + std::to_string(member.count) + " in [ ]");
  }
  std::vector<double> values;
  for (const Json& item : json) {
    values.push_back(item_of(fields, item, member));
  }
  return values;
}

}  // namespace chainmail
