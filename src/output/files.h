// Result files: written beside their place and renamed when complete, so that nothing half-written carries a result's name.
#pragma once

#include <filesystem>
#include <fstream>
#include <string>
#include <string_view>

namespace raytube {

/// A hidden name in the same folder, where a rename to `path` is atomic; distinct for each process.
std::filesystem::path temporary_beside(const std::filesystem::path& path);

/// The folder results go to. Created if missing; a folder created here and still empty in the end is removed again.
class OutputFolder {
 public:
  /// Throws InputError if the folder cannot be created or written to.
  explicit OutputFolder(const std::filesystem::path& path);
  ~OutputFolder();
  OutputFolder(const OutputFolder&) = delete;
  OutputFolder& operator=(const OutputFolder&) = delete;

  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
  std::filesystem::path first_created_;  // empty if everything existed
};

/// A text file that appears under its name only with commit(); otherwise no trace of it is left.
class OutputFile {
 public:
  /// Throws std::runtime_error if nothing can be written there.
  explicit OutputFile(const std::filesystem::path& path);
  ~OutputFile();
  OutputFile(const OutputFile&) = delete;
  OutputFile& operator=(const OutputFile&) = delete;

  void write(std::string_view text) { stream_.write(text.data(), static_cast<std::streamsize>(text.size())); }

  /// Throws std::runtime_error if the disk did not take everything.
  void commit();

 private:
  std::filesystem::path path_, beside_;
  std::ofstream stream_;
};

/// SHA-256 of a file's bytes, in hexadecimal. Throws std::runtime_error if it cannot be read.
std::string sha256_of_file(const std::filesystem::path& path);

}  // namespace raytube
