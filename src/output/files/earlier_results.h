// The results that earlier commands have left in a folder, told from everything else that lies there.
#pragma once

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

namespace raytube {

/// A file is a result if .raytube.results, which lies beside it, has its name and SHA-256: the lines of `sha256sum`. What has
/// been edited or put there since is somebody's own.
class EarlierResults {
 public:
  /// Reads the list; a folder without one, or an unreadable one, has none.
  explicit EarlierResults(const std::filesystem::path& folder);

  /// True if the file of that name is there as a command has written it.
  bool hold(const std::string& name) const;

  /// Throws InputError if something else lies where these are to go, or the list.
  void require_room(const std::vector<std::string>& names) const;

  /// Reads the named files of another folder, which are to take their places here. Throws std::runtime_error if that cannot be.
  void expect(const std::filesystem::path& from, const std::vector<std::string>& names);

  /// Puts them on the list, beside those that they will replace: a command that is killed while they take their places leaves
  /// nothing that the list does not know. Throws std::runtime_error if the disk does not take it.
  void announce(const std::filesystem::path& by_way_of);

  /// They have taken their places: takes off the list whatever is no longer there.
  void settle(const std::filesystem::path& by_way_of);

  /// They have not, and all is as it was.
  void withdraw(const std::filesystem::path& by_way_of);

 private:
  using Entry = std::pair<std::string, std::string>;  // name and SHA-256
  void drop_what_is_gone();
  void write(const std::filesystem::path& by_way_of, const std::vector<Entry>& entries) const;

  std::filesystem::path folder_;
  std::vector<Entry> entries_, expected_;
};

}  // namespace raytube
