#include "report/page/ramp_table.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <iomanip>
#include <sstream>
#include <string>

namespace chainmail::report {
namespace {

std::string figure(double number, int digits = 3) {
  std::ostringstream text;
  text.imbue(std::locale::classic());
  text << std::setprecision(digits) << number;
  return text.str();
}

std::string all_digits(double number) {
  std::array<char, 32> digits;
  return {digits.data(), std::to_chars(digits.data(), digits.data() + digits.size(), number).ptr};
}

std::string size_of(std::uint32_t width) { return std::to_string(width) + "x" + std::to_string(width); }

std::string left(std::string text, std::size_t width) {
  text.resize(std::max(text.size(), width), ' ');
  return text;
}

std::string right(const std::string& text, std::size_t width) {
  return std::string(width - std::min(width, text.size()), ' ') + text;
}

const RampRow* find_row(const Ramp& ramp, std::uint32_t width, Algorithm algorithm) {
  const auto found = std::find_if(ramp.rows.begin(), ramp.rows.end(),
                                  [&](const RampRow& row) { return row.width == width && row.algorithm == algorithm; });
  return found == ramp.rows.end() ? nullptr : &*found;
}

void write_conditions(std::ostream& out, const Ramp& ramp, const Machine& machine) {
  const RampOptions& options = ramp.options;
  out << "Square grids in real time: 99% of passes within " << figure(1000 * options.budget) << " ms\n"
      << (options.precision == Precision::single_precision ? "float" : "double") << ", compression "
      << all_digits(options.softness.compression) << ", stretch " << all_digits(options.softness.stretch) << ", shear "
      << all_digits(options.softness.shear) << "; " << options.drags << " drags of " << options.moves
      << " moves at each size, seed " << options.seed << '\n'
      << machine.processor << ", " << machine.cores << " cores; " << machine.compiler << ", " << machine.build << "; "
      << figure(ramp.seconds) << " s\n";
  if (ramp.stopped) {
    out << "It was stopped before its end.\n";
  }
}

void write_verdict(std::ostream& out, const Ramp& ramp, const RampVerdict& verdict) {
  out << left(std::string(info(verdict.algorithm).label), 24);
  if (verdict.largest_width) {
    const RampRow& row = *find_row(ramp, *verdict.largest_width, verdict.algorithm);
    out << right(size_of(row.width) + (verdict.lost ? "" : " or more"), 18) << right(std::to_string(row.elements), 10)
        << right(figure(row.median_ms), 11) << right(figure(row.p99_ms), 9);
  } else {
    out << right(verdict.lost ? "never" : "not measured", 18) << right("", 30);
  }
  if (const auto& growth = verdict.growth) {
    out << right(figure(growth->exponent), 10) << "  " << std::to_string(std::uint64_t(growth->from)) << " to "
        << std::to_string(std::uint64_t(growth->to));
  }
  out << '\n';
}

/// `median/p99` in ms, with a mark where the budget is missed; empty where an algorithm was out.
std::string cell(const RampRow* row) {
  if (row == nullptr) {
    return "";
  }
  return figure(row->median_ms, 2) + "/" + figure(row->p99_ms, 2) + (row->in_real_time ? " " : "!");
}

void write_sizes(std::ostream& out, const Ramp& ramp) {
  out << "\nmedian/99th percentile in ms; ! beyond the budget, twice\n" << left("", 10);
  for (const Algorithm algorithm : ramp.options.algorithms) {
    out << right(std::string(info(algorithm).name) + " ", 16);
  }
  out << '\n';
  std::uint32_t last = 0;
  for (const RampRow& row : ramp.rows) {
    if (row.width == last) {
      continue;
    }
    last = row.width;
    std::string line = left(size_of(row.width), 10);
    for (const Algorithm algorithm : ramp.options.algorithms) {
      line += right(cell(find_row(ramp, row.width, algorithm)), 16);
    }
    out << line.substr(0, line.find_last_not_of(' ') + 1) << '\n';
  }
}

}  // namespace

void write_text(std::ostream& out, const Ramp& ramp, const Machine& machine) {
  write_conditions(out, ramp, machine);
  out << '\n'
      << left("", 24) << right("real time up to", 18) << right("elements", 10) << right("median ms", 11)
      << right("99% ms", 9) << right("exponent", 10) << "  of the median, over elements\n";
  for (const RampVerdict& verdict : ramp.verdicts) {
    write_verdict(out, ramp, verdict);
  }
  write_sizes(out, ramp);
}

void write_csv(std::ostream& out, const Ramp& ramp) {
  out << "width,elements,links,algorithm,passes,median_ms,p99_ms,mean_moved,repeated,real_time\n";
  for (const RampRow& row : ramp.rows) {
    out << std::to_string(row.width) << ',' << std::to_string(row.elements) << ',' << std::to_string(row.links) << ','
        << info(row.algorithm).name << ',' << std::to_string(row.passes) << ',' << all_digits(row.median_ms) << ','
        << all_digits(row.p99_ms) << ',' << all_digits(row.mean_moved) << ',' << (row.repeated ? 1 : 0) << ','
        << (row.in_real_time ? 1 : 0) << '\n';
  }
}

}  // namespace chainmail::report
