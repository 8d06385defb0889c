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
#include <string>
#include <vector>

#include "files/mesh/mesh_formats.h"
#include "files/mesh/open_mesh.h"
#include "fuzz/damage.h"
#include "mesh/error.h"

namespace fs = std::filesystem;
using namespace chainmail;

namespace {

using Clock = std::chrono::steady_clock;
constexpr double max_seconds = 20;  // for one small file, on a busy machine

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
  if (const double seconds = std::chrono::duration<double>(Clock::now() - start).count(); seconds > max_seconds) {
    outcome.fault += "it took " + std::to_string(seconds) + " s";
  }
  return outcome;
}

struct Tally {
  unsigned opened = 0, refused = 0;
};

/// Returns true if there was no fault.
bool run(double seconds, unsigned seed, const fs::path& kept, const std::vector<Sample>& samples) {
  fuzz::Damage damage(seed);
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
