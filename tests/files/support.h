#pragma once

#include <QString>
#include <chrono>
#include <condition_variable>
#include <fstream>
#include <functional>
#include <iterator>
#include <mutex>
#include <sstream>
#include <string>
#include <thread>

#include "files/formats/dat.h"
#include "files/formats/obj.h"
#include "files/mesh/open_mesh.h"
#include "mesh/error.h"
#include "mesh/generate.h"
#include "mesh/progress.h"

namespace chainmail::test {

/// Returns the sentence of the Error that a function throws; empty if it throws none.
inline QString error_of(const std::function<void()>& function) {
  try {
    function();
  } catch (const Error& error) {
    return QString::fromStdString(error.what());
  }
  return {};
}

inline MeshPointer made(MeshKind kind, std::array<std::uint32_t, 3> size, double spacing = 1,
                        std::optional<int> space = {}) {
  return generate({kind, size, spacing, space});
}

inline MeshPointer dat(const std::string& text, const std::string& name = "mesh.dat", const ReadOptions& options = {}) {
  return opened(read_dat(text, name, options), name, options).mesh;
}

inline MeshPointer obj(const std::string& text, const ReadOptions& options = {}) {
  return opened(read_obj(text, "mesh.obj"), "mesh.obj", options).mesh;
}

inline std::string dat_text(const Mesh& mesh, const Cuts& cuts = {}) {
  std::ostringstream out;
  write_dat(out, {mesh, cuts, rest_positions(mesh), {}});
  return out.str();
}

inline std::string obj_text(const Mesh& mesh, const Cuts& cuts = {}) {
  std::ostringstream out;
  write_obj(out, {mesh, cuts, rest_positions(mesh), {}});
  return out.str();
}

inline std::string file_text(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

inline void put_file(const std::filesystem::path& path, const std::string& text) {
  std::ofstream(path, std::ios::binary) << text;
}

/// Returns the number of entries of a folder, including hidden ones.
inline std::ptrdiff_t files_in(const std::filesystem::path& folder) {
  return std::distance(std::filesystem::directory_iterator(folder), {});
}

/// Cancels a job that takes too long, so that its test fails soon.
class Patience {
 public:
  explicit Patience(const Progress& job, std::chrono::seconds most = std::chrono::seconds(20))
      : thread_([job, most](const std::stop_token& stop) {
          std::mutex mutex;
          std::unique_lock lock(mutex);
          std::condition_variable_any over;
          over.wait_for(lock, stop, most, [] { return false; });
          job.cancel();
        }) {}

 private:
  std::jthread thread_;
};

}  // namespace chainmail::test
