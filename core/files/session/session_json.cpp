#include "files/session/session_json.h"

#include <algorithm>
#include <istream>
#include <limits>
#include <string>

#include "files/text/json_scan.h"
#include "files/text/limits.h"
#include "files/text/text.h"
#include "mesh/error.h"

namespace chainmail {
namespace {

using Json = nlohmann::json;

constexpr std::size_t deepest_session = 16;  // levels of arrays and objects

enum class Packed { no, ids, reals };

/// Returns how the array `key` is packed. `top` is the outermost key around it.
Packed packed_as(const std::string& top, const std::string& key) {
  if (top == "ui") {
    return Packed::no;
  }
  for (const char* ids :
       {"links", "counts", "neighbours", "triangles", "polygons", "tetrahedra", "hexahedra", "cuts", "pins", "runs"}) {
    if (key == ids) {
      return Packed::ids;
    }
  }
  return key == "rest" || key == "own" || key == "held" ? Packed::reals : Packed::no;
}

/// Receives values from nlohmann's parser, one by one.
class SessionScanner {
 public:
  /// Reads from `buffer`, which holds the text.
  SessionScanner(std::string_view text, const TextBuffer& buffer, const std::filesystem::path& path,
                 SessionJson& result)
      : text_(text), buffer_(buffer), file_(shown(path)), path_(path), result_(result) {}

  bool null() { return put(nullptr); }
  bool boolean(bool value) { return put(value); }
  bool number_integer(std::int64_t value) { return number(value, double(value), std::nullopt); }
  bool number_unsigned(std::uint64_t value) { return number(value, double(value), value); }
  bool number_float(double value, const std::string&) { return number(value, value, std::nullopt); }
  bool string(std::string& value) { return put(std::move(value)); }
  bool binary(Json::binary_t&) { return false; }  // JSON has none
  bool start_object(std::size_t) { return open(Json::object()); }
  bool key(std::string& key);
  bool end_object() { return close(); }
  bool start_array(std::size_t);
  bool end_array();
  bool parse_error(std::size_t position, const std::string& last, const Json::exception& error);

 private:
  [[noreturn]] void fail(const std::string& problem, const std::string& remedy) const {
    throw Error(file_, problem, remedy);
  }
  template <class Value>
  bool number(Value value, double real, std::optional<std::uint64_t> whole);
  bool put(Json value);
  bool open(Json container);
  bool close();
  Json& add(Json value);
  std::size_t packed_count() const;
  [[noreturn]] void refuse_in_array() const;

