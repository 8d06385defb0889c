#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <span>
#include <string_view>
#include <type_traits>
#include <utility>

#include "mesh/parameters.h"

namespace chainmail {

/// What all code knows about a member of a struct of settings: files, command line, docks and Python read it.
struct MemberInfo {
  std::string_view key;                          // in files and in Python
  std::string_view help;                         // one sentence without a full stop
  std::optional<Parameter> number = {};          // of a number: its limits
  std::span<const std::string_view> names = {};  // of a choice: its names, in the order of the constants
  std::size_t count = 1;                         // of the numbers, if the member is an array
  bool is_whole = false;                         // a whole number
  bool may_be_absent = false;                    // from files, which are older than the member; it has its default then
  bool is_left_out = false;                      // from files, while it has its default
  std::string_view label = {};                   // in the window
  std::span<const std::string_view> labels = {};  // of a choice: its names in the window
};

constexpr bool is_yes_or_no(const MemberInfo& member) { return !member.number && member.names.empty(); }

/// A member that is read and written as numbers: a choice by its index, yes as 1, and item `i` of an array.
template <class Struct>
struct Member : MemberInfo {
  double (*get)(const Struct& all, std::size_t i);
  void (*set)(Struct& all, std::size_t i, double value);
};

/// The members of a struct, in the order of files and docks. A struct is described by a specialisation next to it.
template <class Struct>
inline constexpr int members_of = 0;

namespace described {

template <class Value>
inline constexpr std::size_t count_of = 1;
template <class Value, std::size_t Count>
inline constexpr std::size_t count_of<std::array<Value, Count>> = Count;

template <class Struct, class Value>
constexpr Struct struct_of(Value Struct::*);

/// The member at the end of a path of members, such as (options.law).kind.
template <auto First, auto... Rest>
constexpr auto& at(auto& all) {
  if constexpr (sizeof...(Rest) == 0) {
    return all.*First;
  } else {
    return at<Rest...>(all.*First);
  }
}
template <auto First, auto... Rest>
constexpr auto& item(auto& all, std::size_t i) {
  auto& member = at<First, Rest...>(all);
  if constexpr (requires { member[i]; }) {
    return member[i];
  } else {
    return member;
  }
}

template <auto First, auto... Rest>
constexpr auto member(MemberInfo info) {
  using Struct = decltype(struct_of(First));
  using Value = std::remove_cvref_t<decltype(at<First, Rest...>(std::declval<Struct&>()))>;
  using Item = std::remove_cvref_t<decltype(item<First, Rest...>(std::declval<Struct&>(), 0))>;
  info.count = count_of<Value>;
  info.is_whole = std::is_integral_v<Item>;
  return Member<Struct>{
      info, [](const Struct& all, std::size_t i) { return double(item<First, Rest...>(all, i)); },
      [](Struct& all, std::size_t i, double value) { item<First, Rest...>(all, i) = static_cast<Item>(value); }};
}

}  // namespace described

/// Describe a member, given by its path in the struct.
template <auto... Path>
constexpr auto number(std::string_view key, const Parameter& parameter) {
  return described::member<Path...>(
      {.key = key, .help = parameter.help, .number = parameter, .label = parameter.label});
}
/// The same for a number that is not in the table of parameters: no slider shows it, and its default is in the struct.
template <auto... Path>
constexpr auto number(std::string_view key, std::string_view label, std::string_view help, double lowest,
                      double highest = parameters::highest_count) {
  return number<Path...>(key, Parameter{key, label, {}, 0, lowest, highest, highest, 1, 0, help});
}
template <auto... Path>
constexpr auto choice(std::string_view key, std::span<const std::string_view> names, std::string_view help) {
  return described::member<Path...>({.key = key, .help = help, .names = names});
}
template <auto... Path>
constexpr auto yes_or_no(std::string_view key, std::string_view help) {
  return described::member<Path...>({.key = key, .help = help});
}
/// The same, for a member that files of older versions do not have.
template <class Struct>
constexpr Member<Struct> may_be_absent(Member<Struct> member) {
  member.may_be_absent = true;
  return member;
}

/// The same, for a choice that the window shows.
template <class Struct>
constexpr Member<Struct> shown_as(std::string_view label, std::span<const std::string_view> labels,
                                  Member<Struct> member) {
  member.label = label;
  member.labels = labels;
  return member;
}
/// The same, for a number that is not written while it has its default.
template <class Struct>
constexpr Member<Struct> left_out_by_default(Member<Struct> member) {
  member.may_be_absent = member.is_left_out = true;
  return member;
}

/// Throws Error, with the name of the parameter, if a number is out of range.
template <class Struct>
void check_members(const Struct& all) {
  for (const Member<Struct>& member : members_of<Struct>) {
    for (std::size_t i = 0; member.number && i < member.count; ++i) {
      check(*member.number, member.get(all, i));
    }
  }
}

}  // namespace chainmail
