#pragma once

#include <filesystem>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "files/text/json_scan.h"

namespace chainmail {

/// The items of an array of numbers, or of an array of arrays that all have the same length, without a tree. The first
/// item that is anything else ends the list, so that a check can refuse it. Later items are dropped.
class NumberList {
 public:
  using Json = nlohmann::json;

  void add(Json item);
  std::size_t size() const;
  /// Returns a copy of an item.
  Json at(std::size_t i) const;

 private:
  std::size_t width_ = 0;      // number of numbers in an item; 0 if items are numbers
  std::vector<Json> numbers_;  // item by item
  std::optional<Json> other_;  // the last item, if it is anything else
};

/// One command of a file of moves.
struct MoveMembers {
  nlohmann::json members = nlohmann::json::object();  // with an empty array for each of `lists`
  std::map<std::string, NumberList> lists;            // the long ones: elements, links and faces
};

/// Reads a file of moves command by command, and drops each before it reads the next.
class MovesScan : public JsonScan {
 public:
  using Take = std::function<void(const nlohmann::json& value, const MoveMembers& command)>;

  /// Calls `take` for each item of `commands`, with the item itself if it is not an object. `where` appears in errors.
  MovesScan(std::string_view text, const std::filesystem::path& path, std::string where, Take take);

  /// Returns the members of the file, with an empty array for the commands; null if the file is not an object.
  const Json& head() const { return head_; }

 private:
  enum class At { outside, file, commands, command, list };

  void take_value(Json value) override;
  void open(Json empty) override;
  void close() override;
  void take_key(const std::string& key) override;
  void open_here(Json empty);
  void put(Json value);

  std::string where_;
  Take take_;
  At at_ = At::outside;
  Json head_;
  bool head_has_unknown_ = false, command_has_unknown_ = false;  // the first unknown key is kept, to be refused
  MoveMembers command_;
  std::string file_key_, command_key_;  // of the value that follows
  SmallTree tree_;                      // a value that is kept whole
  std::size_t commands_ = 0;
};

}  // namespace chainmail