  std::string_view text_;
  const TextBuffer& buffer_;
  std::string file_;
  const std::filesystem::path& path_;
  SessionJson& result_;
  std::vector<Json*> open_;  // from the outermost on
  std::string key_;          // of the value that follows, in an object
  std::string top_;          // the outermost key
  Packed packed_ = Packed::no;
  std::size_t values_ = 0;
  std::size_t moves_begin_ = 0;  // in the text
  std::size_t in_moves_ = 0;     // number of arrays and objects of the moves that are open
};

std::size_t SessionScanner::packed_count() const {
  return packed_ == Packed::ids ? result_.ids.back().size() : result_.reals.back().size();
}

void SessionScanner::refuse_in_array() const {
  const bool ids = packed_ == Packed::ids;
  fail("number " + std::to_string(packed_count()) + " of '" + key_ + "' is not a " + (ids ? "whole number" : "number"),
       ids ? "whole numbers run from 0 to 4294967295" : "write only decimal numbers");
}

template <class Value>
bool SessionScanner::number(Value value, double real, std::optional<std::uint64_t> whole) {
  if (in_moves_ > 0) {
    return true;
  }
  if (packed_ == Packed::reals) {
    result_.reals.back().push_back(real);
    return true;
  }
  if (packed_ == Packed::ids) {
    if (!whole || *whole > std::numeric_limits<std::uint32_t>::max()) {
      refuse_in_array();
    }
    result_.ids.back().push_back(static_cast<std::uint32_t>(*whole));
    return true;
  }
  if (open_.size() == 1 && key_ == "version" && whole && *whole > session_version) {
    fail("its version is " + std::to_string(*whole) + ", but this program knows only version " +
             std::to_string(session_version) + " and older",
         "open it with a newer program");
  }
  return put(value);
}

/// Adds a value to the tree.
Json& SessionScanner::add(Json value) {
  values_ += value.is_structured() ? limits::values_of_container : 1;
  values_ += !open_.empty() && open_.back()->is_object() ? limits::values_of_key : 0;
  if (values_ > limits::json_values) {
    fail("it contains too many values", "use a session that the workbench saved");
  }
  if (open_.empty()) {
    return result_.tree = std::move(value);
  }
  if (open_.back()->is_array()) {
    open_.back()->push_back(std::move(value));
    return open_.back()->back();
  }
  return (*open_.back())[key_] = std::move(value);
}

bool SessionScanner::put(Json value) {
  if (in_moves_ > 0) {
    return true;
  }
  if (packed_ != Packed::no) {
    refuse_in_array();
  }
  if (!open_.empty() && open_.back()->is_object() && packed_as(top_, key_) != Packed::no) {
    fail("'" + key_ + "' is not an array", "write it in [ ]");
  }
  add(std::move(value));
  return true;
}

bool SessionScanner::open(Json container) {
  if (open_.size() + in_moves_ == deepest_session) {
    fail("it is nested too deeply", "use a session that the workbench saved");
  }
  if (packed_ != Packed::no) {
    refuse_in_array();
  }
  if (in_moves_ > 0 || (open_.size() == 1 && key_ == "moves")) {
    if (in_moves_++ == 0) {
      add(nullptr);
      moves_begin_ = buffer_.position() - 1;  // with its bracket
    }
    return true;
  }
  open_.push_back(&add(std::move(container)));
  return true;
}

bool SessionScanner::close() {
  if (in_moves_ == 0) {
    open_.pop_back();
  } else if (--in_moves_ == 0) {
    result_.moves = text_.substr(moves_begin_, buffer_.position() - moves_begin_);
  }
  return true;
}

bool SessionScanner::key(std::string& key) {
  if (in_moves_ > 0) {
    return true;
  }
  if (open_.back()->contains(key)) {
    fail(in_quotes(key) + " appears twice", "remove one of them");
  }
  key_ = std::move(key);
  if (open_.size() == 1) {
    top_ = key_;
  }
  return true;
}

bool SessionScanner::start_array(std::size_t) {
  const bool named = in_moves_ == 0 && !open_.empty() && open_.back()->is_object();
  const Packed packed = named && packed_ == Packed::no ? packed_as(top_, key_) : Packed::no;
  if (packed == Packed::no) {
    return open(Json::array());
  }
  add(packed == Packed::ids ? result_.ids.size() : result_.reals.size());
  packed_ = packed;
  if (packed == Packed::ids) {
    result_.ids.emplace_back();
  } else {
    result_.reals.emplace_back();
  }
  return true;
}

bool SessionScanner::end_array() {
  if (packed_ == Packed::no) {
    return close();
  }
  packed_ = Packed::no;
  return true;
}

bool SessionScanner::parse_error(std::size_t position, const std::string&, const Json::exception& error) {
  if (dynamic_cast<const Json::parse_error*>(&error) == nullptr) {
    fail("it contains a number that is too large for a double", "use a session that the workbench saved");
  }
  const bool ended = position > text_.size();
  throw Error(shown(path_, line_at(text_, position)), ended ? "it ends too early" : "it is not JSON",
              "use a session that the workbench saved, without changes");
}

}  // namespace

SessionJson parse_session_json(std::string_view text, const std::filesystem::path& path, const Progress& progress) {
  SessionJson result;
  TextBuffer buffer(text, progress);
  SessionScanner scanner(text, buffer, path, result);
  std::istream stream(&buffer);
  Json::sax_parse(stream, &scanner);
  return result;
}

std::size_t SessionFields::packed(const Json& object, const char* key) const {
  const Json& json = member(object, key);
  if (!json.is_number_unsigned()) {
    fail("'" + std::string(key) + "' is not an array", "write it in [ ]");
  }
  return json.get<std::size_t>();
}

const std::vector<std::uint32_t>& SessionFields::elements(const Json& object, const char* key,
                                                          std::uint64_t count) const {
  const auto& result = ids(object, key);
  const auto beyond = std::find_if(result.begin(), result.end(), [count](auto id) { return id >= count; });
  if (beyond != result.end()) {
    fail("'" + std::string(key) + "' names element " + std::to_string(*beyond) + ", which does not exist",
         "ids run from 0 to " + std::to_string(count - 1));
  }
  return result;
}

void SessionFields::check_groups(std::size_t size, std::size_t of_each, const char* key) const {
  if (size % of_each != 0) {
    fail("'" + std::string(key) + "' ends within a group of " + std::to_string(of_each), "write complete groups");
  }
}

std::uint64_t SessionFields::count(const Json& object, const char* key, std::uint64_t highest) const {
  const Json& json = member(object, key);
  if (!json.is_number_unsigned() || json.get<std::uint64_t>() == 0 || json.get<std::uint64_t>() > highest) {
    fail("'" + std::string(key) + "' is not a whole number from 1 to " + std::to_string(highest),
         "write such a number");
  }
  return json.get<std::uint64_t>();
}

LinkId SessionFields::link(const Mesh& mesh, ElementId a, ElementId b) const {
  const auto found = find_link(mesh, a, b);
  if (!found) {
    fail("the elements " + std::to_string(a) + " and " + std::to_string(b) + " are not linked",
         "give the two ends of a link");
  }
  return *found;
}

LinkSoftness ObjectFields::softness(const Json& object) const {
  LinkSoftness softness;
  for (std::size_t i = 0; i < softness_numbers.size(); ++i) {
    const auto& [parameter, value] = softness_numbers[i];
    const std::string key(parameter->name);
    if (i < region_numbers || object.contains(key)) {
      softness.*value = number(member(object, key), *parameter);
    }
  }
  return softness;
}

EnergyKind ObjectFields::energy(const Json& object, EnergyKind absent) const {
  if (!object.contains("energy")) {
    return absent;
  }
  try {
    return energy_kind_of(text(object, "energy"));
  } catch (const Error& error) {
    throw error.where() == where() ? error : error.at(where());
  }
}

Point ObjectFields::rotation_vector(const Json& object, const std::string& key) const {
  const Json& values = array(object, key);
  if (values.size() != 3) {
    fail(in_quotes(key) + " does not have three coordinates", "write [x, y, z]: the axis times the angle in radians");
  }
  return {number(values[0]), number(values[1]), number(values[2])};
}

RegionAxes ObjectFields::axes(const Json& object, const Mesh& mesh, std::optional<RegionAxes>& principal) const {
  if (!object.contains("frame")) {
    return {};
  }
  const Json& axes = this->object(object, "frame");
  check_keys(axes, {"kind", "rotation"});
  const std::string kind = text(axes, "kind");
  const auto found = std::ranges::find(axes_kinds, kind);
  if (found == axes_kinds.end()) {
    fail("the kind of 'frame' is not known", "use axes, object or given");
  }
  const auto which = AxesKind(found - axes_kinds.begin());
  if (which == AxesKind::axes) {
    return {};
  }
  if (which == AxesKind::object && !axes.contains("rotation")) {
    if (!principal) {
      principal = principal_axes(mesh).axes;
    }
    return *principal;
  }
  RegionAxes result(which, rotation_vector(axes, "rotation"));
  try {
    check(result, mesh);
  } catch (const Error& error) {
    fail("'frame': " + error.problem(), error.remedy());
  }
  return result;
}

std::vector<std::string> softness_keys() {
  std::vector<std::string> keys;
  keys.reserve(softness_numbers.size());
  for (const SoftnessNumber& number : softness_numbers) {
    keys.emplace_back(number.parameter->name);
  }
  return keys;
}

void add_softness(nlohmann::ordered_json& object, const Softness& softness) {
  for (const auto& [parameter, value] : softness_numbers) {
    object[std::string(parameter->name)] = softness.global.*value;
  }
  object["energy"] = info(softness.energy).name;
  if (const RegionAxes& axes = softness.axes; axes.kind() != AxesKind::axes) {
    const Point& turn = axes.rotation();
    object["frame"] = {{"kind", axes_kinds[std::size_t(axes.kind())]}, {"rotation", {turn.x(), turn.y(), turn.z()}}};
  }
}

RelaxationScheme ObjectFields::relaxation_scheme(const Json& name) const {
  const auto scheme = name.is_string() ? find_relaxation_scheme(name.get<std::string>()) : std::nullopt;
  if (!scheme) {
    fail("'scheme' is not known", "use mean, link or equilibrium");
  }
  return *scheme;
}

}  // namespace chainmail
