#include "report/table/results.h"

#include <algorithm>
#include <array>
#include <iterator>

namespace chainmail::report {
namespace {

constexpr std::array kinds{
    ReportInfo{ReportKind::compare, "compare", "ChainMail: time against error"},
    ReportInfo{ReportKind::physics, "physics", "ChainMail against physics"},
    ReportInfo{ReportKind::suite, "suite", "ChainMail and the methods of today"},
    ReportInfo{ReportKind::ramp, "ramp", "Square grids in real time"},
    ReportInfo{ReportKind::calibrate, "calibrate", "Softness that is closest to a material"},
    ReportInfo{ReportKind::judge, "judge", "Answers of other solvers"},
};

}  // namespace

const Value* Row::find(const Figure& figure) const {
  const auto found = std::ranges::find(figures, &figure, &std::pair<const Figure*, Value>::first);
  return found == figures.end() ? nullptr : &found->second;
}

std::optional<double> Row::operator[](const Figure& figure) const {
  const Value* value = find(figure);
  return value == nullptr ? std::nullopt : std::optional(value->number);
}

void Row::set(const Figure& figure, const std::optional<double>& value) {
  if (value) {
    std::erase_if(figures, [&](const auto& one) { return one.first == &figure; });
    figures.emplace_back(&figure, Value{*value});
  }
}

void Row::set(const Figure& figure, const TimeSpread& ms) {
  if (ms.count > 0) {
    set(figure, ms.median);
    figures.back().second.spread = ms;
  }
}

void Results::add(Results other) {
  for (Row& row : other.rows) {
    row.object += objects.size();
  }
  std::ranges::move(other.runs, std::back_inserter(runs));
  std::ranges::move(other.objects, std::back_inserter(objects));
  std::ranges::move(other.rows, std::back_inserter(rows));
  stopped = stopped || other.stopped;
}

std::span<const ReportInfo> report_kinds() { return kinds; }

const ReportInfo& report_info(ReportKind kind) { return *std::ranges::find(kinds, kind, &ReportInfo::kind); }

std::optional<ReportKind> find_report_kind(std::string_view name) {
  const auto found = std::ranges::find(kinds, name, &ReportInfo::name);
  return found == kinds.end() ? std::nullopt : std::optional(found->kind);
}

}  // namespace chainmail::report
