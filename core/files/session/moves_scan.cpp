#include "files/session/moves_scan.h"

#include <algorithm>
#include <array>
#include <iterator>
#include <utility>

#include "body/softness.h"
#include "files/text/text.h"
#include "mesh/error.h"

namespace chainmail {
namespace {

using Json = nlohmann::json;

constexpr std::array<std::string_view, 2> file_keys{"version", "commands"};
// The keys of a command, besides the numbers of a softness.
constexpr std::array<std::string_view, 20> command_keys{
    "do",     "element", "target", "by",    "rotate",  "links",     "elements", "energy",           "sweeps",
    "step",   "scheme",  "until",  "frame", "removed", "triangles", "polygons", "removed_polygons", "start",
    "panels", "slices"};

bool is_command_key(std::string_view key) {
  const auto is_named = [key](const SoftnessNumber& number) { return number.parameter->name == key; };
  return std::ranges::find(command_keys, key) != command_keys.end() || std::ranges::any_of(softness_numbers, is_named);
}

// The long lists, which are kept without a tree.
constexpr std::array<std::string_view, 7> list_keys{"slices",    "links",    "elements",        "removed",
                                                    "triangles", "polygons", "removed_polygons"};

bool is_number_array(const Json& json) {
  return json.is_array() && !json.empty() && std::ranges::all_of(json, [](const Json& one) { return one.is_number(); });
}

}  // namespace

void NumberList::add(Json item) {
  if (other_) {
    return;
  }
  const bool is_packed = item.is_number() || is_number_array(item);
  const std::size_t width = item.is_array() ? item.size() : 0;
  if (!is_packed || (!numbers_.empty() && width != width_)) {
    other_ = std::move(item);
    return;
  }
  width_ = width;
  if (item.is_array()) {
    std::ranges::move(item, std::back_inserter(numbers_));
  } else {
    numbers_.push_back(std::move(item));
  }
}

std::size_t NumberList::size() const { return numbers_.size() / std::max<std::size_t>(width_, 1) + (other_ ? 1 : 0); }

Json NumberList::at(std::size_t i) const {
  if (other_ && i + 1 == size()) {
    return *other_;
  }
  if (width_ == 0) {
    return numbers_[i];
  }
  const auto first = numbers_.begin() + static_cast<std::ptrdiff_t>(i * width_);
  return Json::array_t(first, first + static_cast<std::ptrdiff_t>(width_));
}

MovesScan::MovesScan(std::string_view text, const std::filesystem::path& path, std::string where, Take take)
    : JsonScan(text, path, "recorded moves"), where_(std::move(where)), take_(std::move(take)) {}

void MovesScan::take_key(const std::string& key) {
  if (tree_.is_open()) {
    tree_.take_key(key);
    return;
  }
  const bool in_command = at_ == At::command;
  if ((in_command ? command_.members : head_).contains(key)) {
    throw Error(in_command ? where_ + ": command " + std::to_string(commands_) : where_,
                in_quotes(key) + " appears twice", "remove one of them");
  }
  (in_command ? command_key_ : file_key_) = key;
}

void MovesScan::take_value(Json value) {
  if (tree_.is_open()) {
    tree_.put(std::move(value));
  } else {
    put(std::move(value));
  }
}

void MovesScan::open(Json empty) {
  if (tree_.is_open()) {
    tree_.open(std::move(empty));
  } else {
    open_here(std::move(empty));
  }
}

void MovesScan::open_here(Json empty) {
  const bool is_array = empty.is_array();
  if (at_ == At::outside && !is_array) {
    head_ = std::move(empty);
    at_ = At::file;
  } else if (at_ == At::file && is_array && file_key_ == "commands") {
    put(std::move(empty));
    at_ = At::commands;
  } else if (at_ == At::commands && !is_array) {
    command_ = {};
    command_has_unknown_ = false;
    at_ = At::command;
  } else if (at_ == At::command && is_array && std::ranges::find(list_keys, command_key_) != list_keys.end()) {
    command_.lists[command_key_];
    put(std::move(empty));
    at_ = At::list;
  } else {
    tree_.open(std::move(empty));
  }
}

void MovesScan::close() {
  if (tree_.is_open()) {
    tree_.close();
    if (!tree_.is_open()) {
      put(tree_.take());
    }
  } else if (at_ == At::list) {
    at_ = At::command;
  } else if (at_ == At::command) {
    at_ = At::commands;
    put(Json::object());
  } else {
    at_ = at_ == At::commands ? At::file : At::outside;
  }
}

/// Takes a complete value, which may be a command.
void MovesScan::put(Json value) {
  switch (at_) {
    case At::outside:
      break;  // not an object: `head` stays null
    case At::file:
      if (std::ranges::find(file_keys, file_key_) != file_keys.end() || !std::exchange(head_has_unknown_, true)) {
        head_[file_key_] = std::move(value);
      }
      break;
    case At::commands:
      take_(value, command_);
      ++commands_;
      break;
    case At::command:
      if (is_command_key(command_key_) || !std::exchange(command_has_unknown_, true)) {
        command_.members[command_key_] = std::move(value);
      }
      break;
    case At::list:
      command_.lists[command_key_].add(std::move(value));
      break;
  }
}

}  // namespace chainmail
