#include "output/vtk/image_pvd.h"

#include "output/vtk/vtk_file.h"

namespace raytube {

void write_image_pvd(const std::filesystem::path& file, std::span<const SeriesFile> files) {
  OutputFile out(file);
  {
    const VtkElement whole(out, "VTKFile", "type=\"Collection\" version=\"1.0\" byte_order=\"LittleEndian\"");
    const VtkElement collection(out, "Collection");
    for (const auto& [look, name] : files)
      out.write(fmt::format("<DataSet timestep=\"{}\" group=\"\" part=\"0\" file=\"{}\"/>\n", look, name));
  }
  out.commit();
}

}  // namespace raytube
