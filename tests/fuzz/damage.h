#pragma once

#include <algorithm>
#include <cstddef>
#include <nlohmann/json.hpp>
#include <random>
#include <string>
#include <string_view>
#include <vector>

namespace chainmail::fuzz {

/// Damages files as disks, transfers, careless programs and attackers do. The same seed gives the same damage.
class Damage {
 public:
  explicit Damage(unsigned seed) : random_(seed) {}

  /// Returns a random number below `end`; 0 if `end` is 0.
  std::size_t below(std::size_t end) { return end == 0 ? 0 : random_() % end; }

  /// Changes, inserts, removes or repeats bytes at one or two places.
  void apply(std::string& bytes) {
    for (std::size_t times = 1 + below(2); times > 0; --times) {
      apply_one(bytes);
    }
  }

  /// Replaces, removes, repeats or exchanges one to three values of a JSON text, which stays JSON. Damages the bytes of
  /// another text.
  void apply_to_json(std::string& text) {
    nlohmann::json tree = nlohmann::json::parse(text, nullptr, false);
    if (tree.is_discarded()) {
      return apply(text);
    }
    for (std::size_t times = 1 + below(3); times > 0; --times) {
      apply_to_value(tree);
    }
    text = tree.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
  }

 private:
  void apply_one(std::string& bytes) {
    static const std::vector<std::string> numbers{
        "4294967295", "-1",   "2147483648",           "1e999",           "nan", "1e-320",
        "0",          "1e99", "18446744073709551616", "\xff\xff\xff\xff"};
    const std::size_t place = below(bytes.size());
    const std::size_t length = below(std::min<std::size_t>(bytes.size() - place, 200) + 1);
    switch (below(6)) {
      case 0:
        return bytes.resize(place);
      case 1:
        for (std::size_t i = 0; i < 1 + length / 10 && !bytes.empty(); ++i) {
          bytes[below(bytes.size())] = any_byte();
        }
        return;
      case 2:
        for (std::size_t i = 0; i < length; ++i) {
          bytes.insert(bytes.begin() + std::ptrdiff_t(place), any_byte());
        }
        return;
      case 3:
        bytes.erase(place, length);
        return;
      case 4:
        bytes.insert(place, bytes.substr(below(bytes.size()), length));
        return;
      default:
        replace_number(bytes, below(2) == 0 ? place : below(std::min<std::size_t>(bytes.size(), 300)),
                       numbers[below(numbers.size())]);
    }
  }

  /// Returns a random character. It is often one that occurs in texts, so that texts stay texts.
  char any_byte() {
    static constexpr std::string_view of_texts = "0123456789 -.e\n";
    return below(3) > 0 ? of_texts[below(of_texts.size())] : static_cast<char>(random_());
  }

  /// Replaces the first number after `place` by another one.
  static void replace_number(std::string& bytes, std::size_t place, const std::string& number) {
    const std::size_t first = bytes.find_first_of("0123456789", place);
    if (first != std::string::npos) {
      bytes.replace(first, std::min(bytes.find_first_not_of("0123456789.", first), bytes.size()) - first, number);
    }
  }

  /// Returns a random value in the tree. Each level is left with the same chance, so that the long lists of a mesh do
  /// not get all the damage.
  nlohmann::json& any_value(nlohmann::json& tree) {
    nlohmann::json* value = &tree;
    while (value->is_structured() && !value->empty() && (value == &tree || below(4) > 0)) {
      value = &*std::next(value->begin(), std::ptrdiff_t(below(value->size())));
    }
    return *value;
  }

  nlohmann::json hostile_value() {
    using Json = nlohmann::json;
    static const std::vector<Json> values{nullptr,
                                          true,
                                          0,
                                          -1,
                                          1,
                                          0.5,
                                          4294967295U,
                                          4294967296U,
                                          1e300,
                                          -1e300,
                                          1e-320,
                                          "",
                                          "<img src='file:never'>",
                                          "../../x",
                                          std::string(3000, 'x'),
                                          "\xe2\x80\xae\xf0\x9f\x92\xa9\n\t",
                                          Json::array(),
                                          Json::object(),
                                          Json::array({Json::array({Json::array({1})})}),
                                          Json::object({{"id", 3}, {"area", Json::array()}})};
    return values[below(values.size())];
  }

  void apply_to_value(nlohmann::json& tree) {
    nlohmann::json& value = any_value(tree);
    switch (below(5)) {
      case 0:
        if (value.is_structured() && !value.empty()) {
          value.erase(std::next(value.begin(), std::ptrdiff_t(below(value.size()))));
        }
        return;
      case 1:
        if (value.is_array() && !value.empty()) {
          for (std::size_t times = 1 + below(20); times > 0; --times) {
            value.push_back(value[below(value.size())]);
          }
        }
        return;
      case 2: {
        const nlohmann::json other = any_value(tree);
        value = other;
        return;
      }
      default:
        value = hostile_value();
    }
  }

  std::mt19937 random_;
};

}  // namespace chainmail::fuzz
