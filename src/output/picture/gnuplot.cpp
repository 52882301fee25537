#include "output/picture/gnuplot.h"

#include <fmt/format.h>

#include <fstream>
#include <iterator>

#include "output/files/files.h"
#include "output/picture/child_process.h"

namespace raytube {

// Inside single quotes gnuplot takes everything literally but the quote itself; line breaks stand in double quotes between such
// pieces. SVG allows no control characters.
std::string gnuplot_quoted(const std::string& text) {
  std::string quoted = "'";
  for (const char c : text) {
    if (c == '\n')
      quoted += "'.\"\\n\".'";
    else if (c == '\'')
      quoted += "''";
    else
      quoted += static_cast<unsigned char>(c) < ' ' ? ' ' : c;
  }
  return quoted + "'";
}

// On a full disk gnuplot leaves half a picture and says nothing: a PNG ends with the chunk IEND, an SVG with its closing tag.
static bool is_whole(const std::filesystem::path& picture) {
  std::ifstream in(picture, std::ios::binary);
  in.seekg(-16, std::ios::end);
  const std::string end{std::istreambuf_iterator<char>(in), {}};
  return end.find(picture.extension() == ".svg" ? "</svg>" : "IEND") != std::string::npos;
}

std::string draw_picture(const std::filesystem::path& picture, const std::string& size, const std::string& commands) {
  const std::filesystem::path script = picture.string() + ".gnuplot";
  OutputFile file(script);
  file.write(
      fmt::format("set encoding utf8\nset terminal {} size {} noenhanced font 'DejaVu Sans,12' background rgb 'white'\n"
                  "set output {}\n",
                  picture.extension() == ".svg" ? "svg" : "pngcairo", size, gnuplot_quoted(picture.string())));
  file.write(commands + "\nset output\n");
  file.commit();
  const ChildEnd end = run_child({"gnuplot", "-d", script.string()}, ChildOutput::silent);  // -d: no settings of the user's
  std::error_code error;
  std::filesystem::remove(script, error);
  if (end.code == 0 && is_whole(picture)) return "";
  std::filesystem::remove(picture, error);
  if (end.missing) return "gnuplot is not installed";
  return end.code == 0 ? "gnuplot left no whole picture; is the disk full?"
                       : fmt::format("gnuplot failed with status {}", end.code);
}

}  // namespace raytube
