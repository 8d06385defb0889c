#include "files/schema/schemas.h"

namespace chainmail::schema {

Json schema_of(const Parameter& number) {
  Json schema{{"type", "number"}};
  if (number.lowest == parameters::above_zero) {
    schema["exclusiveMinimum"] = 0;
  } else {
    schema["minimum"] = number.lowest;
  }
  if (number.highest == parameters::below_half) {
    schema["exclusiveMaximum"] = 0.5;
  } else if (number.highest != parameters::no_highest) {
    schema["maximum"] = number.highest;
  }
  schema["description"] = number.help;
  return schema;
}

Json schema_of(const MemberInfo& member) {
  Json item;
  if (is_yes_or_no(member)) {
    item = boolean();
  } else if (!member.names.empty()) {
    item = {{"enum", std::vector<std::string>(member.names.begin(), member.names.end())}};
  } else {
    item = schema_of(*member.number);
    item["type"] = member.is_whole ? "integer" : "number";
  }
  item["description"] = member.help;
  if (member.count == 1) {
    return item;
  }
  return {{"type", "array"}, {"items", item}, {"minItems", member.count}, {"maxItems", member.count}};
}

}  // namespace chainmail::schema
