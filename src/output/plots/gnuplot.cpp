#include "output/plots/gnuplot.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <csignal>
#include <fstream>
#include <iterator>
#include <string_view>

#include "output/files/files.h"
#include "output/files/sync.h"

namespace raytube {

namespace {

// No shell in between: nothing in a path needs quoting, and a missing program is seen as such.
int spawn_silently(const char* const* arguments, pid_t& child) {
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  for (const int stream : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO})
    posix_spawn_file_actions_addopen(&actions, stream, "/dev/null", O_RDWR, 0);
  const int error = posix_spawnp(&child, arguments[0], &actions, nullptr, const_cast<char* const*>(arguments), environ);
  posix_spawn_file_actions_destroy(&actions);
  return error;
}

// Empty if gnuplot ran the script, otherwise what went wrong.
std::string run_gnuplot(const std::filesystem::path& script) {
  const std::string name = script.string();
  const std::array<const char*, 4> arguments = {"gnuplot", "-d", name.c_str(), nullptr};  // -d: no user settings
  pid_t child = 0;
  if (spawn_silently(arguments.data(), child) != 0) return "gnuplot is not installed";
  int status = 0;
  while (waitpid(child, &status, 0) < 0 && errno == EINTR) kill(child, SIGTERM);  // whoever stops us means the plot too
  if (!WIFEXITED(status)) return "gnuplot was stopped";
  return WEXITSTATUS(status) == 0 ? "" : fmt::format("gnuplot failed with status {}", WEXITSTATUS(status));
}

// PNG ends with a chunk of its own (ISO/IEC 15948:2004, 11.2.5), SVG with the tag that closes it, PDF with a line of its own
// (ISO 32000-1:2008, 7.5.5). On a full disk gnuplot leaves half a picture and says nothing.
bool is_whole(const std::filesystem::path& picture) {
  constexpr std::string_view chunk("IEND\xAE\x42\x60\x82", 8), tag = "</svg>", last_line = "%%EOF";
  constexpr std::streamoff at_most = 16;  // blanks may follow
  std::ifstream in(picture, std::ios::binary);
  in.seekg(-at_most, std::ios::end);
  const std::string end{std::istreambuf_iterator<char>(in), {}};
  if (picture.extension() == ".png") return end.ends_with(chunk);
  return end.find(picture.extension() == ".pdf" ? last_line : tag) != std::string::npos;
}

// Throws std::runtime_error if that is why the picture is not whole: gnuplot does not say. What there is of it keeps its room
// meanwhile, and a file may not have been allowed to grow beyond it.
void require_room_on_disk(const std::filesystem::path& picture) {
  constexpr std::size_t piece = 1 << 18;  // [bytes]
  const std::filesystem::path trial = picture.parent_path() / ("more of " + picture.filename().string());
  std::error_code error;
  const auto size = std::filesystem::file_size(picture, error);
  try {
    OutputFile file(trial);
    for (std::size_t written = 0; written <= (error ? 0 : size); written += piece) file.write(std::string(piece, '\0'));
    file.commit();
  } catch (const std::runtime_error&) {
    std::filesystem::remove(trial, error);
    refuse_unwritten(picture);
  }
  std::filesystem::remove(trial, error);
}

}  // namespace

// Inside single quotes gnuplot takes everything literally but the quote itself; SVG allows no control characters.
std::string gnuplot_quoted(const std::string& text) {
  std::string inside;
  for (const char c : text) {
    if (c == '\'') inside += '\'';
    inside += static_cast<unsigned char>(c) < ' ' ? ' ' : c;
  }
  return '\'' + inside + '\'';
}

// The line breaks alone stand in double quotes: nothing of the text takes part in gnuplot's escapes.
std::string gnuplot_quoted_lines(const std::string& text) {
  std::string joined;
  for (std::size_t begin = 0; begin <= text.size();) {
    const std::size_t end = std::min(text.find('\n', begin), text.size());
    joined += (joined.empty() ? "" : ".\"\\n\".") + gnuplot_quoted(text.substr(begin, end - begin));
    begin = end + 1;
  }
  return joined;
}

std::string gnuplot_preamble(const std::string& terminal, const std::string& canvas, const std::string& file) {
  return fmt::format(
      "set encoding utf8\nset terminal {} size {} noenhanced font 'DejaVu Sans,12' background rgb 'white'\nset output {}\n"
      "set grid lt 1 lw 1 lc rgb '#d9d9d9'\nset key outside right top vertical Left reverse samplen 3\n",
      terminal, canvas, gnuplot_quoted(file));
}

std::string draw_picture(const std::filesystem::path& picture, const std::string& commands) {
  const std::filesystem::path script = picture.string() + ".gnuplot";
  OutputFile file(script);
  file.write(commands);
  file.commit();
  std::string trouble = run_gnuplot(script);
  std::error_code error;
  std::filesystem::remove(script, error);
  const bool is_there = std::filesystem::exists(picture, error);
  if (trouble.empty() && !is_whole(picture)) trouble = is_there ? "gnuplot left half a picture" : "gnuplot left no picture";
  if (trouble.empty() || !is_there) return trouble;
  require_room_on_disk(picture);
  std::filesystem::remove(picture, error);
  return trouble;
}

std::string draw_pictures(const std::filesystem::path& folder, const std::string& name,
                          const std::function<std::string(const std::string&, const std::string&)>& script) {
  const std::filesystem::path png = folder / (name + ".png"), svg = folder / (name + ".svg");
  const std::string trouble = draw_picture(png, script("pngcairo", png.string()));
  return trouble.empty() ? draw_picture(svg, script("svg", svg.string())) : trouble;
}

}  // namespace raytube
