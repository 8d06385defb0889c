#include <algorithm>
#include <cmath>
#include <map>

#include "files/formats/metaimage.h"
#include "files/text/text.h"
#include "mesh/error.h"

namespace chainmail {
namespace {

constexpr std::size_t longest_head = 100'000;

class HeadReader {
 public:
  HeadReader(std::string_view text, const std::filesystem::path& path)
      : text_(text.substr(0, longest_head)), path_(path) {}

  MetaImageHead read() {
    bool local = false;
    while (!local) {
      local = take_line() == "ElementDataFile";
    }
    check();
    return head_;
  }

 private:
  [[noreturn]] void fail(const std::string& problem, const std::string& remedy) const {
    throw Error(shown(path_, line_), problem, remedy);
  }

  /// Takes a line over and says its key.
  std::string_view take_line();
  void take(std::string_view key, std::string_view value);
  std::array<double, 3> numbers(std::string_view value) const;
  bool truth(std::string_view value) const;
  void check() const;

  std::string_view text_;
  const std::filesystem::path& path_;
  std::size_t line_ = 0;
  std::uint32_t dimension_ = 0, channels_ = 1;
  bool binary_ = true, head_size_known_ = true;
  MetaImageHead head_;
};

std::string_view trimmed(std::string_view text) {
  const std::size_t first = text.find_first_not_of(" \t\r");
  return first == std::string_view::npos ? std::string_view()
                                         : text.substr(first, text.find_last_not_of(" \t\r") + 1 - first);
}

std::string_view HeadReader::take_line() {
  ++line_;
  const std::size_t end = text_.find('\n', head_.length);
  if (end == std::string_view::npos) {
    fail("the head ends before its line 'ElementDataFile = …'", "export the image anew");
  }
  const std::string_view line = text_.substr(head_.length, end - head_.length);
  head_.length = end + 1;
  const std::size_t equals = line.find('=');
  if (equals == std::string_view::npos) {
    if (trimmed(line).empty()) {
      return {};
    }
    fail(in_quotes(trimmed(line)) + " is no line of a head", "write 'Key = Value'");
  }
  const auto key = trimmed(line.substr(0, equals));
  take(key, trimmed(line.substr(equals + 1)));
  return key;
}

void HeadReader::take(std::string_view key, std::string_view value) {
  if (key == "NDims") {
    dimension_ = parse_count(value).value_or(0);
  } else if (key == "DimSize") {
    const auto size = numbers(value);
    for (std::size_t k = 0; k < 3; ++k) {
      if (!(size[k] >= 0 && size[k] <= double(voxel_limit) && size[k] == std::floor(size[k]))) {
        fail("a size is no whole number up to " + std::to_string(voxel_limit), "give three sizes");
      }
      head_.size[k] = static_cast<std::uint64_t>(size[k]);
    }
  } else if (key == "ElementSpacing" || (key == "ElementSize" && head_.spacing == Point::Ones())) {
    const auto spacing = numbers(value);
    head_.spacing = Point(spacing[0], spacing[1], spacing[2]).cwiseAbs();
  } else if (key == "Offset" || key == "Position" || key == "Origin") {
    const auto origin = numbers(value);
    head_.origin = Point(origin[0], origin[1], origin[2]);
  } else if (key == "ElementType") {
    head_.type = value;
  } else if (key == "ElementNumberOfChannels") {
    channels_ = parse_count(value).value_or(0);
  } else if (key == "BinaryDataByteOrderMSB" || key == "ElementByteOrderMSB") {
    head_.big_endian = truth(value);
  } else if (key == "BinaryData") {
    binary_ = truth(value);
  } else if (key == "CompressedData") {
    head_.compressed = truth(value);
  } else if (key == "HeaderSize") {
    head_size_known_ = value == "0";
  } else if (key == "ElementDataFile") {
    head_.data_file = value;
  }  // others, such as TransformMatrix and comments, say nothing of densities
}

std::array<double, 3> HeadReader::numbers(std::string_view value) const {
  std::array<double, 3> numbers{};
  for (double& number : numbers) {
    const auto word = take_word(value);
    const auto parsed = parse_number(word);
    if (!parsed || std::abs(*parsed) > coordinate_limit) {
      fail(in_quotes(word) + " is not one of three finite numbers", "give one for each axis of a volume");
    }
    number = *parsed;
  }
  return numbers;
}

bool HeadReader::truth(std::string_view value) const {
  if (value != "True" && value != "False" && value != "true" && value != "false") {
    fail(in_quotes(value) + " is neither True nor False", "write one of them");
  }
  return value.front() == 'T' || value.front() == 't';
}

void HeadReader::check() const {
  if (dimension_ != 3) {
    fail("the image does not have 3 dimensions", "give a volume");
  }
  if (channels_ != 1) {
    fail("the image has " + std::to_string(channels_) + " numbers a voxel", "give a volume of densities, one a voxel");
  }
  if (!binary_ || !head_size_known_) {
    fail("its data are text, or have a head of their own", "export it with binary data and HeaderSize 0");
  }
  if (!(head_.spacing.minCoeff() > 0)) {
    fail("the spacing of voxels is 0 along an axis", "give spacings above 0");
  }
  if (head_.data_file == "LIST" || head_.data_file.find('%') != std::string::npos) {
    fail("its data lie in several files", "export it as one file");
  }
}

}  // namespace

MetaImageHead read_metaimage_head(std::string_view text, const std::filesystem::path& path) {
  return HeadReader(text, path).read();
}

}  // namespace chainmail
