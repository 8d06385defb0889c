// damaged SECONDS SEED KEPT FOLDER…: damages the meshes and volumes in folders, with random numbers from the seed, and
// opens each of them, including the child process of libraries. A file that neither opens nor gives one error sentence
// in time is copied to KEPT.

#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <iterator>
#include <map>
#include <random>
#include <string>
#include <vector>

#include "files/mesh/mesh_formats.h"
#include "files/mesh/open_mesh.h"
#include "mesh/error.h"

namespace fs = std::filesystem;
using namespace chainmail;

namespace {

using Clock = std::chrono::steady_clock;
constexpr double most_seconds = 20;  // for one small file, on a busy machine

/// A file and the files that belong to it, by their names.
struct Sample {
  std::string name;  // name of the file to open
  std::map<std::string, std::string> parts;
};

std::string content(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

bool is_mesh(const fs::path& path) {
  try {
    mesh_format(path);
    return true;
  } catch (const Error&) {
    return false;
  }
}

/// Returns true if `other` belongs to `path`: it is the other file of TetGen's pair, or the data file that the header
/// names.
bool belongs_to(const fs::path& other, const fs::path& path, const std::string& head) {
  const auto ending = path.extension();
  return other != path &&
         ((ending == ".node" && other == fs::path(path).replace_extension(".ele")) ||
          ((ending == ".mhd" || ending == ".nhdr") && head.find(other.filename().string()) != std::string::npos));
}

Sample sample_of(const fs::path& path) {
  const std::string ending = path.extension().string();
  Sample sample{"damaged" + ending, {{"damaged" + ending, content(path)}}};
  for (const auto& entry : fs::directory_iterator(path.parent_path())) {
    if (belongs_to(entry.path(), path, sample.parts[sample.name])) {
      sample.parts[ending == ".node" ? "damaged.ele" : entry.path().filename().string()] = content(entry.path());
    }
  }
  return sample;
}

std::vector<Sample> samples_in(const fs::path& folder) {
  std::vector<Sample> samples;
  for (const auto& entry : fs::recursive_directory_iterator(folder)) {
    if (entry.is_regular_file() && is_mesh(entry.path()) && entry.path().extension() != ".ele") {
      samples.push_back(sample_of(entry.path()));
    }
  }
  return samples;
}

class Damage {
 public:
  explicit Damage(unsigned seed) : random_(seed) {}

  std::size_t below(std::size_t end) { return end == 0 ? 0 : random_() % end; }

  void apply(std::string& bytes) {
    for (std::size_t times = 1 + below(2); times > 0; --times) {
      apply_one(bytes);
    }
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

  std::mt19937 random_;
};

struct Outcome {
  bool opened = false;
  std::string fault;  // fault of our program
};

Outcome open_one(const fs::path& path) {
  const auto start = Clock::now();
  Outcome outcome;
  try {
    outcome.opened = open_mesh(path).mesh->element_count() > 0;
  } catch (const Error& error) {
    const std::string sentence = error.what();
    if (sentence.find('\n') != std::string::npos || !sentence.starts_with(path.parent_path().string())) {
      outcome.fault = "no sentence about the file: " + sentence;
    }
  } catch (const std::exception& error) {
    outcome.fault = std::string("another exception: ") + error.what();
  }
  if (const double seconds = std::chrono::duration<double>(Clock::now() - start).count(); seconds > most_seconds) {
    outcome.fault += "it took " + std::to_string(seconds) + " s";
  }
  return outcome;
}

struct Tally {
  unsigned opened = 0, refused = 0;
};

/// Returns true if there was no fault.
bool run(double seconds, unsigned seed, const fs::path& kept, const std::vector<Sample>& samples) {
  Damage damage(seed);
  std::map<std::string, Tally> tallies;
  bool well = true;
  const auto end = Clock::now() + std::chrono::duration<double>(seconds);
  const fs::path folder = fs::temp_directory_path() / ("chainmail-damaged-" + std::to_string(seed));
  for (unsigned number = 0; Clock::now() < end; ++number) {
    fs::create_directories(folder);
    Sample sample = samples[damage.below(samples.size())];
    damage.apply(std::next(sample.parts.begin(), std::ptrdiff_t(damage.below(sample.parts.size())))->second);
    for (const auto& [name, bytes] : sample.parts) {
      std::ofstream(folder / name, std::ios::binary) << bytes;
    }
    const Outcome outcome = open_one(folder / sample.name);
    Tally& tally = tallies[fs::path(sample.name).extension().string()];
    ++(outcome.opened ? tally.opened : tally.refused);
    if (!outcome.fault.empty()) {
      well = false;
      const fs::path place = kept / ("failed-damaged-" + std::to_string(seed) + "-" + std::to_string(number));
      fs::remove_all(place);
      fs::copy(folder, place);
      std::cout << place.string() << ": " << outcome.fault << std::endl;
    }
    fs::remove_all(folder);
  }
  for (const auto& [ending, tally] : tallies) {
    std::cout << "damaged " << ending << ": " << tally.opened << " opened, " << tally.refused << " refused\n";
  }
  return well;
}

}  // namespace

int main(int count, char** words) {
  std::vector<Sample> samples;
  for (int i = 4; i < count; ++i) {
    for (Sample& sample : samples_in(words[i])) {
      samples.push_back(std::move(sample));
    }
  }
  if (samples.empty()) {
    std::cerr << "damaged SECONDS SEED KEPT FOLDER…: there are no meshes to damage\n";
    return 2;
  }
  return run(std::atof(words[1]), unsigned(std::atoi(words[2])), words[3], samples) ? 0 : 1;
}
