// In the place of read_openexr.cpp where the library is missing.
#include "core/error.h"
#include "output/image_compare/read_openexr.h"

namespace raytube {

PixelImage read_openexr(const NamedFile& source) {
  throw InputError(source.file.string() +
                   ": this raytube was built without OpenEXR; build it where libopenexr-dev is installed, or give the image as a "
                   "table of pixels");
}

}  // namespace raytube
