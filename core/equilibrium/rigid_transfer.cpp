#include "equilibrium/rigid_transfer.h"

namespace chainmail {

TransferTerms terms_of(const BlockColumns& transfer, std::span<const std::uint32_t> rows,
                       std::span<const std::uint32_t> wanted, std::uint32_t width) {
  std::vector<std::uint32_t> number(width);  // of each column that is wanted, from 1
  for (std::uint32_t i = 0; i < wanted.size(); ++i) {
    number[wanted[i]] = i + 1;
  }
  TransferTerms result;
  result.first.resize(wanted.size() + 1);
  for (const std::uint32_t row : rows) {
    for (const std::uint32_t column : transfer.columns(row)) {
      result.first[number[column]] += number[column] != 0 ? 1 : 0;
    }
  }
  std::partial_sum(result.first.begin(), result.first.end(), result.first.begin());
  result.terms.resize(result.first.back());
  std::vector<std::uint32_t> next = result.first;
  for (const std::uint32_t row : rows) {
    const auto columns = transfer.columns(row);
    for (std::uint32_t k = 0; k < columns.size(); ++k) {
      if (const std::uint32_t i = number[columns[k]]; i != 0) {
        result.terms[next[i - 1]++] = {row, k};
      }
    }
  }
  return result;
}

}  // namespace chainmail
